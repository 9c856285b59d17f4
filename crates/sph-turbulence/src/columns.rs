//! Columns of turbulence.

use sph_core::{Field, Scalar};

sph_core::fields! {
    /// Friction velocity u* = √(τ_w/ρ) that the wall function finds at a particle; 0 where it sees no such wall.
    pub FRICTION_VELOCITY: Scalar = "friction_velocity", "m/s",
        "friction velocity of the wall function at the particle; 0 out of reach of its walls";
    /// Distance from the nearest wall, as far as it is looked for.
    pub WALL_DISTANCE: Scalar = "wall_distance", "m", "distance from the nearest wall";
    /// Turbulent kinetic energy k over mass.
    pub TURBULENT_ENERGY: Scalar = "turbulent_energy", "m²/s²", "turbulent kinetic energy over mass";
    /// Rate of [`TURBULENT_ENERGY`] by diffusion.
    pub TURBULENT_ENERGY_RATE: Scalar = "turbulent_energy_rate", "m²/s³",
        "rate of the turbulent kinetic energy by diffusion";
    /// Dissipation rate ε of the turbulent energy.
    pub DISSIPATION: Scalar = "dissipation", "m²/s³", "dissipation rate of the turbulent kinetic energy";
    pub DISSIPATION_RATE: Scalar = "dissipation_rate", "m²/s⁴", "rate of the dissipation by diffusion";
    /// Distance from the nearest wall in wall units, z⁺ = z u*/ν; infinite out of reach.
    pub WALL_UNITS: Scalar = "wall_units", "1",
        "distance from the wall in wall units, z+ = z u*/nu; infinite out of reach";
    /// Friction velocity at a particle on a bed that is a rough wall; 0 elsewhere.
    pub BED_FRICTION_VELOCITY: Scalar = "bed_friction_velocity", "m/s",
        "friction velocity of the bed of another phase at the particle; 0 beyond a spacing";
    /// Distance of such a particle from the bed.
    pub BED_DISTANCE: Scalar = "bed_distance", "m", "distance from the bed of another phase; infinite beyond a spacing";
    /// Share of the turbulent production that counts: less at free surfaces.
    pub SURFACE_SHARE: Scalar = "surface_share", "1",
        "share of the turbulent production that counts: 1 inside, 0 at a free surface";
    /// The same of the walls that rub, as far as damping reaches.
    pub DAMPING_UNITS: Scalar = "damping_units", "1",
        "distance from the nearest wall that rubs in wall units; infinite out of reach";
    pub LAST_STRAIN: Scalar = "last_strain_rate", "1/s",
        "magnitude √(2 D:D) of the deviatoric strain rate D in the step before";
    pub EDDY_STRESS: SymmetricTensor = "eddy_stress", "Pa",
        "stress of eddies that is not along the strain (xx, yy, zz, xy, yz, xz)";
}

pub(crate) const BED: (Field<Scalar>, Field<Scalar>) = (BED_FRICTION_VELOCITY, BED_DISTANCE);
