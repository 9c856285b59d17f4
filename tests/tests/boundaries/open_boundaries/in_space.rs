//! Open faces in space, `[wall.NAME.open-boundary.PLUGIN]` on triangles.

use sph_tests::{finished, near, same_bits, within};

use super::{assert_refused, missing, number, passed, stays_uniform};

/// A duct of four by five by eight rows between an inlet and an outlet.
const DUCT: &str = include_str!("duct.toml");

#[test]
fn inflow_less_outflow_is_the_change_of_mass() {
    let run = finished(DUCT, 2);
    let passed = passed(&run.summary);
    let entered = number(passed, "inlet.mud", "entered");
    // ρ u S t, with the density that the pressure at the face makes: that of friction, in a duct full of mud at most. A
    // duct of 0.5 by 0.4 m has f Re = 57 (Shah & London 1978), 14 Pa/m here, and ρc² is 230 Pa.
    let denser = 14.0 * 0.8 / (1.6 * 12.0 * 12.0);
    let over = entered / (1.6 * 0.2 * 0.6) - 1.0;
    within(over, 0.0..denser, "share that came in over ρuSt");
    let missing = missing(&run, 0.16);
    assert!(missing.abs() < 1e-12, "{missing:e} of it is missing");
    assert!(number(passed, "outlet.water", "died") > 0.05, "{passed}");
}

#[test]
fn particles_come_and_go_at_the_same_step_with_the_same_bits_on_any_threads_and_resumed() {
    same_bits(DUCT, 60, &[2, 4], |_| ());
}

/// A duct without friction with a flow that is the same everywhere: nothing may change it. Bounds are those of the
/// plane.
#[test]
fn a_uniform_flow_passes_both_faces_as_if_they_were_not_there() {
    let text = DUCT
        .replace("phase = \"mud\"\n", "phase = \"water\"\n")
        .replace("[wall.duct]", "[wall.duct]\ncondition = \"free-slip\"")
        .replace("end = 0.6", "end = 2.0")
        .replace("every = 0.6", "every = 2.0");
    let run = finished(&text, 2);
    passed(&run.summary);
    stays_uniform::<3>(&run);
}

/// A river of six rows: a rate comes in below the surface, a level stands behind the outlet.
#[test]
fn a_rate_comes_in_and_leaves_below_a_level() {
    let text = DUCT
        .replace(
            "spacing = 0.1\n",
            "spacing = 0.1\ngravity = [0.0, 0.0, -9.81]\n",
        )
        .replace(
            "0.4]]\nopen = [\"x-\", \"x+\"]",
            "0.8]]\nopen = [\"x-\", \"x+\"]\ncondition = \"free-slip\"",
        )
        .replace("0.4]]\nopen", "0.8]]\nopen")
        .replace(
            "0.4]]\nvelocity = [1.0",
            "0.6]]\npressure = \"hydrostatic\"\nvelocity = [0.5",
        )
        .replace(
            "[wall.inlet.open-boundary.velocity-inlet]\nvelocity = \"1 m/s\"\nphase = \"mud\"",
            "[wall.inlet.open-boundary.flow-rate]\nrate = 0.15\nphase = \"water\"",
        )
        .replace(
            "[wall.outlet.open-boundary.outflow]\nmemory = \"1 s\"",
            "[wall.outlet.open-boundary.level]\nlevel = \"0.6 m\"",
        )
        .replace("speed_of_sound = 12.0", "speed_of_sound = 35.0");
    let run = finished(&text, 2);
    let passed = passed(&run.summary);
    let entered = number(passed, "inlet.water", "entered");
    near(entered, 0.15 * 0.6, 0.005, "m³ of the rate");
    let left = number(passed, "outlet.water", "left");
    assert!(left > 0.5 * 0.15 * 0.6, "{passed}");
}

#[test]
fn profiles_that_a_face_cannot_have_are_refused_at_their_key() {
    let key = "wall.inlet.open-boundary.velocity-inlet.profile";
    let with = |profile: &str| DUCT.replace("phase = \"mud\"", &format!("profile = {profile}"));
    assert_refused::<3>(&with("{ polynomial = [0, 4, -4] }"), key, "is a surface");
    let corner = with("\"duct\"").replace(
        "open = [\"x+\", \"y-\", \"y+\", \"z-\", \"z+\"]",
        "open = [\"x+\", \"y-\", \"z-\", \"z+\"]",
    );
    let corner = corner.replace("open = [\"x-\", \"x+\"]", "open = [\"x-\", \"x+\", \"y+\"]");
    assert_refused::<3>(&corner, key, "a plane rectangle");
}
