//! A gate or a piston that stands on a floor, slides along it and lifts off: what is left of the
//! fluid that the points of both stand for.

use sph_boundary::{Drawing, Polyline, RigidMotion, WallSpec};
use sph_core::Vect;

use crate::bench::{Bench, moving, wide};
use crate::close;
use crate::spatial_plugin::shapes::{block, floor, wall};

const SPACING: f64 = 0.25;

/// A floor and a gate of width 1 and height 1.5 on it, with a steady velocity.
trait Scene<const D: usize> {
    fn walls(velocity: Vect<D>) -> Vec<WallSpec<D>>;

    /// Along the floor.
    fn sideways() -> Vect<D> {
        Vect::from_fn(|k, _| f64::from(u8::from(k == 0)))
    }

    fn bench(velocity: Vect<D>) -> Bench<D> {
        let far = vec![Vect::repeat(50.0)];
        Bench::new("usaw", &Self::walls(velocity), SPACING, wide(), far)
    }
}

struct Plane;
struct Space;

impl Scene<2> for Plane {
    fn walls(velocity: Vect<2>) -> Vec<WallSpec<2>> {
        let floor = Polyline::open("floor", vec![[-3.0, 0.0], [3.0, 0.0]]);
        let corners = vec![[-0.5, 0.0], [-0.5, 1.5], [0.5, 1.5], [0.5, 0.0]];
        let gate = Polyline::closed("gate", corners);
        let motion = RigidMotion::steady(velocity.into());
        vec![
            WallSpec::at_rest(Drawing::Line(floor)),
            moving(Drawing::Line(gate), motion),
        ]
    }
}

impl Scene<3> for Space {
    fn walls(velocity: Vect<3>) -> Vec<WallSpec<3>> {
        let gate = block("gate", [-0.5, -0.5, 0.0], [0.5, 0.5, 1.5]);
        let motion = RigidMotion::steady(velocity.into());
        vec![
            WallSpec::at_rest(wall(floor(-3.0, 3.0))),
            moving(wall(gate), motion),
        ]
    }
}

/// Points of a wall with their shares.
fn points<const D: usize>(bench: &Bench<D>, wall: u32) -> Vec<(Vect<D>, f64)> {
    let points = &bench.world.walls.points;
    let all = points.position.iter().zip(&points.share).zip(&points.wall);
    let of_wall = all.filter(|(_, w)| **w == wall);
    of_wall.map(|((x, share), _)| (*x, *share)).collect()
}

fn across<const D: usize>(x: &Vect<D>) -> f64 {
    x.iter().take(D - 1).map(|c| c.abs()).fold(0.0, f64::max)
}

fn shares_around_a_standing_gate<S: Scene<D>, const D: usize>() -> [f64; 3] {
    let bench = S::bench(S::sideways());
    let (mut under, mut free): (f64, f64) = (0.0, 0.0);
    for (x, share) in points(&bench, 0) {
        match across(&x) {
            r if r < 0.4 => under = under.max(share),
            r if r > 0.8 && r < 2.8 => free = free.max((share - 0.5).abs()),
            _ => {}
        }
    }
    for (x, share) in points(&bench, 1) {
        if x[D - 1] == 0.0 && across(&x) < 0.4 {
            under = under.max(share);
        }
    }
    let mut rim = Vect::zeros();
    rim[0] = 0.5;
    let at_rim = bench.shares_at(rim);
    println!("{D}D: under {under:.4}, beyond {free:.1e}, at the rim {at_rim:?}");
    [under, free, at_rim.iter().sum()]
}

#[test]
fn under_a_gate_is_nothing_beyond_it_everything_and_at_its_rim_both_share_a_quarter() {
    for [under, beyond, rim] in [
        shares_around_a_standing_gate::<Plane, 2>(),
        shares_around_a_standing_gate::<Space, 3>(),
    ] {
        assert_eq!(under, 0.0);
        assert!(beyond < 1e-15, "{beyond:e}");
        close(rim, 0.25, 1e-12, "at the rim");
    }
}

/// Sum of the shares of all points.
fn total<const D: usize>(bench: &Bench<D>) -> f64 {
    bench.world.walls.points.share.iter().sum()
}

