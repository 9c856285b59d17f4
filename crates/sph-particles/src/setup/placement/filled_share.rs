//! Share of the space between walls that the particles of a body fill.

use sph_boundary::Wall;
use sph_core::Vect;
use sph_scene::{Body, BodyParticles, Offset, Region, Scene, fill};

/// A body that fills less or more than this off its space is remarked upon.
const OFF: f64 = 0.015;
/// Largest number of samples: finer lattices find the space to a smaller share of its surface.
const SAMPLES: usize = 100_000;
/// Samples per spacing, at most.
const FINEST: usize = 16;

/// Remarks on bodies whose particles do not fill their box, or the space between walls, in a scene without gravity:
/// there is no surface then that could fall or rise, and the missing volume opens as a void or lowers the pressure by
/// ρc² times its share. Walls with points of their own, which have volumes, get no remark.
pub fn shares<const D: usize>(
    scene: &Scene,
    regions: &[Region<D>],
    walls: &dyn Wall<D>,
    periodic: &[Option<[f64; 2]>; D],
    kept: &[usize],
) -> Vec<String> {
    let spacing = scene.numerics.spacing;
    let most = kept.iter().copied().max().unwrap_or(0).max(1);
    let finer = (SAMPLES / most) as f64;
    let finer = (finer.powf(1.0 / D as f64) as usize).min(FINEST);
    let fills = |body: &Body| body.clip || body.fill.is_some() || body.shape.bounds.is_some();
    let weightless = scene.numerics.gravity.iter().flatten().all(|g| *g == 0.0);
    if finer < 2 || !weightless || !scene.body.values().any(fills) {
        return Vec::new();
    }
    let step = spacing / finer as f64;
    let samples = fill(regions, step, Offset::Half, periodic);
    let share = |filled: &BodyParticles<D>| {
        let inside = filled.positions.iter().map(|x| Vect::from(*x));
        let inside = inside.filter(|x| walls.contains(x)).count() as f64;
        kept[filled.body] as f64 * (finer as f64).powi(D as i32) / inside
    };
    let bodies = scene.body.iter().zip(&samples);
    let odd = bodies.filter(|((_, body), _)| fills(body) && body.seed.is_none());
    odd.map(|((name, _), filled)| (name, share(filled)))
        .filter(|(_, share)| share.is_finite() && (share - 1.0).abs() > OFF)
        .map(|(name, share)| {
            format!(
                "the particles of body `{name}` fill {:.1} % of its space between the walls: where no surface can fall, the \
                 rest opens as a void or changes the pressure by as much of \u{3c1}c\u{b2}; choose a spacing that divides the \
                 distances between walls",
                100.0 * share
            )
        })
        .collect()
}
