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
fn what_may_stand_in_a_place_is_told() {
    let bench = with(DAM_BREAK);
    let checked = bench.call("check scene.toml --set output.picture_range=big");
    assert_eq!(checked.code, Some(2));
    let told = "expected a list or a table, found the string \"big\"";
    assert!(checked.err.contains(told), "{}", checked.err);
}