/// The same walls with one motion are one outline: nothing of the floor is under the gate.
#[test]
fn a_gate_that_may_move_stands_for_what_one_outline_stands_for() {
    let [apart, joined] = [Vect::x(), Vect::zeros()].map(|u| total(&Plane::bench(u)));
    close(apart, joined, 1e-12, "in the plane");
    let [apart, joined] = [Vect::x(), Vect::zeros()].map(|u| total(&Space::bench(u)));
    close(apart, joined, 1e-11, "in space");
}

/// Largest change of one share, and of the sum, while the gate moves by a hundredth of a spacing.
fn largest_changes<S: Scene<D>, const D: usize>(velocity: Vect<D>, steps: u32) -> [f64; 3] {
    let mut bench = S::bench(velocity);
    let mut before = bench.world.walls.points.share.clone();
    let sum = |shares: &[f64]| shares.iter().sum::<f64>();
    let start = sum(&before);
    let [mut most, mut in_all, mut drift] = [0.0_f64; 3];
    for k in 1..=steps {
        bench.move_to(0.01 * SPACING * f64::from(k));
        let now = bench.world.walls.points.share.clone();
        let pairs = before.iter().zip(&now);
        most = pairs.fold(most, |most, (a, b)| most.max((a - b).abs()));
        in_all = in_all.max((sum(&before) - sum(&now)).abs());
        drift = drift.max((sum(&now) - start).abs());
        before = now;
    }
    println!("{D}D {velocity:?}: {most:.4}, in all {in_all:.4}, from {start:.3} by {drift:.3}");
    [most, in_all, drift]
}

#[test]
fn shares_change_by_6_thousandths_while_a_gate_slides_a_hundredth_of_a_spacing() {
    let [most, _, drift] = largest_changes::<Plane, 2>(Vect::x(), 230);
    // Together they are those of the outline, wherever the gate stands.
    assert!(most < 0.006 && drift < 1e-11, "{most} {drift}");
    let [most, _, drift] = largest_changes::<Space, 3>(Vect::x(), 120);
    assert!(most < 0.006 && drift < 0.05, "{most} {drift}");
}

#[test]
fn shares_change_by_9_thousandths_while_a_gate_lifts_a_hundredth_of_a_spacing() {
    for [most, ..] in [
        largest_changes::<Plane, 2>(Vect::y(), 150),
        largest_changes::<Space, 3>(Vect::z(), 120),
    ] {
        assert!(most < 0.009, "{most}");
    }
}

#[test]
fn a_lifted_gate_and_the_floor_below_have_their_shares_again() {
    let mut bench = Plane::bench(Vect::y());
    bench.move_to(1.2 * SPACING);
    for (x, share) in points(&bench, 0) {
        close(share, 0.5, 1e-15, x);
    }
    let corner = |x: &Vect<2>| (x[0].abs() - 0.5).abs() < 1e-9 && (x[1] - 0.3).abs() < 1e-9;
    let at = points(&bench, 1).into_iter().filter(|(x, _)| corner(x));
    let shares: Vec<_> = at.map(|(_, share)| share).collect();
    assert_eq!(shares.len(), 2);
    assert!(shares.iter().all(|share| (share - 0.75).abs() < 1e-15));
}

/// Largest difference between the shares after many small moves and those of walls that came there at once.
fn memory<S: Scene<D>, const D: usize>(velocity: Vect<D>) -> f64 {
    let mut stepping = S::bench(velocity);
    let mut most = 0.0_f64;
    for k in 1..=60 {
        let time = 0.02 * SPACING * f64::from(k);
        stepping.move_to(time);
        if k % 7 != 0 {
            continue;
        }
        let mut leaping = S::bench(velocity);
        leaping.move_to(time);
        let shares = |bench: &Bench<D>| bench.world.walls.points.share.clone();
        let pairs = shares(&stepping).into_iter().zip(shares(&leaping));
        most = pairs.fold(most, |most, (a, b)| most.max((a - b).abs()));
    }
    most
}

#[test]
fn shares_follow_from_where_the_walls_are_alone() {
    assert_eq!(memory::<Plane, 2>(Vect::x()), 0.0);
    assert_eq!(memory::<Plane, 2>(Vect::y()), 0.0);
    assert_eq!(memory::<Space, 3>(Vect::x()), 0.0);
    assert_eq!(memory::<Space, 3>(Vect::z()), 0.0);
    assert_eq!(memory::<Space, 3>(Vect::repeat(0.7)), 0.0);
}
