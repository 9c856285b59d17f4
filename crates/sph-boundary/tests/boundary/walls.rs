//! Geometry of walls: what is accepted, what is refused and with which words.

use sph_boundary::{
    BoundaryError, ElementTree, Mesh, PeriodicBox, Polyline, Pose, WallEnd, thin_plate,
};

use crate::close;

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];

/// A rectangle with the fluid outside.
fn block(name: &str, [x, y]: [f64; 2], [u, v]: [f64; 2]) -> Polyline {
    Polyline::closed(name, vec![[x, y], [x, v], [u, v], [u, y]])
}

fn channel() -> PeriodicBox {
    PeriodicBox {
        lower: [0.0; 2],
        upper: [4.0, 2.0],
        periodic: [true, false],
    }
}

fn build(lines: &[Polyline]) -> Result<Mesh<2>, BoundaryError> {
    Mesh::<2>::build(lines, 0.5, &PeriodicBox::none())
}

fn message(lines: &[Polyline]) -> String {
    build(lines).unwrap_err().to_string()
}

#[test]
fn a_square_is_cut_into_equal_segments() {
    let mesh = build(&[Polyline::closed("tank", SQUARE.to_vec())]).unwrap();
    assert_eq!((mesh.elements.len(), mesh.nodes.len()), (16, 16));
    for (s, segment) in mesh.elements.iter().enumerate() {
        assert_eq!(segment.measure, 0.5);
        assert_eq!((segment.face, segment.wall), (s / 4, 0));
        assert_eq!(segment.nodes, [s, (s + 1) % 16]);
    }
    assert_eq!(mesh.elements[5].normal, [-1.0, 0.0], "into the square");
    for (v, vertex) in mesh.nodes.iter().enumerate() {
        assert_eq!(vertex.theta, if v % 4 == 0 { 0.25 } else { 0.5 });
        assert_eq!(mesh.beside[v], [Some((v + 15) % 16), Some(v)]);
    }
    let outside = build(&[Polyline::closed("block", SQUARE.to_vec()).reversed()]).unwrap();
    assert_eq!(outside.nodes[0].theta, 0.75, "re-entrant");
}

#[test]
fn a_wall_along_a_period_closes_onto_itself() {
    let floor = Polyline::open("floor", vec![[0.0, 0.0], [4.0, 0.0]]);
    let mesh = Mesh::<2>::build(&[floor], 0.5, &channel()).unwrap();
    assert_eq!((mesh.elements.len(), mesh.nodes.len()), (8, 8));
    assert!(mesh.free_ends.is_empty());
    let last = mesh.elements[7];
    assert_eq!((last.nodes, last.images), ([7, 0], [[0, 0], [1, 0]]));
    assert_eq!(last.centre, [3.75, 0.0]);
    assert!(mesh.nodes.iter().all(|v| v.theta == 0.5));
}

#[test]
fn a_slope_across_the_seam_gets_its_angle_from_the_other_side() {
    let roof = Polyline::open("roof", vec![[0.0, 0.0], [2.0, 2.0], [4.0, 0.0]]);
    let mesh = Mesh::<2>::build(&[roof], 0.5, &channel()).unwrap();
    close(mesh.nodes[0].theta, 0.25, 1e-15, "a valley at the seam");
}

#[test]
fn open_walls_are_joined_end_to_end() {
    let floor = Polyline::open("floor", vec![[0.0, 2.0], [0.0, 0.0], [2.0, 0.0]]);
    let rest = Polyline::open("rest", vec![[2.0, 0.0], [2.0, 2.0], [0.0, 2.0 + 1e-9]]);
    let mesh = build(&[floor.clone(), rest.clone()]).unwrap();
    assert_eq!((mesh.elements.len(), mesh.nodes.len()), (16, 16));
    assert!(mesh.free_ends.is_empty());
    assert_eq!(mesh.elements[15].nodes, [15, 0]);
    let opposed = message(&[floor.clone(), rest.reversed()]);
    let why = "the first end of wall `floor` meets the first end of wall `rest`";
    assert!(opposed.starts_with(why), "{opposed}");
    let spur = Polyline::open("spur", vec![[2.0, 0.0], [3.0, 0.0]]);
    assert!(message(&[floor, rest, spur]).starts_with("3 ends of walls meet at (2, 0)"));
}

