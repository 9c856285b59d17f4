//! Walls that touch and move alike are one wall: drawn in pieces or in one outline.

use sph_boundary::{Drawing, Polyline, WallSpec};
use sph_core::Vect;

use crate::bench::{Bench, Random, largest, wide};
use crate::spatial_plugin::shapes::{block, prism, tank, wall};

const SPACING: f64 = 0.25;

/// Wall points sorted by place, to a millionth of a spacing.
fn sorted<const D: usize>(bench: &Bench<D>) -> Vec<([i64; D], f64)> {
    let points = &bench.world.walls.points;
    let key = |x: &Vect<D>| -> [i64; D] { std::array::from_fn(|k| (x[k] * 4e6).round() as i64) };
    let all = points.position.iter().zip(&points.share);
    let mut all: Vec<_> = all.map(|(x, share)| (key(x), *share)).collect();
    all.sort_by_key(|a| a.0);
    all
}

/// The points are at the same places; returns how many of them have other shares.
fn other_shares<const D: usize>(a: &Bench<D>, b: &Bench<D>) -> usize {
    let (a, b) = (sorted(a), sorted(b));
    let places = |points: &[([i64; D], f64)]| points.iter().map(|p| p.0).collect::<Vec<_>>();
    assert_eq!(places(&a), places(&b));
    let total = |points: &[([i64; D], f64)]| points.iter().map(|p| p.1).sum::<f64>();
    assert!((total(&a) - total(&b)).abs() < 1e-11);
    let pairs = a.iter().zip(&b);
    pairs.filter(|(a, b)| (a.1 - b.1).abs() > 1e-12).count()
}

#[test]
fn in_the_plane_a_block_on_the_floor_is_a_step_of_it_gamma_to_1e_14() {
    let tank = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]];
    let block = vec![[1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]];
    let mut step = tank.clone();
    step.splice(1..1, block.iter().copied());
    let line = |name, points| WallSpec::at_rest(Drawing::Line(Polyline::closed(name, points)));
    let mut random = Random::new(4);
    let inside = |x: &Vect<2>| !(x[0] > 1.0 && x[0] < 2.0 && x[1] < 1.0);
    let places: Vec<Vect<2>> = (0..2000).map(|_| random.point(0.05, 2.95)).collect();
    let places: Vec<_> = places.into_iter().filter(inside).collect();
    let new = |walls: &[_]| Bench::new("usaw", walls, SPACING, wide(), places.clone());
    let pieces = new(&[line("tank", tank), line("block", block)]);
    let whole = new(&[line("tank", step)]);
    let [gamma, gradient] = largest(&pieces, &whole);
    println!("γ {gamma:.1e}, ∇γ {gradient:.1e}");
    assert!(gamma < 1e-14 && gradient < 1e-13, "{gamma:e} {gradient:e}");
    assert_eq!(other_shares(&pieces, &whole), 0);
}

#[test]
fn in_space_a_block_on_the_floor_is_a_step_of_it_gamma_to_1e_12() {
    // In an edge of the tank and as long as it, so that the step can be drawn as a prism.
    let outline = [
        [1.0, 1.0],
        [0.0, 1.0],
        [0.0, 3.0],
        [3.0, 3.0],
        [3.0, 0.0],
        [1.0, 0.0],
    ];
    let mut random = Random::new(4);
    let inside = |x: &Vect<3>| x[1] < 2.0 && !(x[0] < 1.0 && x[2] < 1.0);
    let places: Vec<Vect<3>> = (0..4000).map(|_| random.point(0.05, 2.95)).collect();
    let places: Vec<_> = places.into_iter().filter(inside).collect();
    let new = |walls: &[_]| Bench::new("usaw", walls, SPACING, wide(), places.clone());
    let sill = block("sill", [0.0; 3], [1.0, 2.0, 1.0]);
    let pieces = new(&[
        WallSpec::at_rest(wall(tank([0.0; 3], [3.0, 2.0, 3.0]))),
        WallSpec::at_rest(wall(sill)),
    ]);
    let step = prism("tank", &outline, [0.0, 2.0]).reversed();
    let whole = new(&[WallSpec::at_rest(wall(step))]);
    let [gamma, gradient] = largest(&pieces, &whole);
    println!("γ {gamma:.1e}, ∇γ {gradient:.1e}");
    assert!(gamma < 1e-12 && gradient < 1e-11, "{gamma:e} {gradient:e}");
    // Of twelve corners some are cut along another diagonal.
    let others = other_shares(&pieces, &whole);
    println!("other shares at {others} points");
    assert!(others <= 12, "{others}");
}
