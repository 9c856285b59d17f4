//! Bodies against the periodic box, the domain and the spacing.

use sph_core::plausible::Quantity;

use crate::checks::table_check::TableCheck;
use crate::checks::wave;
use crate::geometry::periodic_place::{ROUNDING, spans};
use crate::{Region, Scene};

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
            wave::place(wave, &region, spacing, check.below("wave"));
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
