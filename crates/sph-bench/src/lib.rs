//! Measurements of the workspace. There is nothing to use here: see `benches/` and the
//! commands in `docs/performance.md`.
