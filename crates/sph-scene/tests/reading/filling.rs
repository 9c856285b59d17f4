//! Where particles stand.

use super::common::close;
use sph_scene::{
    BodyParticles, Offset, Polygon, Region, Scene, Shape, disturb, estimate, fill, parse,
};

fn cuboid<const D: usize>(lo: [f64; D], hi: [f64; D]) -> Shape<D> {
    Shape::Cuboid { lo, hi }
}

fn counts<const D: usize>(filled: &[BodyParticles<D>]) -> Vec<usize> {
    filled.iter().map(|f| f.positions.len()).collect()
}

/// Least distance of two particles across all bodies.
fn nearest<const D: usize>(filled: &[BodyParticles<D>]) -> f64 {
    let all: Vec<_> = filled.iter().flat_map(|f| &f.positions).collect();
    let mut least = f64::INFINITY;
    for (i, a) in all.iter().enumerate() {
        for b in &all[i + 1..] {
            let square: f64 = a.iter().zip(b.iter()).map(|(x, y)| (x - y).powi(2)).sum();
            least = least.min(square.sqrt());
        }
    }
    least
}

#[test]
fn a_box_has_rows_one_or_half_a_spacing_off_its_sides() {
    let body = [Region::whole(cuboid([0.0; 2], [1.0, 0.5]))];
    let whole = fill(&body, 0.1, Offset::None, &[None; 2]);
    assert_eq!(counts(&whole), [9 * 4]);
    assert!((whole[0].positions[0][0] - 0.1).abs() < 1e-15);
    let half = fill(&body, 0.1, Offset::Half, &[None; 2]);
    assert_eq!(counts(&half), [10 * 5]);
    assert_eq!(estimate(&body, 0.1), 50.0);
}

#[test]
fn a_box_in_space_is_filled() {
    let body = [Region::whole(cuboid([0.0; 3], [0.4, 0.5, 0.6]))];
    assert_eq!(counts(&fill(&body, 0.1, Offset::Half, &[None; 3])), [120]);
    let none = fill(&body, 0.1, Offset::None, &[None; 3]);
    assert_eq!(counts(&none), [3 * 4 * 5]);
}

#[test]
fn a_period_that_is_spanned_has_no_ends() {
    let periodic = [Some([0.0, 1.0]), None];
    let body = [Region::whole(cuboid([0.0; 2], [1.0, 0.5]))];
    let whole = fill(&body, 0.1, Offset::None, &periodic);
    assert_eq!(counts(&whole), [10 * 4]);
    assert_eq!(whole[0].positions[0][0], 0.0);
    assert_eq!(counts(&fill(&body, 0.1, Offset::Half, &periodic)), [10 * 5]);
    let both = [Some([0.0, 1.0]), Some([0.0, 0.5])];
    assert_eq!(counts(&fill(&body, 0.1, Offset::None, &both)), [10 * 5]);
}

#[test]
fn the_same_shape_as_a_polygon_is_filled_the_same() {
    let corners = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.0, 0.5]];
    let body = [Region::whole(Shape::<2>::Polygon(Polygon::new(corners)))];
    for (offset, periodic, count) in [
        (Offset::None, [None; 2], 36),
        (Offset::Half, [None; 2], 50),
        (Offset::None, [Some([0.0, 1.0]), None], 40),
        (Offset::Half, [Some([0.0, 1.0]), None], 50),
        (Offset::None, [Some([0.0, 1.0]), Some([0.0, 0.5])], 50),
    ] {
        assert_eq!(counts(&fill(&body, 0.1, offset, &periodic)), [count]);
    }
}

#[test]
fn two_layers_have_one_row_on_their_interface() {
    let layers = [
        Region::whole(cuboid([0.0; 2], [1.0, 0.5])),
        Region::whole(cuboid([0.0, 0.5], [1.0, 1.0])),
    ];
    let filled = fill(&layers, 0.1, Offset::None, &[None; 2]);
    assert_eq!(counts(&filled), [9 * 5, 9 * 4]);
    assert!((nearest(&filled) - 0.1).abs() < 1e-12);
    let filled = fill(&layers, 0.1, Offset::Half, &[None; 2]);
    assert_eq!(counts(&filled), [50, 50]);
}

#[test]
fn a_slanted_interface_loses_no_node_and_doubles_none() {
    let polygon =
        |corners: &[[f64; 2]]| Region::whole(Shape::<2>::Polygon(Polygon::new(corners.to_vec())));
    let halves = [
        polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]),
        polygon(&[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
    ];
    for (offset, count) in [(Offset::Half, 100), (Offset::None, 81)] {
        let filled = fill(&halves, 0.1, offset, &[None; 2]);
        assert_eq!(counts(&filled).iter().sum::<usize>(), count);
        assert!(nearest(&filled) > 0.099);
    }
}

