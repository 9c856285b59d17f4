//! What scenes of turbulence are refused for, and what laminar ones do not carry.

use sph_particles::setup::examine;
use sph_scene::parse;

use crate::turbulence::CHANNEL;
use crate::turbulence::phases::OVER_A_BED;

#[test]
fn misfits_are_refused_with_the_expected_value() {
    let no_slip = CHANNEL.replace("condition = \"free-slip\"", "");
    let vertices = CHANNEL.replace("vertices = false", "vertices = true");
    let thin = CHANNEL.replace("1 mPa s", "0 Pa s");
    let with = |closure: &str| format!("{CHANNEL}{closure}");
    let cases = [
        (
            no_slip.clone(),
            "write `condition = \"free-slip\"` in `[wall.bed]`",
        ),
        (vertices, "`vertices = false`"),
        (thin, "`rheology.newtonian` with a viscosity"),
        (
            CHANNEL.replace("walls = [\"bed\"]", "walls = [\"bad\"]"),
            "did you mean `bed`",
        ),
        (
            CHANNEL.replace("walls = [\"bed\"]", "walls = [\"bed\"]\nroughness = 0.02"),
            "at most the spacing",
        ),
        (
            with("[eddy-viscosity.k-epsilon]\nenergy = 1.0\n"),
            "both `energy` and `dissipation`",
        ),
        (
            with("[eddy-viscosity.k-epsilon]\nenergy = -1.0\ndissipation = 1.0\n"),
            "energy",
        ),
        (
            with("[eddy-viscosity.smagorinsky]\ndamping = \"van-driest\"\n"),
            "condition = \"no-slip\"",
        ),
        (
            with("[eddy-viscosity.mixing-length]\nwalls = [\"bod\"]\n"),
            "there is no wall `bod`",
        ),
        (
            with("[flow-control.bulk-velocity]\nvelocity = 1.0\naxis = \"y\"\n"),
            "[numerics.periodic]",
        ),
        (
            with("[eddy-viscosity.k-epsilon]\nenergy = 1.0\ndissipation = 1.0\n")
                .replace("[wall-function.log-law]\nwalls = [\"bed\"]\n", "")
                .replace("condition = \"free-slip\"", ""),
            "[wall-function.log-law]",
        ),
    ];
    assert_refused(&cases);
}

#[test]
fn misfits_of_several_phases_are_refused_with_the_expected_value() {
    let with = |closure: &str| format!("{OVER_A_BED}[eddy-viscosity.smagorinsky]\n{closure}\n");
    let water = "phases = [\"water\"]\n";
    let soil = OVER_A_BED.replace(
        "rheology.newtonian = { viscosity = \"1e5 Pa s\" }",
        "rheology.bingham = { viscosity = \"1 Pa s\", yield_stress = \"10 Pa\", regularisation.ratio.ratio = 1000 }",
    );
    let cases = [
        (with(""), "phases = [\"syrup\", \"water\"]"),
        (with("phases = [\"watr\"]"), "did you mean `water`"),
        (
            format!("{soil}[eddy-viscosity.smagorinsky]\nphases = [\"syrup\"]\n"),
            "phase `syrup` has none",
        ),
        (
            with(&format!("{water}bed = {{ phase = \"sirup\" }}")),
            "did you mean `syrup`",
        ),
        (
            with(&format!("{water}bed = {{ phase = \"water\" }}")),
            "cannot be its own bed",
        ),
        (
            with(&format!(
                "{water}bed = {{ phase = \"syrup\", roughness = 0.02 }}"
            )),
            "0 to the spacing",
        ),
        (
            OVER_A_BED.to_owned() + "[eddy-viscosity.k-epsilon]\nphases = [\"water\"]\n",
            "k and ε at the start are missing",
        ),
        (
            OVER_A_BED.to_owned()
                + "[eddy-viscosity.k-epsilon]\nphases = [\"water\"]\nenergy = 1.0\ndissipation = -1.0\n",
            "dissipation",
        ),
    ];
    assert_refused(&cases);
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
    let loaded = parse(&good, "scene.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    examine(&loaded.scene).unwrap_or_else(|e| panic!("{e}"));
    let cases = [
        (
            entering("turbulent_energy = -1.0"),
            "is positive, and -1 m²/s² comes in here: write such a value",
        ),
        (
            entering("dissipation = 0.0"),
            "is positive, and 0 m²/s³ comes in here: write such a value",
        ),
        (entering("disipation = 1.0"), "did you mean `dissipation`"),
        (entering("velocity = 1.0"), "no plugin of this scene"),
    ];
    assert_refused(&cases);
}

fn assert_refused(cases: &[(String, &str)]) {
    for (text, expected) in cases {
        let refused = match parse(text, "scene.toml", &[]) {
            Err(error) => error.to_string(),
            Ok(loaded) => match examine(&loaded.scene) {
                Err(error) => error.to_string(),
                Ok(_) => panic!("accepted, where `{expected}` was expected:\n{text}"),
            },
        };
        assert!(
            refused.contains(expected),
            "`{expected}` is not in: {refused}"
        );
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
    let loaded = parse(&plain, "scene.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    let examined = examine(&loaded.scene).unwrap_or_else(|e| panic!("{e}"));
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
