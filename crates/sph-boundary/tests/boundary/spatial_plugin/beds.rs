//! Walls that grains make, in either dimension: a bed at some level is the wall drawn there.

use std::sync::Arc;

use sph_boundary::{Drawing, Erodible, Polyline, RigidMotion, WallSpec};
use sph_core::Vect;
use sph_core::bed::horizontal;

use crate::bench::{Bench, Random, moving, wide};
use crate::spatial_plugin::shapes::{block, wall};

/// A block whose top is a bed, as it was drawn or sheared upwards.
trait Block<const D: usize> {
    fn drawing(lift: impl Fn([f64; 2]) -> f64) -> Drawing;
    const SPACING: f64;
}

struct Plane;
impl Block<2> for Plane {
    fn drawing(lift: impl Fn([f64; 2]) -> f64) -> Drawing {
        let mut corners = vec![[-1.0, -0.5], [-1.0, 0.5], [1.0, 0.5], [1.0, -0.5]];
        corners.iter_mut().for_each(|c| c[1] += lift(horizontal(c)));
        Drawing::Line(Polyline::closed("block", corners))
    }
    const SPACING: f64 = 0.25;
}

struct Space;
impl Block<3> for Space {
    fn drawing(lift: impl Fn([f64; 2]) -> f64) -> Drawing {
        let mut solid = block("block", [-1.0, -0.5, -0.7], [1.0, 0.5, 0.7]);
        let points = solid.points.iter_mut();
        points.for_each(|p| p[2] += lift(horizontal(p)));
        wall(solid)
    }
    const SPACING: f64 = 0.4;
}

/// Particles all round, where the block never comes.
fn around<const D: usize>() -> Vec<Vect<D>> {
    let mut random = Random::new(3);
    let places = (0..1500).map(|_| Vect::from_fn(|_, _| random.between(-3.0, 3.0)));
    places.filter(|x: &Vect<D>| x.norm() > 2.0).collect()
}

fn bed<B: Block<D>, const D: usize>() -> Bench<D> {
    let motion = RigidMotion {
        bed: Some(Arc::new(Erodible {
            wall: "block".into(),
            cell: 0.5,
            from: [f64::NEG_INFINITY; 2],
            to: [f64::INFINITY; 2],
            rock: f64::NEG_INFINITY,
            fade: 10.0,
        })),
        ..RigidMotion::default()
    };
    let spec = moving(B::drawing(|_| 0.0), motion);
    Bench::new("usaw", &[spec], B::SPACING, wide(), around())
}

fn a_sloping_bed_is_the_wall_drawn_so<B: Block<D>, const D: usize>() {
    let lift = |x: [f64; 2]| 0.05 + 0.1 * x[0] - 0.06 * x[1];
    let mut moved = bed::<B, D>();
    let laid = &mut moved.world.walls.beds[0];
    for place in 0..laid.grid.len() {
        laid.rate[place] = lift(laid.grid.position(place));
    }
    // In ten steps of a tenth of a second, as a flow does it.
    for step in 0..10 {
        let time = 0.1 * f64::from(step);
        let walls = &mut moved.world.walls;
        let done = moved.wall.advance(walls, Vect::zeros(), time, 0.1);
        done.expect("a step");
    }
    moved.refresh();
    let drawn = Bench::new(
        "usaw",
        &[WallSpec::at_rest(B::drawing(lift))],
        B::SPACING,
        wide(),
        around(),
    );
    let (a, b) = (&moved.world.walls, &drawn.world.walls);
    if D == 2 {
        // In space a sheared face is divided otherwise.
        for (places, drawn) in [
            (&a.points.position, &b.points.position),
            (&a.elements.normal, &b.elements.normal),
        ] {
            let apart = places.iter().zip(drawn).map(|(a, b)| (a - b).norm());
            assert!(apart.fold(0.0, f64::max) < 1e-13);
        }
    }
    let gammas = moved.gamma().iter().zip(drawn.gamma());
    let worst = gammas.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-12, "γ is off by {worst:e}");
    // Every place of the wall rises with its lift.
    for (velocity, place) in a.points.velocity.iter().zip(&a.points.position) {
        let rate = lift(horizontal(&(*place).into()));
        assert!((velocity[D - 1] - rate).abs() < 1e-13);
    }
    // The numbers of a checkpoint put another bed there, bit for bit.
    let mut again = bed::<B, D>();
    let states = moved.wall.states();
    let walls = &mut again.world.walls;
    again
        .wall
        .put_back(walls, &states, 1.0)
        .expect("states of these walls");
    assert_eq!(
        again.world.walls.points.position,
        moved.world.walls.points.position
    );
    assert_eq!(again.world.walls.beds, moved.world.walls.beds);
}

#[test]
fn a_sloping_bed_of_the_plane_is_the_wall_drawn_so() {
    a_sloping_bed_is_the_wall_drawn_so::<Plane, 2>();
}

#[test]
fn a_sloping_bed_in_space_is_the_wall_drawn_so() {
    a_sloping_bed_is_the_wall_drawn_so::<Space, 3>();
}
