//! Report of the relaxation of the first particles.

use serde::{Deserialize, Serialize};

/// Results of a relaxation; errors are |Σ θ V w / γ − 1| with the volume V that a particle ends up with.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Relaxation {
    /// Steps taken.
    pub steps: usize,
    /// Particles farther than a support from any free surface; the others stay where they are
    /// and are not counted.
    pub counted: usize,
    /// Largest error before.
    pub largest_before: f64,
    /// Largest error after.
    pub largest: f64,
    /// Root mean square of the error before.
    pub rms_before: f64,
    /// Root mean square of the error after.
    pub rms: f64,
    /// Volume of a particle over that of a cell of the lattice: the fluid's volume per particle, from the mean of Σ V w
    /// over the particles that see neither a wall nor a surface.
    pub volume: f64,
}
