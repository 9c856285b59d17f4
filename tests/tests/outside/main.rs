//! Plugins from outside: laws, forces, kernels, movers and kinds that no crate of the workspace knows.

mod embedding;
mod insertion;
mod lanes;
mod open_kind;
mod outside_mover;
mod outside_plugin;
