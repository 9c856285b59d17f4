//! No fast particle gets through a wall, and nothing else is touched.

use std::f64::consts::{FRAC_PI_4, TAU};

use sph_boundary::{Polyline, RigidMotion, Surface, WallSpec, thin_plate};
use sph_core::{Vect, fields};

use crate::bench::{Bench, Random, fixed_line, wide};
use crate::close;
use crate::spatial_plugin::shapes::{block, prism, pyramid, tank, wall};

const SPACING: f64 = 0.5;
const SPEED: f64 = 10.0;
/// Steps in which a particle flies 1/17 to 3 spacings, with seeds; a step of the solver is below 1/10.
const PLANE: [(f64, u64); 5] = [(0.003, 11), (0.01, 12), (0.03, 13), (0.07, 14), (0.15, 15)];
/// In space: 1/5, 3/5 and three spacings.
const SPACE: [(f64, u64); 3] = [(0.01, 111), (0.03, 311), (0.15, 1511)];

/// A wall to shoot at.
trait Target<const D: usize> {
    /// Shots with each step, the way that they fly, m, and the least share that has to meet the wall.
    const SHOTS: (usize, f64, f64);
    fn spec(&self) -> WallSpec<D>;
    fn facets(&self) -> Vec<[Vect<D>; D]>;
    /// Any direction.
    fn direction(random: &mut Random) -> Vect<D>;
    /// True if the way from a to b crosses a facet.
    fn crosses(a: &Vect<D>, b: &Vect<D>, facet: &[Vect<D>; D]) -> bool;
}

impl Target<2> for Polyline {
    const SHOTS: (usize, f64, f64) = (2000, 4.0, 0.1);

    fn spec(&self) -> WallSpec<2> {
        fixed_line(self.clone())
    }

    fn facets(&self) -> Vec<[Vect<2>; 2]> {
        self.edges().map(|e| e.map(Vect::from)).collect()
    }

    fn direction(random: &mut Random) -> Vect<2> {
        let angle = random.between(0.0, TAU);
        Vect::<2>::new(angle.cos(), angle.sin())
    }

    fn crosses(a: &Vect<2>, b: &Vect<2>, [c, d]: &[Vect<2>; 2]) -> bool {
        let side = |p: &Vect<2>, q: &Vect<2>, r: &Vect<2>| (q - p).perp(&(r - p));
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    }
}

impl Target<3> for Surface {
    const SHOTS: (usize, f64, f64) = (400, 3.0, 0.2);

    fn spec(&self) -> WallSpec<3> {
        WallSpec::at_rest(wall(self.clone()))
    }

    fn facets(&self) -> Vec<[Vect<3>; 3]> {
        let corner = |c: u32| Vect::from(self.points[c as usize]);
        self.triangles.iter().map(|t| t.map(corner)).collect()
    }

    fn direction(random: &mut Random) -> Vect<3> {
        let (angle, z) = (random.between(0.0, TAU), random.between(-1.0, 1.0));
        let across = (1.0 - z * z).sqrt();
        Vect::from([across * angle.cos(), across * angle.sin(), z])
    }

    fn crosses(a: &Vect<3>, b: &Vect<3>, [p, q, r]: &[Vect<3>; 3]) -> bool {
        let normal = (q - p).cross(&(r - p));
        let (from, to) = (normal.dot(&(a - p)), normal.dot(&(b - p)));
        if from * to >= 0.0 {
            return false;
        }
        let at = a + (b - a) * (from / (from - to));
        let left = |p: &Vect<3>, q: &Vect<3>| normal.dot(&(q - p).cross(&(at - p))) > 0.0;
        left(p, q) && left(q, r) && left(r, p)
    }
}

