//! Walls that move: γ is that of a wall drawn there, velocities and accelerations are rates.

use std::sync::Arc;

use sph_boundary::{Bend, Course, Drawing, Polyline, RigidMotion, Rotation, Surface, WallSpec};
use sph_core::bed::horizontal;
use sph_core::{Erodible, Vect};

use crate::bench::{Bench, Random, largest, moving, wide};
use crate::spatial_plugin::shapes::block;

/// A block around the origin, the fluid outside.
trait Block<const D: usize> {
    const SPACING: f64;
    /// Number of particles around it, the box that they are in, and their least distance from the origin.
    const AROUND: (usize, f64, f64);
    /// Least number of dummy particles in it.
    const DUMMIES: usize;

    /// With its corners mapped.
    fn drawing(map: impl Fn([f64; D]) -> [f64; D]) -> Drawing;

    /// Turned and carried along.
    fn motion() -> RigidMotion<D>;

    fn bench(name: &str, spec: WallSpec<D>) -> Bench<D> {
        let (count, half, least) = Self::AROUND;
        let mut random = Random::new(3);
        let places = (0..count).map(|_| random.point(-half, half));
        let places = places.filter(|x: &Vect<D>| x.norm() > least).collect();
        Bench::new(name, &[spec], Self::SPACING, wide(), places)
    }

    fn drawn(map: impl Fn([f64; D]) -> [f64; D]) -> Bench<D> {
        Self::bench("usaw", WallSpec::at_rest(Self::drawing(map)))
    }

    fn moved(name: &str, motion: RigidMotion<D>, time: f64) -> Bench<D> {
        let mut bench = Self::bench(name, moving(Self::drawing(|x| x), motion));
        bench.move_to(time);
        bench
    }
}

struct Plane;
impl Block<2> for Plane {
    const SPACING: f64 = 0.5;
    const AROUND: (usize, f64, f64) = (400, 4.0, 2.2);
    /// Cells of half a metre in 2 m by 1 m.
    const DUMMIES: usize = 8;

    fn drawing(map: impl Fn([f64; 2]) -> [f64; 2]) -> Drawing {
        let corners = [[-1.0, -0.5], [-1.0, 0.5], [1.0, 0.5], [1.0, -0.5]];
        Drawing::Line(Polyline::closed("block", corners.map(map).to_vec()))
    }

    fn motion() -> RigidMotion {
        RigidMotion {
            rotation: Some(Rotation {
                centre: [0.2, 0.1],
                axis: [0.0; 3],
                course: Course::Steady { speed: 0.7 },
            }),
            start: 0.5,
            stop: 3.0,
            ..RigidMotion::steady([0.3, -0.2])
        }
    }
}

struct Space;
impl Block<3> for Space {
    const SPACING: f64 = 0.4;
    const AROUND: (usize, f64, f64) = (1500, 3.0, 2.0);
    const DUMMIES: usize = 21;

    fn drawing(map: impl Fn([f64; 3]) -> [f64; 3]) -> Drawing {
        let solid = block("block", [-1.0, -0.5, -0.7], [1.0, 0.5, 0.7]);
        Drawing::Surface(Surface {
            points: solid.points.into_iter().map(map).collect(),
            ..solid
        })
    }

    /// About a slanted axis, accelerating.
    fn motion() -> RigidMotion<3> {
        RigidMotion {
            rotation: Some(Rotation {
                centre: [0.2, 0.1, -0.3],
                axis: [1.0, 2.0, 0.5],
                course: Course::Ramp {
                    speed: 0.7,
                    over: 2.0,
                },
            }),
            start: 0.5,
            stop: 3.0,
            ..RigidMotion::steady([0.3, -0.2, 0.1])
        }
    }
}

fn farthest<const D: usize>(a: &[Vect<D>], b: &[Vect<D>]) -> f64 {
    assert_eq!(a.len(), b.len());
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).norm());
    apart.fold(0.0, f64::max)
}

/// Of points and elements, in the plane, where a turned wall is cut as it was drawn.
fn assert_there<const D: usize>(moved: &Bench<D>, drawn: &Bench<D>, most: f64) {
    let (a, b) = (&moved.world.walls, &drawn.world.walls);
    // In space other diagonals may be cut: the area is the same.
    let whole = |b: &Bench<D>| b.world.walls.elements.measure.iter().sum::<f64>();
    assert!((whole(moved) - whole(drawn)).abs() < 1e-11);
    if D == 2 {
        assert!(farthest(&a.points.position, &b.points.position) < most);
        assert!(farthest(&a.elements.centre, &b.elements.centre) < most);
        assert!(farthest(&a.elements.normal, &b.elements.normal) < most);
    }
}

