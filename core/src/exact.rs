//! The only arithmetic that shared code may use.
