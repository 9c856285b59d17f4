//! Whole steps of a channel with open faces beside the same with walls in their place, and of a tank with a body beside the
//! same with a wall of prescribed motion. Items are particles. What open faces and walls cost per particle near them is in
//! the difference of the cases: `docs/open-boundaries.md` and `docs/bodies.md` have it.

mod running;

use divan::Bencher;

use running::measured;

fn main() {
    divan::main();
}

/// A channel of 32 rows, 64 long; its ends are closed, open, or one another's continuation.
const CHANNEL: &str = r#"
title = "A channel"
dimension = 2
[run]
end = 1.0
[numerics]
spacing = 0.03125
smoothing_ratio = 2.0
ENDS
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
vertices = false
[wall.floor]
polyline = [[0.0, 0.0], [2.0, 0.0]]
[wall.lid]
polyline = [[2.0, 1.0], [0.0, 1.0]]
[phase.fluid]
density = 1.0
speed_of_sound = 15.0
equation-of-state.tait = { background_pressure = 1.0 }
rheology.newtonian = { viscosity = 0.1 }
[body.fluid]
phase = "fluid"
box = [[0.0, 0.0], [2.0, 1.0]]
"#;
const WALLS: &str = "[wall.inlet]\npolyline = [[0.0, 1.0], [0.0, 0.0]]\n\
                     [wall.outlet]\npolyline = [[2.0, 0.0], [2.0, 1.0]]\n";
const FACES: &str = "[wall.inlet.open-boundary.velocity-inlet]\nvelocity = 0.1\n\
                     [wall.outlet.open-boundary.outflow]\nmemory = \"1 s\"\n";
/// Name, what `[numerics]` has besides, and the ends.
const CHANNELS: [(&str, &str, [&str; 2]); 3] = [
    ("periodic", "periodic = { x = [0.0, 2.0] }", ["", ""]),
    ("walls", "", [WALLS, ""]),
    ("open faces", "", [WALLS, FACES]),
];

#[divan::bench(args = CHANNELS.map(|(name, ..)| name), sample_count = 400)]
fn channel(bencher: Bencher, case: &str) {
    let found = CHANNELS.into_iter().find(|(name, ..)| *name == case);
    let (_, numerics, ends) = found.expect("a case");
    let scene = CHANNEL.replace("ENDS", numerics) + &ends.concat();
    measured(bencher, &scene, 100);
}

/// A box of 24 by 16 spacings in a tank, floating.
const TANK: &str = r#"
title = "A box in a tank"
dimension = 2
[run]
end = 1.0
[numerics]
spacing = "12.5 mm"
smoothing_ratio = 2.0
gravity = [0.0, -9.81]
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
vertices = false
[wall.tank]
polyline = [[0.0, 0.8], [0.0, 0.0], [1.2, 0.0], [1.2, 0.8]]
condition = "free-slip"
[wall.box]
box = [[0.45, 0.3875], [0.75, 0.5875]]
fluid = "outside"
condition = "free-slip"
[phase.water]
density = 1000.0
rheology.newtonian = { viscosity = "1 mPa s" }
[body.water]
phase = "water"
box = [[0.0, 0.0], [1.2, 0.5]]
clip = true
pressure = "hydrostatic"
"#;
const BODIES: [(&str, &str); 3] = [
    ("at rest", ""),
    (
        "prescribed",
        "[wall.box.motion]\n\
         translate = { along = [0.0, 1.0], sine = { amplitude = 0.01, period = 1.0 } }\n",
    ),
    ("body", "[wall.box.mover.rigid-body]\ndensity = 500.0\n"),
];

#[divan::bench(args = BODIES.map(|(name, _)| name), sample_count = 400)]
fn tank(bencher: Bencher, case: &str) {
    let found = BODIES.into_iter().find(|(name, _)| *name == case);
    let (_, table) = found.expect("a case");
    measured(bencher, &format!("{TANK}{table}"), 100);
}