fn a_moved_block_is_the_block_drawn_there<B: Block<D>, const D: usize>(most: f64) {
    for time in [0.0, 0.4, 1.1, 3.0, 7.0] {
        let drawn = B::drawn(B::motion().pose(time).map());
        let moved = B::moved("usaw", B::motion(), time);
        // Positions of a few metres, rotated once: some 1e-15.
        assert_there(&moved, &drawn, 1e-14);
        let [gamma, gradient] = largest(&moved, &drawn);
        let near = moved.gamma().iter().filter(|g| **g < 0.999).count();
        println!("t = {time}: γ {gamma:.1e}, ∇γ {gradient:.1e}, {near} near");
        assert!(gamma < most && gradient < 1e-12, "{gamma:e} {gradient:e}");
        assert!(near > 10, "t = {time}: only {near} particles see the wall");
    }
}

#[test]
fn a_moved_and_turned_block_is_the_block_drawn_there() {
    a_moved_block_is_the_block_drawn_there::<Plane, 2>(1e-13);
    a_moved_block_is_the_block_drawn_there::<Space, 3>(1e-12);
}

fn dummies_moved_with_it<B: Block<D>, const D: usize>() {
    for time in [0.4, 1.1, 7.0] {
        let [rest, moved] = [0.0, time].map(|t| B::moved("dummy-particles", B::motion(), t));
        let map = B::motion().pose(time).map();
        let positions = rest.world.walls.points.position.iter();
        let expected: Vec<Vect<D>> = positions.map(|x| map((*x).into()).into()).collect();
        assert!(expected.len() >= B::DUMMIES, "{}", expected.len());
        assert!(farthest(&moved.world.walls.points.position, &expected) < 1e-14);
    }
}

#[test]
fn dummies_of_a_moved_wall_moved_with_it() {
    dummies_moved_with_it::<Plane, 2>();
    dummies_moved_with_it::<Space, 3>();
}

/// Truncation of velocities ω³ r Δt²/6 ≈ 1e-11, rounding 1e-15/1e-5.
fn rates_of_positions_and_velocities<B: Block<D>, const D: usize>(most: f64) {
    let step = 1e-5;
    for name in ["usaw", "dummy-particles"] {
        for time in [0.2, 1.1, 2.8, 5.0] {
            let walls = [-step, 0.0, step].map(|more| B::moved(name, B::motion(), time + more));
            let rate = |column: &dyn Fn(&Bench<D>) -> Vec<Vect<D>>, expected: &[Vect<D>]| {
                let [before, _, after] = &walls;
                let pairs = column(before).into_iter().zip(column(after));
                let rates: Vec<_> = pairs.map(|(b, a)| (a - b) / (2.0 * step)).collect();
                farthest(&rates, expected)
            };
            let (points, elements) = (&walls[1].world.walls.points, &walls[1].world.walls.elements);
            let velocities = [
                rate(&|b| b.world.walls.points.position.clone(), &points.velocity),
                rate(
                    &|b| b.world.walls.elements.centre.clone(),
                    &elements.velocity,
                ),
            ];
            let accelerations = [
                rate(
                    &|b| b.world.walls.points.velocity.clone(),
                    &points.acceleration,
                ),
                rate(
                    &|b| b.world.walls.elements.velocity.clone(),
                    &elements.acceleration,
                ),
            ];
            let found =
                velocities.iter().all(|v| *v < most) && accelerations.iter().all(|a| *a < 1e-8);
            assert!(
                found,
                "{name}, t = {time}: {velocities:?} {accelerations:?}"
            );
        }
    }
}

#[test]
fn velocities_and_accelerations_are_the_rates_of_positions_and_velocities() {
    rates_of_positions_and_velocities::<Plane, 2>(1e-9);
    rates_of_positions_and_velocities::<Space, 3>(1e-8);
}

#[test]
fn back_where_it_was_drawn_every_number_is_the_first_one() {
    let [rest, mut other] = [0.0, 2.2].map(|t| Space::moved("usaw", Space::motion(), t));
    other.move_to(0.0);
    let (a, b) = (&rest.world.walls, &other.world.walls);
    assert_eq!(a.points.position, b.points.position);
    assert_eq!(a.elements.normal, b.elements.normal);
    assert_eq!(rest.gamma(), other.gamma());
}

#[test]
fn contacts_have_the_velocity_of_the_wall_at_their_places() {
    let time = 1.1;
    let bench = Space::moved("usaw", Space::motion(), time);
    let walls = &bench.world.walls;
    let (mut worst, mut middle, mut count) = (0.0_f64, 0.0_f64, 0);
    for contact in walls.contacts.all() {
        let weights = contact.corners.expect("a face is one contact");
        let corners = walls.elements.corners[contact.element as usize];
        let parts = corners.iter().zip(weights);
        let parts = parts.map(|(c, w)| walls.points.position[*c as usize] * w);
        let place: Vect<3> = parts.sum();
        let there = Space::motion().movement(place.into(), time).velocity;
        let own = walls.elements.velocity[contact.element as usize];
        worst = worst.max((walls.elements.velocity_at(&contact) - there).norm());
        middle = middle.max((own - there).norm());
        count += 1;
    }
    println!("{count} contacts: {worst:.1e} m/s, at the centres of elements {middle:.1e}");
    let right = count > 20 && worst < 1e-12 && middle > 0.01;
    assert!(right, "{count}: {worst:e} {middle:e}");
}

