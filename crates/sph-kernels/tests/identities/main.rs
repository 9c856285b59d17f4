//! Identities every kernel fulfils, through the public interface alone.

mod constants;
mod derivatives;
mod lanes;
mod quadrature;
mod sampling;
mod shapes;
mod transform;