#[test]
fn a_drop_in_a_bath_leaves_no_ring_empty() {
    let drop = Shape::Ball {
        centre: [1.0, 1.0],
        radius: 0.43,
    };
    let bodies = [
        Region {
            base: cuboid([0.0; 2], [2.0, 2.0]),
            cuts: vec![drop.clone()],
        },
        Region::whole(drop),
    ];
    for offset in [Offset::None, Offset::Half] {
        let filled = fill(&bodies, 0.05, offset, &[None; 2]);
        let edge = 40.0 - f64::from(u8::from(offset == Offset::None));
        let share = counts(&filled).iter().sum::<usize>() as f64 / edge.powi(2);
        assert!((0.95..1.05).contains(&share), "{share}");
    }
}

#[test]
fn layers_of_one_box_share_its_lattice() {
    let layers = |surface: &str| {
        let bodies = format!(
            "body.heavy = {{ phase = \"water\", box = [[0, -0.5], [1, 0.5]], below = {surface} }}\n\
             body.light = {{ phase = \"water\", box = [[0, -0.5], [1, 0.5]], above = {surface} }}"
        );
        scene(&bodies).regions::<2>()
    };
    let periodic = [Some([0.0, 1.0]), None];
    // 25 spacings across: 24 rows, the interface midway between two of them.
    let flat = layers("{ level = 0 }");
    let even = fill(&flat, 0.04, Offset::None, &periodic);
    assert_eq!(counts(&even), [25 * 12; 2]);
    // A row on the interface is there once.
    let odd = fill(&flat, 0.05, Offset::None, &periodic);
    assert_eq!(counts(&odd), [20 * 10, 20 * 9]);
    let wave = layers("{ level = 0, amplitude = 0.2, wavelength = 1 }");
    for offset in [Offset::None, Offset::Half] {
        let filled = fill(&wave, 0.05, offset, &periodic);
        let rows = if offset == Offset::None { 19 } else { 20 };
        assert_eq!(counts(&filled).iter().sum::<usize>(), 20 * rows);
        assert!(nearest(&filled) > 0.0499);
        let height = |x: f64| 0.2 * (std::f64::consts::TAU * x).cos();
        let below = |x: &[f64; 2]| x[1] <= height(x[0]) + 1e-9;
        assert!(filled[0].positions.iter().all(below));
    }
}

#[test]
fn an_ellipse_has_its_area() {
    let ellipse = Shape::Ellipse {
        centre: [1.0, 2.0],
        semi_axes: [0.5, 0.3],
    };
    assert_eq!(ellipse.bounds(), ([0.5, 1.7], [1.5, 2.3]));
    let filled = fill(&[Region::whole(ellipse)], 0.02, Offset::Half, &[None; 2]);
    let area = counts(&filled)[0] as f64 * 4e-4;
    close(area / (0.15 * std::f64::consts::PI), 1.0, 0.02);
}

#[test]
fn a_ball_keeps_its_distance_from_its_surface() {
    let body = [Region::whole(Shape::Ball {
        centre: [0.0; 3],
        radius: 1.0,
    })];
    for (offset, least) in [(Offset::None, 0.05), (Offset::Half, 0.0)] {
        let filled = fill(&body, 0.1, offset, &[None; 3]);
        let depth = |x: &[f64; 3]| body[0].depth(x);
        let depths = filled[0].positions.iter().map(depth);
        let least_found = depths.fold(f64::INFINITY, f64::min);
        assert!(least_found >= least * (1.0 - 1e-5), "{least_found}");
        let volume = filled[0].positions.len() as f64 * 1e-3;
        let radius = 1.0 - least / 2.0;
        let exact = 4.0 / 3.0 * std::f64::consts::PI * f64::powi(radius, 3);
        // A lattice of 20 across.
        close(volume / exact, 1.0, 0.1);
    }
}

#[test]
fn disorder_stays_in_the_period() {
    let periodic = [Some([0.0, 1.0]), Some([0.0, 1.0])];
    let body = [Region::whole(cuboid([0.0; 2], [1.0; 2]))];
    let mut filled = fill(&body, 0.1, Offset::None, &periodic);
    disturb(&mut filled, 0.1, 0.4, 1, &periodic);
    let inside = |x: &[f64; 2]| x.iter().all(|c| (0.0..1.0).contains(c));
    assert_eq!(counts(&filled), [100]);
    assert!(filled[0].positions.iter().all(inside));
}

