//! Bodies that claim the same place.

use scene_text::Problems;

use crate::geometry::periodic_place::PeriodicRegion;
use crate::geometry::vector::point;
use crate::{Region, Scene, Shape};

/// Bodies may share this fraction of a spacing: curved outlines are drawn with short edges.
const SHARED: f64 = 1e-3;
/// Most points tried along an axis of the box that two bodies have in common.
const ALONG: f64 = 256.0;
/// Bound on the work of all pairs, in compared edges.
const WORK: f64 = 2e7;

/// Tries lattice points of the intersection of the boxes around two bodies.
///
/// Bodies that walls clip or that fill them are left to the code that has the walls.
pub(crate) fn check<const D: usize>(scene: &Scene, found: &mut Problems) {
    let spacing = scene.numerics.spacing;
    let periods = scene.numerics.periodic.bounds::<D>();
    // Parts that walls cut away may overlap; that shows once there are walls.
    let whole = scene.body.iter().filter(|(_, b)| !b.needs_walls());
    let (names, regions): (Vec<&String>, Vec<Region<D>>) = whole
        .filter_map(|(name, body)| Some((name, Region::from_body(body)?)))
        .unzip();
    let placed = (regions.iter()).map(|r| PeriodicRegion::new(r, spacing, &periods));
    let placed: Vec<_> = placed.collect();
    let mut work = WORK;
    for (i, first) in placed.iter().enumerate() {
        for (j, second) in placed.iter().enumerate().skip(i + 1) {
            let effort = (edges(&regions[i]) + edges(&regions[j])) * first.shifts().len() as f64;
            let both = common(first, second, spacing, effort, &mut work);
            if let (Some(place), [a, b]) = (both, [names[i], names[j]]) {
                let at = point(&place);
                let message = format!("the bodies `{a}` and `{b}` overlap, for instance at {at}");
                found.add(format!("body.{b}"), message);
                break;
            }
        }
        if work <= 0.0 {
            return;
        }
    }
}

fn edges<const D: usize>(region: &Region<D>) -> f64 {
    let of = |shape: &Shape<D>| match shape {
        Shape::Polygon(polygon) | Shape::Extrusion { polygon, .. } => polygon.points().len() as f64,
        _ => 1.0,
    };
    of(&region.base) + region.cuts.iter().map(of).sum::<f64>()
}

fn common<const D: usize>(
    first: &PeriodicRegion<'_, D>,
    second: &PeriodicRegion<'_, D>,
    spacing: f64,
    effort: f64,
    work: &mut f64,
) -> Option<[f64; D]> {
    let ((alo, ahi), (blo, bhi)) = (first.bounds(), second.bounds());
    let lo: [f64; D] = std::array::from_fn(|k| alo[k].max(blo[k]));
    let length: [f64; D] = std::array::from_fn(|k| ahi[k].min(bhi[k]) - lo[k]);
    *work -= 1.0;
    if length.iter().any(|l| *l <= SHARED * spacing) {
        return None;
    }
    let most = if D == 2 { ALONG } else { ALONG / 8.0 };
    let counts = length.map(|l| (l / spacing).ceil().clamp(1.0, most) as usize);
    let total: usize = counts.iter().product();
    for n in 0..total {
        if *work <= 0.0 {
            return None;
        }
        *work -= effort;
        let mut rest = n;
        let x: [f64; D] = std::array::from_fn(|k| {
            let index = rest % counts[k];
            rest /= counts[k];
            lo[k] + (index as f64 + 0.5) * length[k] / counts[k] as f64
        });
        let depth = first.depth(&x).min(second.depth(&x));
        if depth > SHARED * spacing {
            return Some(x);
        }
    }
    None
}
