//! What scenes of turbulence are refused for, and what laminar ones do not carry.

use sph_particles::setup::examine;
use sph_tests::{Says, assembly_refuses, refusal, scene};

use crate::turbulence::CHANNEL;
use crate::turbulence::phases::OVER_A_BED;

#[test]
fn misfits_are_refused_with_the_expected_value() {
    assembly_refuses(CHANNEL, include_str!("channel.refused"));
    let bare = CHANNEL
        .replace("[wall-function.log-law]\nwalls = [\"bed\"]\n", "")
        .replace("condition = \"free-slip\"", "");
    let closure = "[eddy-viscosity.k-epsilon]\nenergy = 1.0\ndissipation = 1.0\n";
    refusal::<2>(&(bare + closure)).says("[wall-function.log-law]");
}

#[test]
fn misfits_of_several_phases_are_refused_with_the_expected_value() {
    assembly_refuses(OVER_A_BED, include_str!("phases.refused"));
}

/// The channel between an inlet and an outlet, with k–ε and what comes in as a table says.
fn entering(values: &str) -> String {
    const SCENE: &str = include_str!("../../../../scenes/channel-open-2d.toml");
    let inlet = SCENE.replace(
        "profile = \"parabola\"\n",
        &format!("profile = \"parabola\"\nvalues = {{ {values} }}\n"),
    );
    assert_ne!(inlet, SCENE);
    let slipping = inlet
        .replace("[wall.outlet]", "condition = \"free-slip\"\n[wall.outlet]")
        .replace("[wall.inlet]", "condition = \"free-slip\"\n[wall.inlet]");
    slipping + "[eddy-viscosity.k-epsilon]\nenergy = 1e-3\ndissipation = 1e-3\n"
}

#[test]
fn inflow_has_eddies_or_is_refused() {
    let good = entering("turbulent_energy = 1e-3, dissipation = 1e-3");
    examine(&scene(&good, &[])).unwrap_or_else(|e| panic!("{e}"));
    let negative = "is positive, and -1 m²/s² comes in here: write such a value";
    let nothing = "is positive, and 0 m²/s³ comes in here: write such a value";
    for (values, told) in [
        ("turbulent_energy = -1.0", negative),
        ("dissipation = 0.0", nothing),
        ("disipation = 1.0", "did you mean `dissipation`"),
        ("velocity = 1.0", "no plugin of this scene"),
    ] {
        refusal::<2>(&entering(values)).says(told);
    }
}

/// Without a closure there is no column of it, and the laminar part of the channel's scene is that of any other.
#[test]
fn a_laminar_scene_carries_nothing_of_turbulence() {
    let plain = CHANNEL
        .replace("[wall-function.log-law]\nwalls = [\"bed\"]\n", "")
        .replace(
            "[probe.bed]\nkind = \"friction-velocity\"\nwall = \"bed\"\n",
            "",
        );
    let examined = examine(&scene(&plain, &[])).unwrap_or_else(|e| panic!("{e}"));
    for field in &examined.fields {
        let name = field.name.as_str();
        let of_turbulence = [
            "eddy_viscosity",
            "wall_friction",
            "friction_velocity",
            "strain_rate",
        ];
        assert!(!of_turbulence.contains(&name), "{name}");
    }
}
