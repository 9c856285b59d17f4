//! The command under test, made as a stranger makes one.

fn main() -> std::process::ExitCode {
    sph_cli::main()
}