/// Flies in steps from random places of a box, a quarter of a spacing from the wall at least, a third of the shots at
/// `aims`; returns how many went through the wall and how many it turned away.
fn flown<T: Target<D>, const D: usize>(
    target: &T,
    [low, high]: [f64; 2],
    aims: &[[f64; D]],
    (dt, seed): (f64, u64),
) -> [usize; 2] {
    let (walls, (shots, way, _)) = ([target.spec()], T::SHOTS);
    let far = vec![Vect::repeat(50.0)];
    let probe = Bench::new("usaw", &walls, SPACING, wide(), far);
    let mut random = Random::new(seed);
    let mut places: Vec<Vect<D>> = Vec::new();
    while places.len() < shots {
        let x = random.point(low, high);
        let close = probe.wall.clearance(&x, 0.25 * SPACING).is_some();
        if probe.wall.contains(&x) && !close {
            places.push(x);
        }
    }
    let mut bench = Bench::new("usaw", &walls, SPACING, wide(), places);
    let positions = bench.positions().to_vec();
    let velocity = bench.world.free.get_mut(fields::VELOCITY).unwrap();
    for (k, (u, x)) in velocity.iter_mut().zip(&positions).enumerate() {
        let any = T::direction(&mut random);
        let towards = aims.get(k / 3 % aims.len().max(1)).filter(|_| k % 3 == 0);
        *u = towards.map_or(any, |aim| (Vect::from(*aim) - x).normalize()) * SPEED;
    }
    let facets = target.facets();
    for _ in 0..(way / (SPEED * dt)).ceil() as usize {
        bench.wall.constrain(&mut bench.world, dt).unwrap();
        let velocity = bench.world.free.get(fields::VELOCITY).unwrap().to_vec();
        let before = bench.positions().to_vec();
        let positions = bench.world.free.get_mut(fields::POSITION).unwrap();
        for (x, u) in positions.iter_mut().zip(&velocity) {
            *x += u * dt;
        }
        let now = bench.positions().to_vec();
        // The mark of a particle that is through is in a column, which is sorted with it.
        let marks = bench.world.free.get_mut(fields::PRESSURE).unwrap();
        for (k, mark) in marks.iter_mut().enumerate() {
            let crossed = facets.iter().any(|f| T::crosses(&before[k], &now[k], f));
            if crossed || !bench.wall.contains(&now[k]) {
                *mark = 1.0;
            }
        }
        bench.refresh();
    }
    let marks = bench.world.free.get(fields::PRESSURE).unwrap();
    let velocity = bench.world.free.get(fields::VELOCITY).unwrap();
    let turned = velocity.iter().filter(|u| u.norm() < 0.999 * SPEED);
    [marks.iter().filter(|m| **m > 0.0).count(), turned.count()]
}

fn no_particle_is_lost<T: Target<D>, const D: usize>(
    what: &str,
    target: &T,
    range: [f64; 2],
    aims: &[[f64; D]],
    steps: &[(f64, u64)],
) {
    let (shots, _, least) = T::SHOTS;
    let (mut hits, mut lost_in_all) = (0, 0);
    for &(dt, seed) in steps {
        let [lost, turned] = flown(target, range, aims, (dt, seed));
        println!("{what}: Δt = {dt} s: {lost} of {shots} lost, {turned} turned");
        lost_in_all += lost;
        hits += turned;
    }
    assert_eq!(lost_in_all, 0, "{what}");
    let enough = least * (shots * steps.len()) as f64;
    assert!(hits as f64 > enough, "{what}: only {hits} hits");
}

fn floor() -> Polyline {
    Polyline::open("floor", vec![[-40.0, 0.0], [40.0, 0.0]])
}

#[test]
fn ten_thousand_shots_at_lines_stay_on_their_side() {
    let closed = |name, corners: &[[f64; 2]]| Polyline::closed(name, corners.to_vec());
    let plate = |thickness| {
        let middle = [[-1.5, -0.5], [0.0, 0.2], [1.5, 0.2]];
        thin_plate("plate", &middle, thickness).unwrap()
    };
    let octagon = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| {
        let (sin, cos) = (FRAC_PI_4 * f64::from(k)).sin_cos();
        [2.0 * cos, 2.0 * sin]
    });
    let room = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let block = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
    let blade = [[-1.0, -0.3], [0.0, 0.9], [1.0, -0.3]];
    let acute = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0]];
    for (line, range) in [
        (floor(), [-2.0, 2.5]),
        (closed("room", &room), [0.0, 4.0]),
        (closed("acute corner", &acute), [0.0, 4.0]),
        (closed("obtuse corner", &octagon), [-2.0, 2.0]),
        // Re-entrant from the fluid.
        (closed("block", &block), [-3.0, 3.0]),
        (closed("blade", &blade), [-3.0, 3.0]),
        (plate(0.0), [-2.5, 2.5]),
        (plate(0.05), [-2.5, 2.5]),
    ] {
        no_particle_is_lost(&line.name, &line, range, &[], &PLANE);
    }
}

