//! Laws, meshes and kernels of this project in other programs, without plugins: the programs are in `examples/`,
//! each is one page.
//!
//! ```sh
//! cargo run -p embedding-bare --example gamma_of_a_mesh
//! ```
