//! The wall treatments in three dimensions: what a solver sees of them.

mod beds;
mod caching;
mod constrain;
mod cover;
mod dummy;
mod gamma;
mod joined;
mod motion;
mod pressure;
mod shapes;
mod shares;
