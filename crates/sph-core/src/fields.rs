//! The well-known fields. A plugin may declare others; the name is what counts.

use crate::{Field, Index, Scalar, SymmetricTensor, Tensor, Vector};

/// Position of a particle.
pub const POSITION: Field<Vector> = Field::new("position", "m", "position");
/// Velocity of a particle.
pub const VELOCITY: Field<Vector> = Field::new("velocity", "m/s", "velocity");
/// Rate of change of the velocity.
pub const ACCELERATION: Field<Vector> =
    Field::new("acceleration", "m/s²", "rate of change of the velocity");
/// Mass of a particle, per metre of depth in two dimensions.
pub const MASS: Field<Scalar> = Field::new("mass", "kg", "mass (per metre of depth in 2D)");
/// Density.
pub const DENSITY: Field<Scalar> = Field::new("density", "kg/m³", "density");
/// Volume, mass over density.
pub const VOLUME: Field<Scalar> = Field::new("volume", "m^d", "volume, mass over density");
/// Pressure of the equation of state.
pub const PRESSURE: Field<Scalar> =
    Field::new("pressure", "Pa", "pressure of the equation of state");
/// Dynamic viscosity where it differs between particles.
pub const VISCOSITY: Field<Scalar> = Field::new("viscosity", "Pa s", "dynamic viscosity");
/// Gradient of the velocity, ∂u_i/∂x_j; zero in phases where no stage reads it.
pub const VELOCITY_GRADIENT: Field<Tensor> = Field::new(
    "velocity_gradient",
    "1/s",
    "gradient of the velocity, ∂u_i/∂x_j",
);
/// Magnitude γ̇ = √(2 D:D) of the deviatoric strain rate D; zero in phases where no stage reads it.
pub const STRAIN_RATE: Field<Scalar> = Field::new(
    "strain_rate",
    "1/s",
    "magnitude √(2 D:D) of the deviatoric strain rate D",
);
/// Viscosity of the eddies that particles do not resolve.
pub const EDDY_VISCOSITY: Field<Scalar> =
    Field::new("eddy_viscosity", "Pa s", "viscosity of unresolved eddies");
