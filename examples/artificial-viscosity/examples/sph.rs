//! The command line with the term: `cargo run --release -p artificial-viscosity --example sph -- plugins term`.

use artificial_viscosity as _;

fn main() -> std::process::ExitCode {
    sph_cli::main()
}
