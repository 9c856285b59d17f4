//! The `sph` command with the built-in plugins.

fn main() -> std::process::ExitCode {
    sph_cli::main()
}
