//! What is refused, and with which words.

use sph_boundary::{Mesh, PeriodicBox, Surface};

use crate::surface::shapes::*;

fn message(walls: &[Surface], spacing: f64) -> String {
    let groups = vec![0; walls.len()];
    let refused = Mesh::<3>::build(walls, &groups, spacing, &PeriodicBox::none());
    refused.unwrap_err().to_string()
}

fn one(change: impl Fn(&mut Surface)) -> String {
    let mut cube = block("cube", [0.0; 3], [1.0; 3]);
    change(&mut cube);
    message(&[cube], 0.1)
}

#[test]
fn points_and_corners() {
    assert_eq!(one(|s| s.triangles.clear()), "wall `cube` has no triangle");
    let point = one(|s| s.points[3][1] = f64::NAN);
    assert_eq!(
        point,
        "wall `cube`: point 3 has a coordinate that is not finite"
    );
    let corner = one(|s| s.triangles[5][2] = 8);
    assert_eq!(
        corner,
        "wall `cube`: triangle 5 has the corner 8, there are 8 points"
    );
    assert!(mesh(&[], 1.0).contains([0.0; 3]));
    let none = PeriodicBox::none();
    assert!(Mesh::<3>::build(&[], &[], 0.0, &none).is_err());
    let cube = block("cube", [0.0; 3], [1.0; 3]);
    let refused = Mesh::<3>::build(&[cube], &[], 0.1, &none).unwrap_err();
    assert_eq!(refused.to_string(), "0 group(s) given for 1 wall(s)");
}

#[test]
fn degenerate_triangles() {
    let flat = one(|s| s.triangles[4] = [3, 3, 1]);
    assert_eq!(flat, "wall `cube`: triangle 4 at (1, 1, 0) has no area");
    let thin = one(|s| {
        s.points.push([0.5, 1e-7, 0.0]);
        s.triangles[4] = [0, 1, 8];
    });
    assert_eq!(
        thin,
        "wall `cube`: triangle 4 at (0, 0, 0) is a needle: 0.0000001 m high on an edge of 1 m"
    );
}

#[test]
fn neighbours() {
    let flipped = one(|s| s.triangles[6].swap(0, 1));
    let named = flipped.starts_with("wall `cube`: triangles ") && flipped.contains(" 6 ");
    let why = "put the fluid on opposite sides: one of them is flipped";
    assert!(named && flipped.ends_with(why), "{flipped}");
    let fin = one(|s| {
        s.points.push([0.5, -1.0, 0.0]);
        s.triangles.push([0, 1, 8]);
    });
    assert_eq!(
        fin,
        "wall `cube`: 3 triangles meet in one edge at (0.5, 0, 0), the first is 1: the surface is \
         not a manifold there, draw the bodies as walls of their own"
    );
    let twice = one(|s| s.triangles.push([2, 3, 0]));
    let why = "wall `cube`: triangles 0 and 12 at (0, 0, 0) have the same corners";
    assert_eq!(twice, why);
    let both = one(|s| s.triangles.push([0, 3, 2]));
    let named = both.contains("triangles 0 and 12 lie on each other");
    assert!(
        named && both.contains("give the plate a thickness"),
        "{both}"
    );
}

#[test]
fn sizes() {
    assert_eq!(
        message(&[block("pea", [0.0; 3], [0.1; 3])], 0.1),
        "wall `pea` is 0.17320508075688776 m across, less than two spacings of 0.1 m: draw it \
         larger, check the unit of length, or take a smaller spacing"
    );
    let walls = [
        block("pea", [0.0; 3], [1.0; 3]),
        block("sea", [5.0; 3], [4005.0; 3]),
    ];
    assert_eq!(
        message(&walls, 0.5),
        "the walls would be cut into about 768000048 triangles, 20000000 at most: `sea` alone \
         needs 768000000; check the unit of length or use a coarser spacing"
    );
    let fine = mesh(&[icosphere(4, 1.0)], 0.5);
    assert_eq!(
        fine.warnings[0],
        "5120 of the 5120 triangles of wall `ball` are far smaller than the spacing 0.5 m: draw \
         it coarser"
    );
    assert!(mesh(&[icosphere(4, 1.0)], 0.1).warnings.is_empty());
}

#[test]
fn crossing_walls() {
    let cube = block("cube", [0.0; 3], [1.0; 3]);
    let post = block("post", [0.4, 0.4, 0.3], [0.6, 0.6, 1.7]);
    let crossing = message(&[cube.clone(), post.clone()], 0.1);
    let both = [
        "of wall `cube` crosses triangle ",
        "of wall `post` near (0.",
    ];
    assert!(
        both.iter().all(|part| crossing.contains(part)),
        "{crossing}"
    );
    // Of other groups too.
    let walls = [cube.clone(), post];
    assert!(Mesh::<3>::build(&walls, &[0, 1], 0.1, &PeriodicBox::none()).is_err());
    // Through the wall itself.
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    let mut twisted = prism("twisted", &outline, [0.0, 1.0], true);
    twisted.points[4] = [2.5, 2.2, 1.0];
    assert!(message(&[twisted], 0.1).contains("of wall `twisted` crosses triangle"));
    // Across a periodic side.
    let domain = periodic([0.0; 3], [2.0; 3], [true, false, false]);
    let arm = block("arm", [1.5, 0.4, 0.4], [2.5, 0.6, 0.6]);
    let refused = Mesh::<3>::build(&[cube.clone(), arm], &[0, 0], 0.1, &domain);
    let crossing = refused.unwrap_err().to_string();
    assert!(crossing.contains("crosses"), "{crossing}");
    let shift = block("next", [0.5, 0.0, 1.0], [1.5, 1.0, 2.0]);
    mesh(&[cube, shift], 0.1);
}

#[test]
fn pieces_drawn_twice() {
    let cube = block("cube", [0.0; 3], [1.0; 3]);
    let other = block("other", [0.3, 0.3, 0.2], [0.8, 0.7, 1.0]);
    let twice = message(&[cube.clone(), other.clone()], 0.1);
    let both = twice.contains("of wall `cube` and triangle ");
    assert!(
        both && twice.ends_with("that piece is drawn twice"),
        "{twice}"
    );
    let again = message(&[cube.clone(), cube.clone()], 0.1);
    assert!(again.contains("drawn twice"), "{again}");
    // A plate of two walls is nothing.
    let sheet = |name: &str| Surface {
        name: name.into(),
        ..floor([0.0; 2], [1.0; 2])
    };
    let plate = message(&[sheet("front"), sheet("back").reversed()], 0.1);
    assert_eq!(
        plate,
        "nothing is left of wall `front`: other walls cover all of it, or face away from its edges: turn the one that faces the other way, leave the wall out, or give a plate of two sides a thickness"
    );
    // One wall folded flat.
    let mut folded = sheet("folded");
    folded.triangles.extend([[0, 3, 1], [1, 3, 2]]);
    assert!(message(&[folded], 0.1).contains("give the plate a thickness"));
}