#[test]
fn a_belt_has_the_velocity_of_its_surface_and_stays() {
    let belt = Vect::<2>::new(1.5, 0.0);
    let mut spec = WallSpec::at_rest(Plane::drawing(|x| x));
    spec.surface_velocity = belt;
    let mut bench = Plane::bench("usaw", spec);
    let before = bench.world.walls.points.position.clone();
    bench.move_to(2.0);
    let walls = &bench.world.walls;
    assert_eq!(walls.points.position, before);
    assert!(walls.points.velocity.iter().all(|u| *u == belt));
    assert!(walls.elements.velocity.iter().all(|u| *u == belt));
}

/// Sheared upwards: the left end rises, the right end sinks.
fn bent() -> RigidMotion {
    RigidMotion {
        bend: Some(Arc::new(Bend {
            places: vec![-1.0, 1.0],
            lifts: [0.06, -0.04].map(|speed| Course::Steady { speed }).into(),
        })),
        ..RigidMotion::default()
    }
}

#[test]
fn a_bent_wall_is_the_wall_drawn_so_with_its_angles_and_lengths() {
    for time in [0.0, 0.7, 1.9] {
        let drawn = Plane::drawn(|[x, y]| [x, y + time * (0.01 - 0.05 * x)]);
        let moved = Plane::moved("usaw", bent(), time);
        assert_there(&moved, &drawn, 1e-14);
        let (a, b) = (&moved.world.walls, &drawn.world.walls);
        let worst = |a: &[f64], b: &[f64]| {
            let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let lengths = worst(&a.elements.measure, &b.elements.measure);
        let shares = worst(&a.points.share, &b.points.share);
        let all = [lengths, shares, worst(moved.gamma(), drawn.gamma())];
        let right = all.iter().all(|d| *d < 1e-13);
        assert!(right, "t = {time}: lengths, shares, γ off by {all:?}");
    }
}

#[test]
fn the_velocity_of_a_bending_wall_is_the_rate_of_its_position() {
    let step = 1e-3;
    for name in ["usaw", "dummy-particles"] {
        let at = |time: f64| Plane::moved(name, bent(), time).world.walls.points;
        let [before, here, after] = [1.0 - step, 1.0, 1.0 + step].map(at);
        let places = before.position.iter().zip(&after.position);
        let rates: Vec<_> = places.map(|(a, b)| (b - a) / (2.0 * step)).collect();
        // Lifts are linear in time: nothing but rounding, 1e-15/1e-3.
        let error = farthest(&rates, &here.velocity);
        assert!(error < 1e-11, "{name}: {error:e}");
    }
}

fn bed<B: Block<D>, const D: usize>() -> Bench<D> {
    let motion = RigidMotion {
        bed: Some("block".into()),
        ..RigidMotion::default()
    };
    let erodible = Some(Erodible {
        cell: Some(0.5),
        stretch: Some(10.0),
        ..Erodible::default()
    });
    let spec = WallSpec {
        erodible,
        ..moving(B::drawing(|x| x), motion)
    };
    B::bench("usaw", spec)
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
        let (walls, time) = (&mut moved.world.walls, 0.1 * f64::from(step));
        let done = moved.wall.advance(walls, Vect::zeros(), time, 0.1);
        done.expect("a step");
    }
    moved.refresh();
    let drawn = B::drawn(|mut x| {
        x[D - 1] += lift(horizontal(&x));
        x
    });
    if D == 2 {
        assert_there(&moved, &drawn, 1e-13);
    }
    let [gamma, _] = largest(&moved, &drawn);
    assert!(gamma < 1e-12, "γ is off by {gamma:e}");
    // Every place of the wall rises with its lift.
    let points = &moved.world.walls.points;
    for (velocity, place) in points.velocity.iter().zip(&points.position) {
        let rate = lift(horizontal(&(*place).into()));
        assert!((velocity[D - 1] - rate).abs() < 1e-13);
    }
    // The numbers of a checkpoint put another bed there, bit for bit.
    let mut again = bed::<B, D>();
    let (states, walls) = (moved.wall.states(), &mut again.world.walls);
    let put = again.wall.put_back(walls, &states, 1.0);
    put.expect("states of these walls");
    let (a, b) = (&again.world.walls, &moved.world.walls);
    assert_eq!(a.points.position, b.points.position);
    assert_eq!(a.beds, b.beds);
}

#[test]
fn a_sloping_bed_is_the_wall_drawn_there() {
    a_sloping_bed_is_the_wall_drawn_so::<Plane, 2>();
    a_sloping_bed_is_the_wall_drawn_so::<Space, 3>();
}
