//! Laws against closed forms, limits and each other.

mod drucker_prager;
mod mu_i;
mod properties;
mod registry;
