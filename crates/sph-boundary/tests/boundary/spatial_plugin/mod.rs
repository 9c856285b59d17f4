//! The wall treatments in three dimensions: what a solver sees of them.

mod caching;
mod cover;
mod gamma;
mod joined;
mod pressure;
pub mod shapes;
mod shares;
