//! Causes of unrest of grains.

use thiserror::Error;

/// Causes of unrest of grains.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Unrest {
    /// The mean resultant force on a grain, over the mean contact force: [`unbalanced_force`](crate::grains::GrainSystem::unbalanced_force).
    #[error("the unbalanced force ratio is {0:.3e}")]
    Unbalanced(f64),
    /// A grain whose weight nothing balances: it falls, or something hits it.
    #[error("nothing carries grain {0}")]
    NotCarried(usize),
    /// A piston whose load nothing balances.
    #[error("no grain carries the piston, wall {0}")]
    Piston(usize),
    /// The mean speed of the grains, that of their surfaces by spin added, m/s.
    #[error("the grains move with {0:.3e} m/s in the mean")]
    Moving(f64),
}