fn scene(bodies: &str) -> Scene {
    let text = format!(
        "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics.spacing = 0.1\n\
         phase.water = {{ density = 1, rheology.newtonian = {{}} }}\n\
         wall.tank.box = [[0, 0], [1, 1]]\n{bodies}"
    );
    parse(&text, "x.toml", &[]).unwrap().scene
}

#[test]
fn a_body_that_fills_the_walls_counts_from_their_box() {
    let bodies = "body.a = { phase = \"water\", fill = \"walls\" }\n\
                  body.b = { phase = \"water\", box = [[3, 3], [4, 4]] }\n\
                  body.c = { phase = \"water\", fill = \"walls\", box = [[-9, -9], [9, 0.5]], \
                  seed = [0.5, 0.1], subtract = [{ disc = { centre = [0, 0], radius = 0.1 } }] }";
    let scene = scene(bodies);
    assert!(scene.body["c"].needs_walls() && !scene.body["b"].needs_walls());
    assert_eq!(scene.regions::<2>().len(), 2);
    let regions = scene
        .regions_within(Some(([0.05, 0.0], [1.05, 1.0])))
        .unwrap();
    assert_eq!(regions.len(), 3);
    assert_eq!(regions[0].base, cuboid([0.05, 0.0], [1.05, 1.0]));
    assert_eq!(regions[2].base, cuboid([0.05, 0.0], [1.05, 0.5]));
    assert_eq!(regions[2].cuts.len(), 1);
    let filled = fill(&regions[..1], 0.1, Offset::None, &[None; 2]);
    assert_eq!(counts(&filled), [81]);
    assert!((filled[0].positions[0][0] - 0.15).abs() < 1e-15);
    let told = scene.regions_within::<2>(None).unwrap_err().to_string();
    assert_eq!(told, "body.a.fill: there are no walls to fill");
    let far = Some(([20.0; 2], [21.0; 2]));
    let told = scene.regions_within(far).unwrap_err().to_string();
    assert!(told.starts_with("body.c.box: the box has nothing in common"));
}

#[test]
fn bodies_that_walls_clip_may_overlap() {
    let bodies = "body.a = { phase = \"water\", box = [[0, 0], [1, 1]], clip = true }\n\
                  body.b = { phase = \"water\", box = [[0, 0], [1, 1]] }";
    assert_eq!(scene(bodies).regions::<2>().len(), 2);
}

#[test]
fn solids_are_filled() {
    let bodies = [
        Shape::Cylinder {
            from: [0.0; 3],
            to: [2.0, 0.0, 0.0],
            radius: 0.5,
        },
        Shape::Cone {
            base: [0.0, 5.0, 0.0],
            apex: [0.0, 5.0, 3.0],
            radius: 0.5,
        },
        Shape::Extrusion {
            polygon: Polygon::new(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
            axis: 2,
            ends: [5.0, 6.0],
        },
    ];
    let pi = std::f64::consts::PI;
    for (body, volume) in bodies.into_iter().zip([0.5 * pi, 0.25 * pi, 0.5]) {
        let body = [Region::whole(body)];
        let filled = fill(&body, 0.05, Offset::Half, &[None; 3]);
        let found = counts(&filled)[0] as f64 * 0.05f64.powi(3);
        close(found / volume, 1.0, 0.06);
    }
}

#[test]
fn solids_that_span_a_period_have_no_ends() {
    let periodic = [Some([0.0, 2.0]), None, None];
    let pipe = Region::whole(Shape::Cylinder {
        from: [0.0, 1.0, 1.0],
        to: [2.0, 1.0, 1.0],
        radius: 0.55,
    });
    let bar = |wide: f64, axis, long| {
        let corners = vec![[0.0, 0.0], [wide, 0.0], [wide, 0.5], [0.0, 0.5]];
        Region::whole(Shape::Extrusion {
            polygon: Polygon::new(corners),
            axis,
            ends: [0.0, long],
        })
    };
    let at_the_end = |region: &Region<3>| {
        let filled = fill(std::slice::from_ref(region), 0.1, Offset::None, &periodic);
        let positions = &filled[0].positions;
        let first = positions.iter().filter(|x| x[0] == 0.0).count();
        assert_eq!(first * 20, positions.len());
        first
    };
    assert!(at_the_end(&pipe) > 60);
    assert_eq!(at_the_end(&bar(2.0, 1, 1.0)), 9 * 4);
    assert_eq!(at_the_end(&bar(1.0, 0, 2.0)), 9 * 4);
}
