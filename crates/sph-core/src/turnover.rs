//! Outflow and inflow of a store while a flow ran.

/// Particles of one phase that one outlet has taken out of a store.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Removed {
    /// Number of the outlet.
    pub outlet: u32,
    /// Number of the phase.
    pub phase: u32,
    /// Mass, kg (per metre of depth in 2D).
    pub mass: f64,
    /// Number of particles.
    pub particles: u64,
}

/// Particles that came into a store after the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inserted {
    /// Identities that were given so far, those of the start included: none of them is given again.
    pub identities: u32,
    /// Mass that came in after the start, kg (per metre of depth in two dimensions).
    pub mass: f64,
    /// Particles that came in after the start.
    pub particles: u64,
}
