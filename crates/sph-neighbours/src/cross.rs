//! The cross product in either dimension.

use sph_core::Vect;

/// r × f; the third component alone in two dimensions.
pub fn cross<const D: usize>(r: &Vect<D>, f: &Vect<D>) -> [f64; 3] {
    let at = |v: &Vect<D>, k: usize| v.get(k).copied().unwrap_or(0.0);
    [
        at(r, 1) * at(f, 2) - at(r, 2) * at(f, 1),
        at(r, 2) * at(f, 0) - at(r, 0) * at(f, 2),
        at(r, 0) * at(f, 1) - at(r, 1) * at(f, 0),
    ]
}
