use super::*;
use crate::bodies::catenary::tests::CHAIN;
use crate::{Polyline, Surface};

#[test]
fn a_straight_line_pulls_and_never_pushes() {
    let line = Mooring {
        from: Vector3::zeros(),
        to: Vector3::new(2.0, 0.0, 0.0),
        kind: Kind::Straight(10.0, 1.0, 1.0),
    };
    let at = |x: f64, u: f64| {
        let end = Vector3::new(x, 0.0, 0.0);
        let velocity = Vector6::new(u, 0.0, 0.0, 0.0, 0.0, 0.0);
        line.pull(end, Vector3::new(0.0, 0.5, 0.0), &velocity)
    };
    let pull = at(3.0, 2.0).unwrap();
    // r × e = (0, 0.5, 0) × (1, 0, 0) = (0, 0, −0.5)
    let along = Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, -0.5);
    assert_eq!(pull.force, -along * 22.0);
    assert_eq!(pull.stiffness, along * along.transpose() * 10.0);
    assert_eq!(pull.damping, along * along.transpose());
    assert_eq!(pull.anchor, 22.0);
    assert!(at(0.9, 0.0).is_none() && at(1.1, -2.0).is_none());
}

/// In space, with gravity along no axis: minus the slope of the force is the stiffness, beside the plane of the line, too.
#[test]
fn the_stiffness_of_a_hanging_line_is_the_slope_of_its_force() {
    let catenary = Catenary {
        bed: false,
        ..CHAIN
    };
    let up = Vector3::new(0.2, -0.1, 1.0).normalize();
    let line = Mooring {
        from: Vector3::new(0.1, 0.2, 0.3),
        to: Vector3::zeros(),
        kind: Kind::Hanging(catenary, up),
    };
    let end = Vector3::new(1.2, 0.9, 0.8);
    let force = |end: Vector3<f64>| {
        let pull = line.pull(end, Vector3::zeros(), &Vector6::zeros());
        let pull = pull.expect("a pull");
        (pull.force.fixed_rows::<3>(0).into_owned(), pull.stiffness)
    };
    let (_, stiffness) = force(end);
    let step = 1e-6;
    for k in 0..3 {
        let mut way = Vector3::zeros();
        way[k] = step;
        let slope = (force(end + way).0 - force(end - way).0) / (2.0 * step);
        for i in 0..3 {
            let off = (slope[i] + stiffness[(i, k)]).abs() / stiffness.norm();
            assert!(off < 1e-6, "({i}, {k}): {off:e}");
        }
    }
}

#[test]
fn it_sees_walls_that_it_goes_through() {
    let way = |from: [f64; 3], to: [f64; 3], wall: &Drawing| crosses(from.into(), to.into(), wall);
    let wall = Drawing::Line(Polyline::open("w", vec![[1.0, -1.0], [1.0, 1.0]]));
    assert!(way([0.0, 0.0, 0.0], [2.0, 0.5, 0.0], &wall));
    assert!(!way([0.0, 0.0, 0.0], [0.9, 0.5, 0.0], &wall));
    let along = way([1.0, 0.0, 0.0], [2.0, 0.5, 0.0], &wall);
    assert!(!along, "it may begin at one");
    let along = way([1.0, 0.0, 0.0], [1.0, 0.5, 0.0], &wall);
    assert!(!along, "it may lie on one");
    let wall = Drawing::Surface(Surface {
        name: "w".into(),
        points: vec![[1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, 0.0, 2.0]],
        triangles: vec![[0, 1, 2]],
    });
    assert!(way([0.0, 0.5, 0.5], [2.0, 0.5, 0.5], &wall));
    assert!(!way([0.0, 1.5, 1.5], [2.0, 1.5, 1.5], &wall));
}
