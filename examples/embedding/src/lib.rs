//! Single crates of this project in other programs: the programs are in `examples/`, each is one page.
//!
//! ```sh
//! cargo run -p embedding --example scene_in_memory
//! ```
