//! The examples of the README files are run as doctests here, so that no crate needs another one
//! for its front page.

macro_rules! readmes {
    ($($name:ident $path:literal)+) => {
        $(#[doc = include_str!($path)] struct $name;)+
    };
}

readmes! {
    Workspace "../README.md"
    GrainsAndPores "../crates/dem-pfv/README.md"
    SceneText "../crates/scene-text/README.md"
    Boundary "../crates/sph-boundary/README.md"
    Core "../crates/sph-core/README.md"
    Kernels "../crates/sph-kernels/README.md"
    Neighbours "../crates/sph-neighbours/README.md"
    Probes "../crates/sph-probes/README.md"
    Rheology "../crates/sph-rheology/README.md"
    Run "../crates/sph-run/README.md"
    Particles "../crates/sph-particles/README.md"
    Solver "../crates/sph-solver/README.md"
    Turbulence "../crates/sph-turbulence/README.md"
    Soil "../crates/sph-soil/README.md"
    Study "../crates/sph-study/README.md"
}