/// Shear stress of a wall function over the speed along the wall; 0 out of reach of its walls.
pub const WALL_FRICTION: Field<Scalar> = Field::new(
    "wall_friction",
    "Pa s/m",
    "shear stress of the wall function over the speed along the wall",
);
/// Pressure between the grains of a soil, which makes friction.
pub const EFFECTIVE_PRESSURE: Field<Scalar> = Field::new(
    "effective_pressure",
    "Pa",
    "pressure between the grains of a soil",
);
/// Pressure of the water in the pores of a soil, and of the water beside it.
pub const PORE_PRESSURE: Field<Scalar> = Field::new(
    "pore_pressure",
    "Pa",
    "pressure of the water in the pores of a soil",
);
/// Deviatoric stress of the elastic part of a material, as it is remembered.
pub const ELASTIC_STRESS: Field<SymmetricTensor> = Field::new(
    "elastic_stress",
    "Pa",
    "remembered deviatoric stress of the elastic part (xx, yy, zz, xy, yz, xz)",
);
/// Deviatoric stress whose divergence moves the material.
pub const CARRIED_STRESS: Field<SymmetricTensor> = Field::new(
    "carried_stress",
    "Pa",
    "deviatoric elastic stress that acts (xx, yy, zz, xy, yz, xz)",
);
/// Shear modulus of the acting material, for the strain of the step to come.
pub const ELASTIC_STIFFNESS: Field<Scalar> = Field::new(
    "elastic_stiffness",
    "Pa",
    "shear modulus times the share that acts: of the step to come, which is solved for with the viscosity",
);
/// Way of an elastic material since it was last liquid.
pub const ELASTIC_DISPLACEMENT: Field<Vector> = Field::new(
    "elastic_displacement",
    "m",
    "way of an elastic material since it was last liquid",
);
/// Contribution of rotations to the remembered stress since the material was last liquid: ∫(ωτ − τω)dt.
pub const STRESS_ROTATION: Field<SymmetricTensor> = Field::new(
    "stress_rotation",
    "Pa",
    "what turns have made of the remembered stress (xx, yy, zz, xy, yz, xz)",
);
/// Share of the viscous force in a material that blends its forces.
pub const FRICTION_SHARE: Field<Scalar> = Field::new(
    "friction_share",
    "1",
    "share ζ of the viscous force in a material that blends",
);
/// Share of the elastic stress or force in a material that blends.
pub const SOLID_FRACTION: Field<Scalar> = Field::new(
    "solid_fraction",
    "1",
    "share 1 − ζ of the elastic force in a material that blends",
);
/// Factor of an elastic force by the yield stress.
pub const YIELD_FACTOR: Field<Scalar> = Field::new(
    "yield_factor",
    "1",
    "min(1, τ_y/|τ|): what the yield stress leaves of an elastic force",
);
/// Correction that makes the plain velocity gradient exact, and its adjoint the force of a stress.
pub const STRESS_CORRECTION: Field<Tensor> = Field::new(
    "stress_correction",
    "1",
    "what makes the plain velocity gradient exact",
);
/// Wall renormalisation factor γ: the share of the kernel inside the walls.
pub const RENORMALISATION: Field<Scalar> = Field::new(
    "renormalisation",
    "1",
    "wall renormalisation factor γ, the share of the kernel inside the walls",
);
/// s of walls that scale the kernel: s(x) ∫ s(y) w(x − y) dy = 1 over the fluid's side; 1 away from walls.
pub const SCALE: Field<Scalar> = Field::new(
    "wall_scale",
    "1",
    "symmetric scale s of the kernel next to walls",
);
/// ∇ ln s of walls that scale the kernel.
pub const SCALE_SLOPE: Field<Vector> = Field::new(
    "wall_scale_slope",
    "1/m",
    "gradient of ln s, s the symmetric scale of the kernel next to walls",
);
/// ∂ ln s/∂t at a fixed place, where walls that scale the kernel move.
pub const SCALE_RATE: Field<Scalar> = Field::new(
    "wall_scale_rate",
    "1/s",
    "rate of ln s at a fixed place by the motion of walls",
);
/// K = γρ − mΣθw: the part of the initial state that the density sum does not see.
pub const DENSITY_CONSTANT: Field<Scalar> = Field::new(
    "density_constant",
    "kg/m³",
    "K = γρ − mΣθw, holds the free-surface deficit",
);
/// Rate of change of [`DENSITY_CONSTANT`], from density diffusion.
pub const DENSITY_CONSTANT_RATE: Field<Scalar> = Field::new(
    "density_constant_rate",
    "kg/m³/s",
    "rate of change of the density constant",
);
/// Rate of change of the density, where a formulation integrates it and something else than
/// motion changes it.
pub const DENSITY_RATE: Field<Scalar> = Field::new(
    "density_rate",
    "kg/m³/s",
    "rate of change of the density, from density diffusion",
);
/// Rate of change of the volume, where a formulation integrates it and something else than motion
/// changes it.
pub const VOLUME_RATE: Field<Scalar> = Field::new(
    "volume_rate",
    "m^d/s",
    "rate of change of the volume, from density diffusion",
);
/// Velocity of particles besides that of the flow, which keeps their arrangement even.
pub const SHIFT_VELOCITY: Field<Vector> = Field::new(
    "shift_velocity",
    "m/s",
    "velocity of the shifting that keeps particles evenly spread",
);
/// The mean over time of the acceleration of a particle, which a pressure is in balance with besides gravity.
pub const MEAN_ACCELERATION: Field<Vector> = Field::new(
    "mean_acceleration",
    "m/s²",
    "acceleration, averaged over the time in which sound passes some smoothing lengths",
);
/// Empty fraction of a particle's neighbourhood, by its arrangement.
pub const VOID_FRACTION: Field<Scalar> = Field::new(
    "void_fraction",
    "1",
    "1 - sum of volume times kernel over the renormalisation; 0 within reach of free surfaces and of wall points",
);
/// Way from where a particle was at the start, across periodic borders. Only on request.
pub const DISPLACEMENT: Field<Vector> = Field::new(
    "displacement",
    "m",
    "way from where the particle was at the start, across periodic borders",
);
/// Number of the phase in the scene's order of names.
pub const PHASE: Field<Index> = Field::new("phase", "1", "number of the phase");
/// Number given at filling; follows the particle through every sort.
pub const IDENTITY: Field<Index> = Field::new("identity", "1", "number given at filling");
