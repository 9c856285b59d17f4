//! Single crates of this project in other programs: the programs are in `examples/`, each is one page.
//!
//! ```sh
//! cargo run -p embedding --example gamma_of_a_mesh
//! ```
