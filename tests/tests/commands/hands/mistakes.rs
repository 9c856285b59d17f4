//! All mistakes of a scene are told at once, those in tables of plugins too.

use sph_tests::DAM_BREAK;

use crate::hands::with;

#[test]
fn mistakes_of_scene_and_plugins_are_told_in_one_go() {
    // With a mistake in the form of the scene, and with one in what it says.
    for (own, told) in [
        (
            "numerics.spacing=5mmm",
            "`mmm` is not a unit that is known, expected one like `m`",
        ),
        (
            "numerics.gravity=[0,-9.81,0]",
            "expected 2 numbers in 2D, found 3",
        ),
    ] {
        let bench = with(DAM_BREAK);
        let checked = bench.call(&format!(
            "check scene.toml --set {own} --set kernel.wendland-c3={{}} --set integrator.leap-frog.curant=1"
        ));
        assert_eq!(checked.code, Some(2), "{}", checked.out);
        for told in [
            told,
            "did you mean `wendland-c2`?",
            "did you mean `courant`?",
        ] {
            assert!(
                checked.err.contains(told),
                "{told} is not in {}",
                checked.err
            );
        }
    }
}

#[test]
fn allowed_tables_of_a_place_are_listed() {
    let bench = with(DAM_BREAK);
    let checked = bench.call("check scene.toml --set output.picture_range=big");
    assert_eq!(checked.code, Some(2));
    let told = "expected a list or a table, found the string \"big\"";
    assert!(checked.err.contains(told), "{}", checked.err);
}

/// Names of plugins are known before those of keys are right, also of plugins that stand in a wall, a phase, a body.
#[test]
fn plugins_within_walls_phases_bodies_and_probes_are_told_with_a_misspelt_key() {
    let bench = with(&DAM_BREAK.replace("1 mPa s", "1 mm^2/s"));
    let checked = bench.call(
        "check scene.toml --set wall.tank.clsed=true --set wall.tank.mover.sprin={} \
         --set phase.water.equation-of-state.tate={} --set body.column.initial.poiseuile={} \
         --set probe.front.kind=frnt --set wall.tank.open-boundary.levl={}",
    );
    assert_eq!(checked.code, Some(2), "{}", checked.out);
    for told in [
        "did you mean `closed`?",
        "did you mean `spring`?",
        "did you mean `tait`?",
        "did you mean `poiseuille`?",
        "did you mean `front`?",
        "did you mean `level`?",
    ] {
        assert!(checked.err.contains(told), "{told}: {}", checked.err);
    }
    // A kinematic viscosity is no mistake.
    assert!(checked.err.contains("6 problems"), "{}", checked.err);
}

/// A plugin that nothing in the scene would build is refused as well.
#[test]
fn a_plugin_that_the_scene_has_no_use_for_is_checked_too() {
    let open = DAM_BREAK.replace("[wall.tank]", "[walls.tank]");
    let bench = with(&open.replace("[walls.usaw]\n", ""));
    let checked = bench.call("check scene.toml");
    assert_eq!(checked.code, Some(2), "{}", checked.out);
    let told = "there is no walls called `tank`";
    assert!(checked.err.contains(told), "{}", checked.err);
}