#[test]
fn free_ends_are_refused_near_particles_only() {
    let mesh = build(&[Polyline::open("floor", vec![[0.0, 0.0], [9.0, 0.0]])]).unwrap();
    let ends: Vec<WallEnd> = mesh.free_ends.iter().map(|free| free.end).collect();
    assert_eq!(ends, [WallEnd::First, WallEnd::Last]);
    assert_eq!(mesh.nodes[0].theta, 0.5);
    mesh.check_free_ends(&[[4.0, 0.5], [2.1, 0.5]], 2.0)
        .unwrap();
    let refused = mesh.check_free_ends(&[[4.0, 0.5], [8.5, 1.0], [8.5, 0.0]], 2.0);
    assert_eq!(
        refused.unwrap_err().to_string(),
        "the last end of wall `floor` at (9, 0) is free and particle 2 is 0.5 m away, within the \
         kernel radius 2 m: close the wall or extend it"
    );
}

#[test]
fn degenerate_walls_are_named() {
    let open = |points: &[[f64; 2]]| [Polyline::open("gate", points.to_vec())];
    let refused: [(&[[f64; 2]], _); 3] = [
        (&[], " has 0 point(s), at least two are needed"),
        (
            &[[0.0, 0.0], [1.0, f64::NAN]],
            ": point 1 has a coordinate that is not finite",
        ),
        (
            &[[0.0, 0.0], [1.0, 0.5], [1.0, 0.5]],
            ": edge 1 has zero length, points 1 and 2 are both at (1, 0.5)",
        ),
    ];
    for (points, why) in refused {
        assert_eq!(message(&open(points)), format!("wall `gate`{why}"));
    }
    let repeated = Polyline::closed("gate", vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]);
    assert!(message(&[repeated]).contains("points 3 and 0"));
    assert!(Mesh::<2>::build(&[], 0.0, &PeriodicBox::none()).is_err());
    assert!(build(&[]).unwrap().elements.is_empty());
}

