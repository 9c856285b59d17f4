//! All mistakes of a scene are told at once, those in tables of plugins too.

use sph_tests::{DAM_BREAK, bench, refusals};

#[test]
fn mistakes_of_scene_and_plugins_are_told_in_one_go() {
    // With a mistake in the form of the scene, and with one in what it says.
    let unit = "`mmm` is not a unit that is known, expected one like `m`";
    let vector = "expected 2 numbers in 2D, found 3";
    for (own, told) in [
        ("numerics.spacing=5mmm", unit),
        ("numerics.gravity=[0,-9.81,0]", vector),
    ] {
        let bench = bench!(DAM_BREAK);
        let refused = bench.refused(&format!(
            "check scene.toml --set {own} --set kernel.wendland-c3={{}} --set integrator.leap-frog.curant=1"
        ));
        refused.says(&format!(
            "{told} | did you mean `wendland-c2`? | did you mean `courant`?"
        ));
    }
}

#[test]
fn allowed_tables_of_a_place_are_listed() {
    let bench = bench!(DAM_BREAK);
    let refused = bench.refused("check scene.toml --set output.picture_range=big");
    refused.says("expected a list or a table, found the string \"big\"");
}

/// Names of plugins are known before those of keys are right, also of plugins that stand in a wall, a phase, a body.
#[test]
fn plugins_within_walls_phases_bodies_and_probes_are_told_with_a_misspelt_key() {
    let bench = bench!(&DAM_BREAK.replace("1 mPa s", "1 mm^2/s"));
    let checked = bench.refused(
        "check scene.toml --set wall.tank.clsed=true --set wall.tank.mover.sprin={} \
         --set phase.water.equation-of-state.tate={} --set body.column.initial.poiseuile={} \
         --set probe.front.kind=frnt --set wall.tank.open-boundary.levl={}",
    );
    for name in ["closed", "spring", "tait", "poiseuille", "front", "level"] {
        checked.says(&format!("did you mean `{name}`?"));
    }
    // A kinematic viscosity is no mistake.
    checked.says("6 problems");
}

/// A plugin that nothing in the scene would build is refused as well.
#[test]
fn a_plugin_that_the_scene_has_no_use_for_is_checked_too() {
    let open = DAM_BREAK.replace("[wall.tank]", "[walls.tank]");
    let bench = bench!(&open.replace("[walls.usaw]\n", ""));
    let refused = bench.refused("check scene.toml");
    refused.says("there is no walls called `tank`");
}

/// One message at one place: what stands there, and where it belongs.
#[test]
fn a_table_in_the_wrong_place_is_led_to_the_right_one() {
    for case in refusals(include_str!("mistakes.refused")) {
        let (bench, told) = (bench!(&case.of(DAM_BREAK)), case.said[0]);
        let refused = bench.refused("check scene.toml");
        assert_eq!(
            refused.err.matches(told).count(),
            1,
            "{told}: {}",
            refused.err
        );
    }
}

/// Walls, phases and bodies may have the names of plugins; a misspelt key is told as anywhere.
#[test]
fn names_of_plugins_are_good_names() {
    let scene = DAM_BREAK
        .replace("wall.tank", "wall.spring")
        .replace("probe.front", "probe.pressure");
    assert_eq!(bench!(&scene).call("check scene.toml").code, Some(0));
    let checked = bench!(&scene)
        .call("check scene.toml --set wall.spring.clsed=true --set probe.pressure.axs=x");
    checked.says("did you mean `closed`?");
    assert!(!checked.err.contains("NAME"), "{}", checked.err);
    // A number is no plugin.
    let checked = bench!(DAM_BREAK).call("check scene.toml --set numerics.pressure=3");
    checked.says("(valid here: ");
}
