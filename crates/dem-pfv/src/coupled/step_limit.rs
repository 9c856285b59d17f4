//! Limits of a step.

use serde::{Deserialize, Serialize};

/// Limits of a step.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct StepLimit {
    /// Largest stable step Δt, s.
    pub step: f64,
    /// 2/ω, the contacts alone, s.
    pub elastic: f64,
    /// 2/λ, the drag alone, s.
    pub viscous: f64,
    /// The grain that moves most in the mode of strongest drag.
    pub grain: usize,
}
