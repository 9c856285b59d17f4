//! Walls that move in space: γ is that of a wall drawn there, velocities are rates.

use sph_boundary::{Course, RigidMotion, Rotation, Surface, WallSpec};
use sph_core::Vect;

use crate::bench::{Bench, Random, moving, wide};
use crate::spatial_plugin::shapes::{block, wall};

const SPACING: f64 = 0.4;

fn solid() -> Surface {
    block("block", [-1.0, -0.5, -0.7], [1.0, 0.5, 0.7])
}

/// About a slanted axis, carried along, accelerating.
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

/// Particles all round, where the block never comes.
fn around() -> Vec<Vect<3>> {
    let mut random = Random::new(3);
    let places = (0..1500).map(|_| random.point(-3.0, 3.0));
    places.filter(|x: &Vect<3>| x.norm() > 2.0).collect()
}

fn moved(name: &str, time: f64) -> Bench<3> {
    let spec = moving(wall(solid()), motion());
    let mut bench = Bench::new(name, &[spec], SPACING, wide(), around());
    bench.move_to(time);
    bench
}

fn farthest(a: &[Vect<3>], b: &[Vect<3>]) -> f64 {
    assert_eq!(a.len(), b.len());
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).norm());
    apart.fold(0.0, f64::max)
}

#[test]
fn a_moved_and_turned_block_is_the_block_drawn_there_gamma_to_1e_12() {
    for time in [0.0, 0.4, 1.1, 3.0, 7.0] {
        let map = motion().pose(time).map();
        let mut there = solid();
        there.points = there.points.iter().map(|p| map(*p)).collect();
        let drawn = Bench::new(
            "usaw",
            &[WallSpec::at_rest(wall(there))],
            SPACING,
            wide(),
            around(),
        );
        let moved = moved("usaw", time);
        assert_eq!(moved.positions(), drawn.positions(), "the particles stayed");
        let pairs = moved.gamma().iter().zip(drawn.gamma());
        let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let gradients = (0..drawn.positions().len()).map(|i| moved.gradient(i) - drawn.gradient(i));
        let steepest = gradients.map(|g| g.norm()).fold(0.0, f64::max);
        let near = moved.gamma().iter().filter(|g| **g < 0.999).count();
        println!("t = {time}: γ {worst:.1e}, ∇γ {steepest:.1e}, {near} near");
        assert!(
            worst < 1e-12 && steepest < 1e-12,
            "t = {time}: {worst:e} {steepest:e}"
        );
        assert!(near > 20, "t = {time}: only {near} particles see the wall");
        // Of a turned drawing other diagonals may be cut: areas and normals are the same.
        let whole = |b: &Bench<3>| b.world.walls.elements.measure.iter().sum::<f64>();
        assert!((whole(&moved) - whole(&drawn)).abs() < 1e-11);
    }
}

#[test]
fn back_where_it_was_drawn_every_number_is_the_first_one() {
    let rest = moved("usaw", 0.0);
    let mut other = moved("usaw", 2.2);
    other.move_to(0.0);
    let (a, b) = (&rest.world.walls, &other.world.walls);
    assert_eq!(a.points.position, b.points.position);
    assert_eq!(a.elements.normal, b.elements.normal);
    assert_eq!(rest.gamma(), other.gamma());
}

#[test]
fn dummies_of_a_moved_wall_moved_with_it() {
    let map = motion().pose(1.1).map();
    let (rest, moved) = (moved("dummy-particles", 0.0), moved("dummy-particles", 1.1));
    let positions = rest.world.walls.points.position.iter();
    let expected: Vec<Vect<3>> = positions.map(|x| map((*x).into()).into()).collect();
    assert!(expected.len() > 20);
    assert!(farthest(&moved.world.walls.points.position, &expected) < 1e-14);
}

#[test]
fn velocities_and_accelerations_are_the_rates_of_positions_and_velocities() {
    let step = 1e-5;
    for name in ["usaw", "dummy-particles"] {
        for time in [0.2, 1.1, 2.8, 5.0] {
            let here = moved(name, time);
            let (before, after) = (moved(name, time - step), moved(name, time + step));
            let [b, h, a] = [&before, &here, &after].map(|b| &b.world.walls.points);
            for v in 0..h.position.len() {
                let rate = (a.position[v] - b.position[v]) / (2.0 * step);
                assert!((rate - h.velocity[v]).norm() < 1e-8, "{name}, t = {time}");
                let rate = (a.velocity[v] - b.velocity[v]) / (2.0 * step);
                assert!(
                    (rate - h.acceleration[v]).norm() < 1e-8,
                    "{name}, t = {time}"
                );
            }
            let [b, h, a] = [&before, &here, &after].map(|b| &b.world.walls.elements);
            for s in 0..h.centre.len() {
                let rate = (a.velocity[s] - b.velocity[s]) / (2.0 * step);
                assert!(
                    (rate - h.acceleration[s]).norm() < 1e-8,
                    "{name}, t = {time}"
                );
            }
        }
    }
}

#[test]
fn contacts_have_the_velocity_of_the_wall_at_their_places() {
    let time = 1.1;
    let bench = moved("usaw", time);
    let walls = &bench.world.walls;
    let (mut worst, mut middle, mut count) = (0.0_f64, 0.0_f64, 0);
    for contact in walls.contacts.all() {
        let weights = contact.corners.expect("a face is one contact");
        let corners = walls.elements.corners[contact.element as usize];
        let place = corners
            .iter()
            .zip(weights)
            .fold(Vect::zeros(), |sum: Vect<3>, (c, w)| {
                sum + walls.points.position[*c as usize] * w
            });
        let there = Vect::from(motion().movement(place.into(), time).velocity);
        let own = walls.elements.velocity[contact.element as usize];
        worst = worst.max((walls.elements.velocity_at(&contact) - there).norm());
        middle = middle.max((own - there).norm());
        count += 1;
    }
    println!("{count} contacts: {worst:.1e} m/s, at the centres of elements {middle:.1e}");
    assert!(
        count > 20 && worst < 1e-12 && middle > 0.01,
        "{worst:e} {middle:e}"
    );
}
