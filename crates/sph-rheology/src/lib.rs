//! Constitutive laws on slices: effective viscosity and stress
