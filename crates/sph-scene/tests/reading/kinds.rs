//! Kinds of plugins as the crates of the physics declare them. No plugin is here: names and parameters are not checked.

use sph_core::reexport::inventory;
use sph_core::{Place, PluginKind};

macro_rules! declared {
    ($($kind:literal $place:ident),* $(,)?) => {
        $(inventory::submit! { PluginKind::new($kind, Place::$place, "of scenes of these tests") })*
    };
}

declared!(
    "kernel" One,
    "formulation" One,
    "integrator" One,
    "walls" One,
    "viscous-operator" One,
    "implicit-viscosity" One,
    "linear-solver" One,
    "velocity-gradient" One,
    "elastic-force" One,
    "effective-pressure" One,
    "pressure" One,
    "seepage" One,
    "eddy-viscosity" One,
    "smoother" One,
    "shifting" One,
    "interface" Any,
    "term" Any,
    "equation-of-state" InPhase,
    "rheology" InPhase,
    "mover" InWall,
    "open-boundary" InWall,
    "probe" Probe,
    "solution" Solution,
);
