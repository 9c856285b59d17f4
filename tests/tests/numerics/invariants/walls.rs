//! Mirror and right angle with walls, gravity and a free surface.

use sph_core::Vect;

use sph_tests::{assembled, scene};

use crate::invariants::{States, fly, states};

/// Rounding of 1e-16 in positions, times the stiffness of pressure and a hundred steps.
const ROUNDING: f64 = 1e-12;

/// A column of water in a tank that is turned by quarter turns and perhaps mirrored.
fn tank(place: impl Fn([f64; 2]) -> [f64; 2], mirrored: bool) -> States {
    let show = |p: [f64; 2]| {
        let [x, y] = place(p);
        format!("[{x:?}, {y:?}]")
    };
    // The fluid is on the left of travel.
    let mut corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(show);
    if mirrored {
        corners.reverse();
    }
    let cornered = |a: [f64; 2], b: [f64; 2]| {
        let (a, b) = (place(a), place(b));
        let low: [f64; 2] = std::array::from_fn(|k| a[k].min(b[k]));
        let high: [f64; 2] = std::array::from_fn(|k| a[k].max(b[k]));
        format!("[{low:?}, {high:?}]")
    };
    let origin = place([0.0, 0.0]);
    let down = place([0.0, -10.0]);
    let gravity: [f64; 2] = std::array::from_fn(|k| down[k] - origin[k]);
    let top = place([0.0, 0.53125]);
    let surface = -(gravity[0] * top[0] + gravity[1] * top[1]) / 10.0;
    let text = format!(
        "title = \"turned\"
dimension = 2
run.end = 1
[numerics]
spacing = 0.0625
gravity = {gravity:?}
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
[wall.tank]
polyline = [{}]
closed = true
condition = \"no-slip\"
[phase.water]
density = 1000.0
speed_of_sound = 30.0
[phase.water.rheology.newtonian]
viscosity = \"1 Pa s\"
[body.column]
phase = \"water\"
box = [[0.0, 0.0], [1.0, 1.0]]
subtract = [{{ box = {} }}, {{ box = {} }}]
pressure = \"hydrostatic\"
surface = {surface:?}
",
        corners.join(", "),
        // The lattice is that of the whole tank, which every turn leaves as it is.
        cornered([0.40625, 0.0], [1.0, 1.0]),
        cornered([0.0, 0.53125], [1.0, 1.0]),
    );
    let mut parts = assembled(&scene(&text, &[]));
    fly(&mut parts, 100, Some(1e-3));
    states(&parts)
}

/// Largest distance of a particle of `other`, brought back, to the one of `plain` in its place.
fn apart(plain: &States, other: &States, back: impl Fn(&Vect<2>) -> Vect<2>) -> f64 {
    assert_eq!(plain.len(), other.len());
    let nearest = |x: Vect<2>| {
        let distances = plain.iter().map(|(y, _)| (x - y).norm());
        distances.fold(f64::INFINITY, f64::min)
    };
    other
        .iter()
        .fold(0.0, |most: f64, (x, _)| most.max(nearest(back(x))))
}

#[test]
fn a_dam_break_is_the_same_mirrored_and_turned() {
    let plain = tank(|p| p, false);
    let start: f64 = plain.iter().map(|(_, u)| u.norm()).fold(0.0, f64::max);
    assert!(start > 0.3, "the column hardly moves: {start} m/s");
    let mirrored = tank(|[x, y]| [1.0 - x, y], true);
    let most = apart(&plain, &mirrored, |x| Vect::<2>::new(1.0 - x[0], x[1]));
    assert!(most < ROUNDING, "mirrored: {most:e} m");
    let turned = tank(|[x, y]| [1.0 - y, x], false);
    let most = apart(&plain, &turned, |x| Vect::<2>::new(x[1], 1.0 - x[0]));
    assert!(most < ROUNDING, "turned: {most:e} m");
    let upside = tank(|[x, y]| [1.0 - x, 1.0 - y], false);
    let most = apart(&plain, &upside, |x| Vect::<2>::new(1.0 - x[0], 1.0 - x[1]));
    assert!(most < ROUNDING, "upside down: {most:e} m");
}
