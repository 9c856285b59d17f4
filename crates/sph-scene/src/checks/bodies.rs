//! Bodies and their waves against the periodic box, the domain and the spacing, and against each other.

use scene_text::Problems;
use sph_core::plausible::Quantity;

use crate::checks::table_check::TableCheck;
use crate::geometry::periodic_place::{PeriodicRegion, ROUNDING, spans};
use crate::geometry::vector::point;
use crate::{Body, Pressure, Region, Scene, Shape, Wave};

/// Bodies may share this fraction of a spacing: curved outlines are drawn with short edges.
const SHARED: f64 = 1e-3;
/// Most points tried along an axis of the box that two bodies have in common.
const ALONG: f64 = 256.0;
/// Bound on the work of all pairs, in compared edges.
const WORK: f64 = 2e7;

/// Bodies lie in the periodic box and the domain, and are no thinner than a particle.
pub(crate) fn within_bounds<const D: usize>(scene: &Scene, whole: &mut TableCheck<'_>) {
    let spacing = scene.numerics.spacing;
    let periods = scene.numerics.periodic.bounds::<D>();
    let near = ROUNDING * spacing;
    let mut filled = [false; D];
    for (name, body) in &scene.body {
        let Some(region) = Region::<D>::from_body(body) else {
            continue;
        };
        let mut check = whole.below(&format!("body.{name}"));
        let shape = body.shape.given()[0];
        let (lo, hi) = region.base.bounds();
        let far = (lo.iter().chain(&hi)).fold(0.0, |far: f64, x| far.max(x.abs()));
        if let Some(why) = Quantity::refused("distance over the spacing", far / spacing) {
            check.add(shape, why);
            continue;
        }
        let (bottom, top) = region.bounds();
        for (given, key) in [(&body.above, "above"), (&body.below, "below")] {
            let (from, to) = (lo[D - 1], hi[D - 1]);
            let message =
                format!("nothing of the body, which reaches from {from} m to {to} m, is {key} it");
            check.refuse(given.is_some() && bottom[D - 1] >= top[D - 1], key, message);
        }
        if let Some(wave) = &body.wave {
            place_of_wave(wave, &region, spacing, check.below("wave"));
        }
        let spanned = spans(&region.base, spacing, &periods);
        for (k, axis) in ["x", "y", "z"].iter().enumerate().take(D) {
            filled[k] |= spanned[k];
            let wide = hi[k] - lo[k];
            let message = format!(
                "the body is {wide} m wide along {axis}, less than the spacing of {spacing} m"
            );
            check.refuse(wide < spacing * (1.0 - ROUNDING), shape, message);
            // A filling of the walls ends at them.
            if body.fill.is_some() {
                continue;
            }
            let domain = scene.numerics.domain.as_ref().map(|d| [d[0][k], d[1][k]]);
            for (what, bounds) in [("periodic box", periods[k]), ("domain", domain)] {
                let outside = |b: &[f64; 2]| lo[k] < b[0] - near || hi[k] > b[1] + near;
                if let Some([least, most]) = bounds.filter(outside) {
                    let message = format!(
                        "the body reaches from {} to {} along {axis}, out of the {what} from {least} to {most}",
                        lo[k], hi[k]
                    );
                    check.add(shape, message);
                }
            }
        }
    }
    whole_periods(scene, filled, whole);
}

/// Refuses periods that bodies span and that are no multiple of the spacing.
fn whole_periods<const D: usize>(scene: &Scene, filled: [bool; D], whole: &mut TableCheck<'_>) {
    let spacing = scene.numerics.spacing;
    for (filled, (axis, bounds)) in filled.iter().zip(scene.numerics.periodic.axes()) {
        let Some([lo, hi]) = bounds.filter(|_| *filled) else {
            continue;
        };
        let period = hi - lo;
        let rows = period / spacing;
        let count = rows.round().max(1.0);
        let nearest = period / count;
        let message = format!(
            "the period of {period} m along {axis} is no multiple of the spacing; the nearest spacing is {nearest}"
        );
        let uneven = (rows - count).abs() > ROUNDING * count;
        whole.refuse(uneven, "numerics.spacing", message);
    }
}

/// Tries lattice points of the intersection of the boxes around two bodies.
///
/// Bodies that walls clip or that fill them are left to the code that has the walls.
pub(crate) fn apart<const D: usize>(scene: &Scene, found: &mut Problems) {
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
            let effort = (edges(&regions[i]) + edges(&regions[j])) * first.shifts.len() as f64;
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
        Shape::Polygon(polygon) | Shape::Extrusion { polygon, .. } => polygon.points.len() as f64,
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

/// Highest solitary wave there is, over the depth (Longuet-Higgins & Fenton 1974).
const HIGHEST: f64 = 0.83;

/// The other keys of the body fit its wave.
pub(crate) fn keys_of_wave(scene: &Scene, body: &Body, mut check: TableCheck<'_>) {
    let Some(wave) = &body.wave else { return };
    let gravity = scene.numerics.gravity.as_deref().unwrap_or(&[]);
    let down = gravity
        .split_last()
        .is_some_and(|(down, level)| *down < 0.0 && level.iter().all(|g| *g == 0.0));
    let message = "a wave needs a `numerics.gravity` down along the last axis";
    check.refuse(!down, "", message);
    let (depth, height, most) = (wave.depth, wave.height, HIGHEST * wave.depth);
    let message = format!(
        "a solitary wave on water {depth} m deep is at most {most} m high, found {height} m"
    );
    check.refuse(height > most, "height", message);
    let weightless = body.pressure == Pressure::Zero && down;
    check.refuse(weightless, "", "a wave needs `pressure = \"hydrostatic\"`");
    for (key, given, what) in [
        ("velocity", body.velocity.is_some(), "velocity"),
        ("initial", !body.initial.is_empty(), "velocity"),
        ("below", body.below.is_some(), "surface"),
        ("surface", body.surface.is_some(), "surface"),
    ] {
        let message =
            format!("the {what} at the start is given by `{key}` and by a wave: choose one");
        check.refuse(given, "", message);
    }
}

/// The wave is within the shape of its body.
fn place_of_wave<const D: usize>(
    wave: &Wave,
    region: &Region<D>,
    spacing: f64,
    mut check: TableCheck<'_>,
) {
    let (lo, hi) = region.base.bounds();
    let (from, to, crest) = (lo[0], hi[0], wave.crest);
    let message = format!("the crest is at {crest} m, out of the body from {from} m to {to} m");
    check.refuse(crest < from || crest > to, "crest", message);
    let (low, high) = (lo[D - 1], hi[D - 1]);
    let (bed, still, top) = (wave.bottom, wave.still(), wave.still() + wave.height);
    let message =
        format!("the crest is {top} m high, and the body ends at {high} m: it would be cut off");
    check.refuse(top > high + ROUNDING * spacing, "", message);
    // Waves are drawn half a spacing up where rows stand at whole spacings.
    let message = format!("the body reaches down to {low} m, below the bed of the wave at {bed} m");
    check.refuse(low < bed - spacing, "", message);
    let message = format!("the body starts at {low} m, above the still water at {still} m");
    check.refuse(low >= still, "", message);
}