/// One message at one place: what stands there, and where it belongs.
#[test]
fn a_table_in_the_wrong_place_is_led_to_the_right_one() {
    const LAW: &str = "[phase.water.rheology.newtonian]";
    let instead = |from: &str, to: &str| DAM_BREAK.replace(from, to);
    let besides = |table: &str| format!("{DAM_BREAK}\n{table}\n");
    let cases = [
        (
            besides("[probe.pressure]\nat = [0.1, 0.1]"),
            "`kind = \"pressure\"`?",
        ),
        (
            besides("[gauge.presure]\nat = [0.1, 0.1]"),
            "`kind = \"pressure\"`?",
        ),
        (
            besides("[probe.gate.pressure]\nat = [0.1, 0.1]"),
            "`kind = \"pressure\"`?",
        ),
        (
            besides("[probe.gate]\ntype = \"pressure\""),
            "`kind = \"pressure\"`?",
        ),
        (besides("[probe.zzz]"), ", one of angular-momentum, "),
        (
            besides("[reference.v.poiseuille]"),
            "`[reference.v]` with `solution = \"poiseuille\"`",
        ),
        (
            besides("[reference.poiseuille]"),
            "`[reference.NAME]` with `solution = \"poiseuille\"`",
        ),
        (instead(LAW, "[phase.water.newtonian]"), LAW),
        (
            instead(LAW, "[phase.rheology.newtonian]"),
            "`[phase.NAME.rheology.newtonian]`",
        ),
        (
            instead(LAW, "[phase.newtonian]"),
            "`[phase.NAME.rheology.newtonian]`",
        ),
        (
            instead(LAW, "[rheology.newtonian]"),
            "`[phase.NAME.rheology.newtonian]`",
        ),
        (
            instead(LAW, "[phase.water.rheology]\nkind = \"newtonian\""),
            LAW,
        ),
        (
            besides("[kernel]\nkind = \"wendland-c2\""),
            "`[kernel.wendland-c2]`",
        ),
        (
            besides("[kernel]\nname = \"wendland-c3\""),
            "`[kernel.PLUGIN]`",
        ),
        (
            besides("[phase.kernel.wendland-c2]"),
            "`[kernel.wendland-c2]`",
        ),
        (besides("[wall.tank.spring]"), "`[wall.tank.mover.spring]`"),
        (
            besides("[wall.tank.mover]\nmass = 1.0\nkind = \"spring\""),
            "`[wall.tank.mover.spring]`",
        ),
        (besides("[mover.spring]"), "`[wall.NAME.mover.spring]`"),
        (besides("[wall.usaw]"), "`[walls.usaw]`"),
        (
            besides("[body.column.initial]\nkind = \"poiseuille\""),
            "`[body.column.initial.poiseuille]`",
        ),
        (
            instead("[numerics]", "[numerics]\nkernel = \"wendland-c2\""),
            "`[kernel.wendland-c2]`",
        ),
        (
            besides("[output.front]"),
            "`[probe.NAME]` with `kind = \"front\"`",
        ),
        (instead("[wall.tank]", "[wall]"), "`[wall.NAME]`"),
        (instead("[body.column]", "[body]"), "`[body.NAME]`"),
        (besides("[[gauge]]\nkind = \"front\""), "`[gauge.NAME]`"),
        (
            format!("kernel = \"wendland-c2\"\n{DAM_BREAK}"),
            "`[kernel.wendland-c2]`",
        ),
    ];
    for (scene, told) in cases {
        let bench = with(&scene);
        let checked = bench.call("check scene.toml");
        assert_eq!(checked.code, Some(2), "{told}: {}", checked.out);
        assert!(checked.err.contains(told), "{told}: {}", checked.err);
        let at = checked.err.matches(told).count();
        assert_eq!(at, 1, "{told}: {}", checked.err);
    }
}

/// Walls, phases and bodies may have the names of plugins; a misspelt key is told as anywhere.
#[test]
fn names_of_plugins_are_good_names() {
    let scene = DAM_BREAK
        .replace("wall.tank", "wall.spring")
        .replace("probe.front", "probe.pressure");
    assert_eq!(with(&scene).call("check scene.toml").code, Some(0));
    let checked = with(&scene)
        .call("check scene.toml --set wall.spring.clsed=true --set probe.pressure.axs=x");
    assert!(
        checked.err.contains("did you mean `closed`?"),
        "{}",
        checked.err
    );
    assert!(!checked.err.contains("NAME"), "{}", checked.err);
    // A number is no plugin.
    let checked = with(DAM_BREAK).call("check scene.toml --set numerics.pressure=3");
    assert!(checked.err.contains("(valid here: "), "{}", checked.err);
}
