//! Causes of unrest of grains.

/// Causes of unrest of grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unrest {
    /// The mean resultant force on a grain, over the mean contact force: [`unbalanced_force`](crate::grains::GrainSystem::unbalanced_force).
    Unbalanced(f64),
    /// A grain whose weight nothing balances: it falls, or something hits it.
    NotCarried(usize),
    /// A piston whose load nothing balances.
    Piston(usize),
    /// The mean speed of the grains, that of their surfaces by spin added, m/s.
    Moving(f64),
}

impl std::fmt::Display for Unrest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unbalanced(ratio) => write!(f, "the unbalanced force ratio is {ratio:.3e}"),
            Self::NotCarried(grain) => write!(f, "nothing carries grain {grain}"),
            Self::Piston(wall) => write!(f, "no grain carries the piston, wall {wall}"),
            Self::Moving(speed) => write!(f, "the grains move with {speed:.3e} m/s in the mean"),
        }
    }
}