#[test]
fn crossings_are_named_and_touching_is_allowed() {
    let tank = Polyline::closed("tank", SQUARE.to_vec());
    let bow = Polyline::closed("bow", vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(
        message(&[bow]),
        "edge 0 of wall `bow` crosses edge 2 of wall `bow` near (0.5, 0.5)"
    );
    let pipe = Polyline::open("pipe", vec![[1.0, 1.0], [3.0, 1.0]]);
    // Told of the first in the order given.
    assert_eq!(
        message(&[tank.clone(), pipe]),
        "edge 1 of wall `tank` crosses edge 0 of wall `pipe` near (2, 1)"
    );
    build(&[tank, block("block", [0.5, 0.0], [1.5, 1.0])]).unwrap();
    // Across the periodic side.
    let post = block("post", [3.5, 0.5], [4.5, 1.0]);
    let other = block("other", [0.2, 0.7], [0.8, 1.5]);
    build(&[post.clone(), other.clone()]).unwrap();
    let across = Mesh::<2>::build(&[post, other], 0.5, &channel());
    let refused = across.expect_err("they cross").to_string();
    assert!(refused.contains(" crosses edge "), "{refused}");
}

#[test]
fn a_closed_wall_without_area_must_be_a_plate() {
    let plate = Polyline::closed("plate", vec![[0.0, 0.0], [1.0, 2.0]]);
    let mesh = build(&[plate]).unwrap();
    assert_eq!(mesh.nodes[0].theta, 1.0);
    // Two triangles of opposite orientation that meet in a point.
    let mut bow = vec![[-2.0, -1.0], [0.0, 0.0], [2.0, 1.0]];
    bow.extend([[2.0, -1.0], [0.0, 0.0], [-2.0, 1.0]]);
    assert_eq!(
        message(&[Polyline::closed("bow", bow)]),
        "wall `bow` is closed but encloses no area, and edge 0 is not retraced in the opposite direction as it would be \
         on a plate of zero thickness"
    );
}

#[test]
fn short_edges_are_remarked_upon() {
    let plate = thin_plate("plate", &[[0.0, 0.0], [2.0, 0.0]], 0.01).unwrap();
    let mesh = build(&[plate]).unwrap();
    assert_eq!(mesh.elements.len(), 10, "caps are one segment");
    assert_eq!(
        mesh.warnings[0],
        "edge 1 of wall `plate` is 0.01 m long, far shorter than the spacing 0.5 m"
    );
    assert_eq!(mesh.warnings.len(), 2);
}

#[test]
fn the_grid_finds_what_a_search_over_everything_finds() {
    let domain = channel();
    let floor = Polyline::open("floor", vec![[0.0, 0.0], [2.0, 0.3], [4.0, 0.0]]);
    let post = block("post", [3.8, 0.8], [4.3, 1.2]);
    let mesh = Mesh::<2>::build(&[floor, post], 0.2, &domain).unwrap();
    let tree = ElementTree::build(&mesh, 0.6);
    let distance = |p: [f64; 2], [a, b]: [[f64; 2]; 2]| {
        let t = [b[0] - a[0], b[1] - a[1]];
        let part = ((p[0] - a[0]) * t[0] + (p[1] - a[1]) * t[1]) / (t[0] * t[0] + t[1] * t[1]);
        let part = part.clamp(0.0, 1.0);
        (a[0] + part * t[0] - p[0]).hypot(a[1] + part * t[1] - p[1])
    };
    for i in 0..400 {
        let point = [0.01 * f64::from(i), 0.05 + 0.0371 * f64::from(i % 50)];
        let found = tree.near(&mesh, point, 0.5);
        let found: Vec<_> = found.map(|near| (near.index(), near.image[0])).collect();
        let mut expected = Vec::new();
        for s in 0..mesh.elements.len() {
            for image in -2..=2 {
                let moved = |[x, y]: [f64; 2]| [x + 4.0 * f64::from(image), y];
                if distance(point, mesh.corners(s).map(moved)) < 0.5 {
                    expected.push((s, image));
                }
            }
        }
        assert_eq!(found, expected, "at {point:?}");
    }
    assert_eq!(tree.near(&mesh, [1.0, 900.0], 0.5).count(), 0);
}

fn sides(mesh: &Mesh<2>, inside: &[[f64; 2]], outside: &[[f64; 2]]) {
    inside
        .iter()
        .for_each(|p| assert!(mesh.contains(*p), "{p:?}"));
    outside
        .iter()
        .for_each(|p| assert!(!mesh.contains(*p), "{p:?}"));
}

#[test]
fn inside_of_tanks_blocks_plates_and_channels() {
    let tank = Polyline::closed("tank", SQUARE.to_vec());
    let block = block("block", [0.5, 0.0], [1.5, 1.0]);
    let plate = thin_plate("plate", &[[0.2, 1.2], [1.8, 1.7]], 0.0).unwrap();
    let mesh = build(&[tank, block.clone(), plate]).unwrap();
    let inside: &[_] = &[
        [0.25, 0.5],
        [1.0, 1.2],
        [1.0, 1.9],
        [0.5, 1.5],
        [1.999, 1e-9],
    ];
    let left_and_right = [[-0.1, 1.0], [5.0, 1.0], [1.0, 0.5]];
    let below_and_above = [[1.0, -0.1], [1.0, 2.1], [1.0, 1e-9]];
    sides(&mesh, inside, &[left_and_right, below_and_above].concat());
    let alone = build(&[block]).unwrap();
    sides(
        &alone,
        &[[9.0, 9.0], [1.0, 2.0], [1.0, -1.0]],
        &[[1.0, 0.5]],
    );
    let floor = Polyline::open("floor", vec![[0.0, 0.0], [4.0, 0.0]]);
    let lid = Polyline::open("lid", vec![[4.0, 2.0], [0.0, 2.0]]);
    let ball = self::block("ball", [3.5, 0.5], [4.5, 1.0]);
    let open = Mesh::<2>::build(&[floor.clone(), ball.clone()], 0.5, &channel()).unwrap();
    let closed = Mesh::<2>::build(&[floor, lid, ball], 0.5, &channel()).unwrap();
    for mesh in [&open, &closed] {
        let inside = [[2.0, 1.0], [0.0, 0.2], [3.9, 1.2]];
        sides(mesh, &inside, &[[2.0, -0.1], [0.2, 0.7], [3.7, 0.7]]);
    }
    assert!(open.contains([2.0, 7.0]) && !closed.contains([2.0, 7.0]));
    assert!(build(&[]).unwrap().contains([0.0, 0.0]));
}

#[test]
fn walls_move_from_their_reference() {
    let tank = Polyline::closed("tank", SQUARE.to_vec());
    let gate = thin_plate("gate", &[[1.0, 0.5], [1.0, 1.0]], 0.1).unwrap();
    let mut mesh = build(&[tank, gate]).unwrap();
    let at_rest = mesh.clone();
    let lifted = Pose {
        translation: [0.0, 0.7],
        ..Pose::default()
    };
    mesh.move_walls(&[Pose::default(), lifted]).unwrap();
    assert_eq!(mesh.nodes[..16], at_rest.nodes[..16]);
    let [lifted, before] = [&mesh, &at_rest].map(|mesh| mesh.nodes[16].position[1]);
    assert_eq!(lifted, before + 0.7);
    assert_eq!(mesh.elements[16].normal, at_rest.elements[16].normal);
    let turn = Pose::turned_about([0.0, 0.0, 1.0], std::f64::consts::PI, [1.0, 0.75]);
    mesh.move_walls(&[Pose::default(), turn]).unwrap();
    let opposite = mesh.elements[16].normal;
    close(
        opposite[0],
        -at_rest.elements[16].normal[0],
        1e-14,
        "turned",
    );
    mesh.move_walls(&[Pose::default(); 2]).unwrap();
    assert_eq!(&mesh.nodes, &at_rest.nodes, "exactly back");
    assert_eq!(&mesh.elements, &at_rest.elements, "exactly back");
    assert_eq!(
        mesh.move_walls(&[]).unwrap_err().to_string(),
        "0 pose(s) given for 2 wall(s)"
    );
}

#[test]
fn joined_and_periodic_walls_cannot_be_torn() {
    let left = Polyline::open("left", vec![[0.0, 0.0], [2.0, 0.0]]);
    let right = Polyline::open("right", vec![[2.0, 0.0], [4.0, 0.0]]);
    let mut mesh = Mesh::<2>::build(&[left, right], 0.5, &channel()).unwrap();
    let up = Pose {
        translation: [0.0, 0.1],
        ..Pose::default()
    };
    let torn = mesh.move_walls(&[Pose::default(), up]).unwrap_err();
    assert_eq!(
        torn.to_string(),
        "walls `left` and `right` are joined at (2, 0) and cannot move differently"
    );
    mesh.move_walls(&[up; 2]).unwrap();
    let turn = Pose::turned_about([0.0, 0.0, 1.0], 0.1, [0.0; 2]);
    let refused = mesh.move_walls(&[turn; 2]).unwrap_err();
    assert!(refused.to_string().contains("cannot rotate"));
}
