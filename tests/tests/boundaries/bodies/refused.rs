//! What no body can be, and where it is said.

use sph_tests::Bench;

use crate::bodies::{FLOAT, PROGRAM};

/// What `sph check` says of the scene with a piece of text exchanged, which must be at the line of `place`.
fn message(from: &str, to: &str, place: &str) -> String {
    assert!(FLOAT.contains(from), "{from}");
    let scene = FLOAT.replacen(from, to, 1);
    let bench = Bench::with(PROGRAM, &scene);
    let outcome = bench.call("run scene.toml --quiet --out r");
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    assert!(!bench.path("r").exists(), "something was written");
    let line = scene
        .lines()
        .position(|l| l.contains(place))
        .expect("a line");
    let at = format!("scene.toml:{}:", line + 1);
    assert!(outcome.err.contains(&at), "not at {at} {}", outcome.err);
    outcome.err
}

const BODY: &str = "density = 500.0";

#[test]
fn bodies_without_volume_or_too_light_are_refused() {
    let said = message(BODY, "density = 19.0", "density = 19.0");
    assert!(said.contains("a fiftieth is the least"), "{said}");
    let said = message(BODY, "mass = 0.39", "mass = 0.39");
    assert!(said.contains("a fiftieth is the least"), "{said}");
    let drawn = "box = [[0.3, 0.2], [0.5, 0.3]]\nfluid = \"outside\"";
    let open = "polyline = [[0.3, 0.3], [0.5, 0.3], [0.5, 0.2]]";
    let said = message(drawn, open, "[wall.float.mover.rigid-body]");
    assert!(said.contains("encloses no volume"), "{said}");
    let vessel = "polygon = [[0.3, 0.2], [0.5, 0.2], [0.5, 0.3], [0.3, 0.3]]";
    let said = message(drawn, vessel, "[wall.float.mover.rigid-body]");
    assert!(said.contains("fluid = \"outside\""), "{said}");
}

#[test]
fn masses_centres_and_inertias_that_no_body_has_are_refused() {
    let said = message(BODY, "", "[wall.float.mover.rigid-body]");
    assert!(said.contains("a `density` or a `mass`"), "{said}");
    let said = message(BODY, "density = 500.0\nmass = 3.0", "mass = 3.0");
    assert!(said.contains("not both"), "{said}");
    let said = message(BODY, "mass = 9.0\ncentre = [0.4, 0.22]", "centre = [");
    assert!(said.contains("`inertia`"), "{said}");
    let said = message(BODY, "mass = 9.0\ninertia = [1.0, 2.0]", "inertia = [");
    assert!(said.contains("2 numbers, 1 are expected"), "{said}");
    let said = message(BODY, "mass = 9.0\ninertia = [-1.0]", "inertia = [");
    assert!(said.contains("no body has it"), "{said}");
}

#[test]
fn freedoms_holds_and_lines_that_are_not_there_are_refused() {
    let said = message(BODY, "density = 500.0\nfree = [\"y\", \"rx\"]", "free = [");
    assert!(said.contains("there is no `rx` in 2D: x, y, rz"), "{said}");
    let said = message(BODY, "density = 500.0\nfree = []", "free = [");
    assert!(said.contains("nothing is free"), "{said}");
    let held = "density = 500.0\nfree = [\"y\"]\nhold = { x = { stiffness = 3.0 } }";
    let said = message(BODY, held, "hold = {");
    assert!(said.contains("`x` is not free"), "{said}");
    let line = |from: &str| {
        format!(
            "density = 500.0\n[[wall.float.mover.rigid-body.line]]\nfrom = {from}\n\
             to = [0.4, 0.2]\nstiffness = 100.0"
        )
    };
    let said = message(BODY, &line("[0.4, -0.3]"), "to = [0.4, 0.2]");
    assert!(said.contains("goes through the wall `tank`"), "{said}");
    let said = message(BODY, &line("[0.4, 0.0, 0.0]"), "from = [0.4, 0.0, 0.0]");
    assert!(said.contains("3 numbers, 2 are expected"), "{said}");
}

#[test]
fn chains_that_cannot_hang_are_refused() {
    let chain = |more: &str| {
        format!(
            "density = 500.0\n[[wall.float.mover.rigid-body.line]]\nfrom = [0.2, 0.0]\n\
             to = [0.4, 0.2]\nstiffness = 1e4\n{more}"
        )
    };
    for (more, place, why) in [
        ("weight = 5.0", "weight = 5.0", "needs its `length`"),
        (
            "weight = 5.0\nlength = 0.25",
            "length = 0.25",
            "too short to hang",
        ),
        (
            "weight = 5.0\nlength = 0.3\ndamping = 2.0",
            "damping = 2.0",
            "has no damping",
        ),
        ("length = 0.3\nbed = true", "bed = true", "is straight"),
    ] {
        let said = message(BODY, &chain(more), place);
        assert!(said.contains(why), "{said}");
    }
    // The way between its ends is free, but what hangs there is not.
    let sill = "[wall.sill]\nbox = [[0.3, 0.0], [0.34, 0.1]]\nfluid = \"outside\"\n[wall.float]";
    let scene = FLOAT.replacen("[wall.float]", sill, 1);
    let chain = chain("weight = 5.0\nlength = 0.3\nbed = false");
    let bench = Bench::with(PROGRAM, &scene.replacen(BODY, &chain, 1));
    let outcome = bench.call("run scene.toml --quiet --out r");
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    let named = outcome.err.contains("goes through the wall `sill`");
    assert!(named, "{}", outcome.err);
}

#[test]
fn bodies_that_overlap_at_the_start_are_refused() {
    for other in ["[[0.45, 0.25], [0.6, 0.4]]", "[[0.35, 0.22], [0.45, 0.28]]"] {
        let two = format!(
            "[wall.other]\nbox = {other}\nfluid = \"outside\"\n[wall.other.mover.rigid-body]\n\
             density = 700.0\n[phase.water]"
        );
        let scene = FLOAT.replacen("[phase.water]", &two, 1);
        let bench = Bench::with(PROGRAM, &scene);
        let outcome = bench.call("run scene.toml --quiet --out r");
        assert_eq!(outcome.code, Some(2), "{}", outcome.err);
        assert!(outcome.err.contains("[wall."), "{}", outcome.err);
        let named = outcome.err.contains("other") && outcome.err.contains("float");
        assert!(named, "{}", outcome.err);
    }
}

#[test]
fn walls_that_fluid_clings_to_are_refused() {
    let said = message(
        "vertices = false",
        "vertices = true",
        "[wall.float.mover.rigid-body]",
    );
    assert!(said.contains("vertices = false"), "{said}");
}

#[test]
fn times_that_are_not_one_after_the_other_are_refused() {
    let twice = |first: &str, second: &str| {
        let times = format!("prescribed = [{{ {first} }},\n{{ {second} }}]");
        message(BODY, &format!("{BODY}\n{times}"), second)
    };
    let said = twice(
        "from = \"1 s\", to = \"3 s\"",
        "from = \"2 s\", to = \"4 s\"",
    );
    assert!(said.contains("2 s is before 3 s"), "{said}");
    let course = "course = [[3.0, 0.0, 0.1, 0.0], [3.5, 0.0, 0.1, 0.0]]";
    let said = twice(
        "from = \"1 s\", to = \"3 s\"",
        &format!("from = \"3 s\", to = \"4 s\", {course}"),
    );
    assert!(said.contains("does not cover 3 to 4 s"), "{said}");
}
