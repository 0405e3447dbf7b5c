//! The program `lightbvh`; see [`lightbvh_host::cli`].

fn main() -> std::process::ExitCode {
    lightbvh_host::cli::main()
}
