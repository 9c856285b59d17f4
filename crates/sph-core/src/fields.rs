//! The well-known fields. A plugin may declare others; the name is what counts.

/// Declares fields: `pub NAME: Kind = "name", "unit", "meaning";`, with more documentation behind the meaning.
#[macro_export]
macro_rules! fields {
    ($($(#[$doc:meta])* $vis:vis $field:ident: $kind:ident = $name:literal, $unit:literal, $meaning:literal;)+) => {$(
        #[doc = $meaning]
        #[doc = ""]
        $(#[$doc])*
        $vis const $field: $crate::Field<$crate::$kind> = $crate::Field::new($name, $unit, $meaning);
    )+};
}

fields! {
    pub POSITION: Vector = "position", "m", "position";
    pub VELOCITY: Vector = "velocity", "m/s", "velocity";
    pub ACCELERATION: Vector = "acceleration", "m/s²", "rate of change of the velocity";
    pub MASS: Scalar = "mass", "kg", "mass (per metre of depth in 2D)";
    pub DENSITY: Scalar = "density", "kg/m³", "density";
    pub VOLUME: Scalar = "volume", "m^d", "volume, mass over density";
    pub PRESSURE: Scalar = "pressure", "Pa", "pressure of the equation of state";
    /// A column where it differs between particles.
    pub VISCOSITY: Scalar = "viscosity", "Pa s", "dynamic viscosity";
    /// Zero in phases where no stage reads it.
    pub VELOCITY_GRADIENT: Tensor = "velocity_gradient", "1/s", "gradient of the velocity, ∂u_i/∂x_j";
    /// Zero in phases where no stage reads it.
    pub STRAIN_RATE: Scalar = "strain_rate", "1/s", "magnitude √(2 D:D) of the deviatoric strain rate D";
    pub EDDY_VISCOSITY: Scalar = "eddy_viscosity", "Pa s", "viscosity of unresolved eddies";
    /// 0 out of reach of its walls.
    pub WALL_FRICTION: Scalar = "wall_friction", "Pa s/m",
        "shear stress of the wall function over the speed along the wall";
    /// Volume of the grains that a fluid carries over its own at the reference density.
    pub CONCENTRATION: Scalar = "concentration", "1", "volume of suspended grains per volume";
    /// Source of friction.
    pub EFFECTIVE_PRESSURE: Scalar = "effective_pressure", "Pa", "pressure between the grains of a soil";
    /// Pressure of the water beside it, too.
    pub PORE_PRESSURE: Scalar = "pore_pressure", "Pa", "pressure of the water in the pores of a soil";
    pub ELASTIC_STRESS: SymmetricTensor = "elastic_stress", "Pa",
        "remembered deviatoric stress of the elastic part (xx, yy, zz, xy, yz, xz)";
    /// Its divergence moves the material.
    pub CARRIED_STRESS: SymmetricTensor = "carried_stress", "Pa",
        "deviatoric elastic stress that acts (xx, yy, zz, xy, yz, xz)";
    pub ELASTIC_STIFFNESS: Scalar = "elastic_stiffness", "Pa",
        "shear modulus times the share that acts: of the step to come, which is solved for with the viscosity";
    pub ELASTIC_DISPLACEMENT: Vector = "elastic_displacement", "m",
        "way of an elastic material since it was last liquid";
    /// Since the material was last liquid: ∫(ωτ − τω)dt.
    pub STRESS_ROTATION: SymmetricTensor = "stress_rotation", "Pa",
        "what turns have made of the remembered stress (xx, yy, zz, xy, yz, xz)";
    pub FRICTION_SHARE: Scalar = "friction_share", "1", "share ζ of the viscous force in a material that blends";
    /// Of its elastic stress, if it blends stresses.
    pub SOLID_FRACTION: Scalar = "solid_fraction", "1", "share 1 − ζ of the elastic force in a material that blends";
    pub YIELD_FACTOR: Scalar = "yield_factor", "1", "min(1, τ_y/|τ|): what the yield stress leaves of an elastic force";
    /// Its adjoint makes the force of a stress exact.
    pub STRESS_CORRECTION: Tensor = "stress_correction", "1", "what makes the plain velocity gradient exact";
    pub RENORMALISATION: Scalar = "renormalisation", "1",
        "wall renormalisation factor γ, the share of the kernel inside the walls";
    /// s(x) ∫ s(y) w(x − y) dy = 1 over the fluid's side; 1 away from walls.
    pub SCALE: Scalar = "wall_scale", "1", "symmetric scale s of the kernel next to walls";
    pub SCALE_SLOPE: Vector = "wall_scale_slope", "1/m",
        "gradient of ln s, s the symmetric scale of the kernel next to walls";
    /// ∂ ln s/∂t, where walls that scale the kernel move.
    pub SCALE_RATE: Scalar = "wall_scale_rate", "1/s", "rate of ln s at a fixed place by the motion of walls";
    /// The part of the initial state that the density sum does not see.
    pub DENSITY_CONSTANT: Scalar = "density_constant", "kg/m³", "K = γρ − mΣθw, holds the free-surface deficit";
    /// From density diffusion.
    pub DENSITY_CONSTANT_RATE: Scalar = "density_constant_rate", "kg/m³/s", "rate of change of the density constant";
    /// A column where a formulation integrates the density and something else than motion changes it.
    pub DENSITY_RATE: Scalar = "density_rate", "kg/m³/s", "rate of change of the density, from density diffusion";
    /// A column where a formulation integrates the volume and something else than motion changes it.
    pub VOLUME_RATE: Scalar = "volume_rate", "m^d/s", "rate of change of the volume, from density diffusion";
    /// Besides that of the flow.
    pub SHIFT_VELOCITY: Vector = "shift_velocity", "m/s", "velocity of the shifting that keeps particles evenly spread";
    /// A pressure is in balance with it besides gravity.
    pub MEAN_ACCELERATION: Vector = "mean_acceleration", "m/s²",
        "acceleration, averaged over the time in which sound passes some smoothing lengths";
    pub VOID_FRACTION: Scalar = "void_fraction", "1",
        "1 - sum of volume times kernel over the renormalisation; 0 within reach of free surfaces and of wall points";
    /// Only on request.
    pub DISPLACEMENT: Vector = "displacement", "m",
        "way from where the particle was at the start, across periodic borders";
    /// In the scene's order of names.
    pub PHASE: Index = "phase", "1", "number of the phase";
    /// Follows the particle through every sort.
    pub IDENTITY: Index = "identity", "1", "number given at filling";
}