#[test]
fn a_thousand_shots_at_surfaces_stay_on_their_side() {
    // A step, and over it a gap that closes at a fifth of a right angle.
    let outline = [
        [1.5, 1.5],
        [1.5, 0.0],
        [0.0, 0.0],
        [0.0, 3.0],
        [3.0, 2.0],
        [3.0, 1.5],
    ];
    let step = prism("step", &outline, [0.0, 3.0]).reversed();
    let plate = |half: f64| block("plate", [-1.0, -1.0, -half], [1.0, 1.0, half]);
    let at_plate = [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [1.0, 1.0, 0.0]];
    let corners = [[0.0; 3], [3.0; 3], [3.0, 0.0, 0.0], [0.0, 1.5, 3.0]];
    // The tip of a pyramid, an edge, a corner and an edge of its base, a face.
    let mut at_pyramid = vec![[0.0, 0.0, 1.2], [0.5, 0.5, 0.6], [1.0, 1.0, 0.0]];
    at_pyramid.extend([[1.0, 0.2, 0.0], [0.5, 0.0, 0.6]]);
    let at_needle = [[0.0, 0.0, 2.0], [0.1, 0.1, 1.0], [0.2, 0.2, 0.0]];
    let in_tip = [[0.0, 0.0, 2.4], [0.6, 0.6, 1.8], [2.0, 2.0, 0.0]];
    let mut at_step = vec![[1.5, 1.5, 1.5], [3.0, 1.5, 1.5]];
    at_step.extend([[1.5, 0.0, 0.0], [0.0, 3.0, 3.0]]);
    let hollow = pyramid(2.0, 2.4).reversed();
    for (surface, range, aims, steps) in [
        (
            tank([0.0; 3], [3.0; 3]),
            [0.0, 3.0],
            &corners[..],
            &SPACE[..],
        ),
        (pyramid(1.0, 1.2), [-2.0, 2.0], &at_pyramid, &SPACE),
        (pyramid(0.2, 2.0), [-1.5, 2.5], &at_needle, &SPACE),
        (hollow, [-2.0, 2.4], &in_tip, &SPACE[..2]),
        (plate(0.025), [-2.0, 2.0], &at_plate, &SPACE),
        (plate(0.0005), [-2.0, 2.0], &at_plate, &SPACE),
        (step, [0.0, 3.0], &at_step, &SPACE[..2]),
    ] {
        no_particle_is_lost(&surface.name, &surface, range, aims, steps);
    }
}

/// From the clearance itself upwards, over nodes and between them. The impact is plastic: it ends at the clearance, to
/// rounding of 10 m/s.
fn along_a_floor<const D: usize>(spec: WallSpec<D>, particles: usize, most_along: f64) {
    let mut random = Random::new(5);
    for name in ["usaw", "dummy-particles"] {
        let height = |k: usize| SPACING * (0.25 + 0.05 * (k % 10) as f64);
        let place = |k: usize| {
            let across = [0.013, 0.007].map(|step| step * k as f64);
            Vect::from_fn(|i, _| if i == D - 1 { height(k) } else { across[i] })
        };
        let places = (0..particles).map(place).collect();
        let walls = [spec.clone()];
        let mut bench = Bench::new(name, &walls, SPACING, wide(), places);
        for dt in (1..=20).map(|n| 0.1 * f64::from(n) * SPACING / SPEED) {
            let before = bench.world.free.get_mut(fields::VELOCITY).unwrap();
            for u in before.iter_mut() {
                *u = random.point(-SPEED, SPEED);
                u[D - 1] = -u[D - 1].abs();
            }
            let before = before.clone();
            bench.wall.constrain(&mut bench.world, dt).unwrap();
            let after = bench.world.free.get(fields::VELOCITY).unwrap();
            for ((u, now), x) in before.iter().zip(after).zip(bench.positions()) {
                let lowest = ((0.25 * SPACING - x[D - 1]) / dt).min(0.0);
                close(now[D - 1], u[D - 1].max(lowest), 1e-12, (name, dt));
                let along = (0..D - 1)
                    .map(|k| (now[k] - u[k]).abs())
                    .fold(0.0, f64::max);
                assert!(along <= most_along, "{name}: {u} {now}");
            }
        }
    }
}

#[test]
fn the_velocity_along_a_flat_wall_is_kept_wherever_the_particle_stands() {
    along_a_floor(fixed_line(floor()), 1000, 0.0);
    let slab = block("slab", [-3.0, -3.0, -2.0], [3.0, 3.0, 0.0]);
    along_a_floor::<3>(WallSpec::at_rest(wall(slab)), 100, 1e-12);
}

/// The velocity of a particle over a wall after 1 ms.
fn after(spec: WallSpec<2>, height: f64, velocity: Vect<2>) -> Vect<2> {
    let place = vec![Vect::<2>::new(0.1, height)];
    let mut bench = Bench::new("usaw", &[spec], SPACING, wide(), place);
    bench.world.free.get_mut(fields::VELOCITY).unwrap()[0] = velocity;
    bench.wall.constrain(&mut bench.world, 1e-3).unwrap();
    bench.world.free.get(fields::VELOCITY).unwrap()[0]
}

#[test]
fn a_particle_at_rest_at_half_a_spacing_is_not_touched_by_a_bit() {
    for u in [[0.0, 0.0], [3.0, 0.0], [1e-3, -1e-3], [0.0, 5.0]].map(Vect::from) {
        let after = after(fixed_line(floor()), 0.5 * SPACING, u);
        assert_eq!(after.map(f64::to_bits), u.map(f64::to_bits));
    }
}

#[test]
fn a_wall_that_comes_takes_the_particle_along_at_its_own_speed() {
    let mut spec = fixed_line(floor());
    spec.motion = RigidMotion::steady([0.5, 2.0]);
    // Its own tangential velocity stays; the normal one is the wall's.
    let u = after(spec, 0.25 * SPACING, Vect::zeros());
    assert!((u - Vect::<2>::new(0.0, 2.0)).norm() < 1e-14, "{u}");
}
