//! The box of a scene: from the scene, or around its walls and bodies.

use sph_core::{Vect, bounds};
use sph_neighbours::Domain;
use sph_scene::{Region, Scene};
use sph_solver::SolverError;

use crate::setup::shapes::Drawn;

/// Σ ρ g H over the phases, H the extent of a phase's bodies along gravity, Pa; zero without gravity.
pub fn pressure_at_rest<const D: usize>(scene: &Scene, regions: &[Region<D>]) -> f64 {
    let of = |(name, phase): (&String, &sph_scene::Phase)| {
        let bodies = scene.body.values().zip(regions);
        let own = bodies.filter(|(body, _)| body.phase == *name);
        phase.density * height(scene, own.map(|(_, region)| region))
    };
    scene.gravity::<D>().norm() * scene.phase.iter().map(of).sum::<f64>()
}

/// Extent of bodies along gravity, m.
pub fn height<'a, const D: usize>(
    scene: &Scene,
    regions: impl IntoIterator<Item = &'a Region<D>>,
) -> f64 {
    let gravity = scene.gravity::<D>();
    let Some(down) = gravity.try_normalize(0.0) else {
        return 0.0;
    };
    let corners = regions.into_iter().flat_map(|region| {
        let (lower, upper) = region.base.bounds();
        (0..1 << D).map(move |n| corner(&lower.into(), &upper.into(), n))
    });
    let along = corners.map(|corner| (0..D).map(|k| down[k] * corner[k]).sum::<f64>());
    let [low, high] = bounds(along.map(|along| [along]));
    (high[0] - low[0]).max(0.0)
}

/// Corner number `n` of the 2ᴰ corners of a box.
pub fn corner<const D: usize>(low: &Vect<D>, high: &Vect<D>, n: usize) -> Vect<D> {
    Vect::from_fn(|k, _| if n >> k & 1 == 0 { low[k] } else { high[k] })
}

/// Lower and upper corner of the box around places; without any an infinite one that is turned inside out.
pub fn box_around<'a, const D: usize>(
    places: impl IntoIterator<Item = &'a Vect<D>>,
) -> [Vect<D>; 2] {
    let none = [f64::INFINITY, f64::NEG_INFINITY].map(Vect::repeat);
    let places = places.into_iter();
    places.fold(none, |[low, high], x| [low.inf(x), high.sup(x)])
}

/// Times at which the way of prescribed walls is sampled.
const SAMPLES: usize = 1000;

/// The scene's domain, or a box round walls, on their prescribed way as well, and bodies with room to move.
pub fn domain_of<const D: usize>(scene: &Scene, drawn: &Drawn<D>) -> Domain<D> {
    let bodies = drawn.regions.iter().map(|region| region.base.bounds());
    let boxes = bodies.chain(drawn.bounds);
    let [lower, upper] = bounds(boxes.flat_map(|(low, high)| [low, high])).map(Vect::from);
    // Splashes rise over an open tank; without walls the flow may go far.
    let room = if scene.wall.is_empty() { 10.0 } else { 2.0 };
    let extent = (upper - lower).max();
    let margin = Vect::repeat(room * extent);
    let mut domain = Domain::open(lower - margin, upper + margin);
    // A least way of prescribed walls from the borders until the end of the run: shorter courses leave the box unchanged.
    let margin = 0.5 * room * extent;
    for wall in drawn.walls.iter().filter(|w| w.motion.moves()) {
        let [low, high] = bounds(wall.drawing.points::<D>()).map(Vect::from);
        for n in 0..=SAMPLES {
            let time = scene.run.end * n as f64 / SAMPLES as f64;
            let map = wall.motion.pose(time).map();
            for n in 0..1 << D {
                let corner = map(corner(&low, &high, n).into()).into_iter().enumerate();
                for (k, x) in corner.filter(|(_, x)| x.is_finite()) {
                    domain.lower[k] = domain.lower[k].min(x - margin);
                    domain.upper[k] = domain.upper[k].max(x + margin);
                }
            }
        }
    }
    if let Some([low, high]) = &scene.numerics.domain {
        domain = Domain::open(Vect::from_column_slice(low), Vect::from_column_slice(high));
    }
    for (axis, bounds) in scene.numerics.periodic.bounds::<D>().iter().enumerate() {
        if let Some([low, high]) = bounds {
            domain.lower[axis] = *low;
            domain.upper[axis] = *high;
            domain.periodic[axis] = true;
        }
    }
    domain
}

/// A period must be so long that no particle sees another one twice.
pub fn check_periods<const D: usize>(domain: &Domain<D>, reach: f64) -> Result<(), SolverError> {
    for axis in (0..D).filter(|&a| domain.periodic[a]) {
        if domain.length(axis) < 2.0 * reach {
            let path = format!("numerics.periodic.{}", ["x", "y", "z"][axis]);
            let why = format!(
                "the period of {} m is shorter than two supports with their skin: at least {:.6} m",
                domain.length(axis),
                2.0 * reach
            );
            return Err(SolverError::at(path, why));
        }
    }
    Ok(())
}
