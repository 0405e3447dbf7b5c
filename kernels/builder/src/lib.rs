//! Post-pass and verifier.
