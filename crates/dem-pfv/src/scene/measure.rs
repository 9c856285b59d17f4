//! Values of probes, and columns of the series.

use std::f64::consts::PI;
use std::ops::Range;

use nalgebra::Matrix3;
use sph_core::bounds;

use crate::grains::{GrainSystem, Vector};
use crate::scene::{Box, Model, Origin, Probe, Scene, displacements, strain_deviators};
use crate::sphere;

/// Unit of a probe's values.
pub fn unit(probe: &Probe) -> &'static str {
    match probe {
        Probe::Stress { .. } | Probe::EffectiveStress { .. } | Probe::Deviator { .. } => "Pa",
        Probe::Amplitude { .. } | Probe::MeanStress {} => "Pa",
        Probe::Flux { .. } => "m³/s",
        Probe::Permeability { .. } => "m²",
        Probe::Pressure { over: None, .. } => "Pa",
        Probe::Top {} | Probe::Settlement {} => "m",
        Probe::Level { .. } | Probe::Displacement { .. } => "m",
        _ => "",
    }
}

/// Present value of a probe; none where there is nothing to measure.
fn value(probe: &Probe, scene: &Scene, model: &Model, origin: &Origin) -> Option<f64> {
    let grains = model.grains();
    let wall = |name: &str| scene.planes().iter().position(|p| p == name);
    let (axis, [from, to]) = probe.layer().unwrap_or_default();
    match probe {
        Probe::Stress { wall: name } => grains.wall_stress(wall(name)?).ok(),
        Probe::Borne { wall: name } => {
            let (weight, wall) = (buoyant_weight(model), grains.walls.get(wall(name)?)?);
            (weight > 0.0).then(|| -wall.force.dot(&wall.normal) / weight)
        }
        Probe::Carried {} => {
            let (wet, weight) = (model.wet()?, buoyant_weight(model));
            let up = -grains.gravity.normalize();
            (weight > 0.0).then(|| wet.drag().dot(&up) / weight)
        }
        Probe::Pressure { over, .. } => {
            let pressure = model.wet()?.layer_pressure(axis, from, to)?;
            Some(pressure / over.unwrap_or(1.0))
        }
        Probe::Gradient { between, .. } => {
            let between = between.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            gradient(model, axis, [from, to], between)
        }
        Probe::EffectiveStress { axis, at } => grains.effective_stress(axis.number(), *at).ok(),
        Probe::Porosity { .. } => porosity(grains, axis, from, to),
        Probe::Top {} => Some(grains.highest()),
        Probe::Level { .. } => {
            let room = scene.r#box.as_ref()?;
            level(grains, [room.low, room.high], axis, [from, to])
        }
        Probe::Settlement {} => {
            let heights = displacements(grains, origin);
            let sum: f64 = heights.iter().map(|u| u[2]).sum();
            Some(-sum / heights.len() as f64)
        }
        Probe::Consolidation {} => {
            let (now, start) = (grains.box_lengths()?, origin.lengths?);
            Some((start[2] - now[2]) / start[2] / origin.dry_strain?)
        }
        Probe::RunOut { axis, length } => Some((deposit(grains, axis.number()) - length) / length),
        Probe::Displacement { axis, low, high } => {
            let inside = |x: &Vector| (0..3).all(|k| (low[k]..=high[k]).contains(&x[k]));
            let all = displacements(grains, origin);
            let moved = all.iter().zip(&origin.positions).filter(|(_, x)| inside(x));
            let (sum, count) = moved.fold((0.0, 0), |(s, n), (u, _)| (s + u[axis.number()], n + 1));
            (count > 0).then(|| sum / f64::from(count))
        }
        Probe::Flux { wall: name } => model.wet()?.inflow(wall(name)?),
        Probe::Permeability { axis } => {
            let wet = model.wet()?;
            Some(wet.setup().fluid.viscosity * wet.mobility(axis.number()).ok()?)
        }
        Probe::Amplitude { wall: name } => {
            let wave = scene.wall.get(name)?.wave.as_ref()?;
            Some(wave.amplitude + wave.ramp * grains.time)
        }
        _ => packing(probe, grains, origin),
    }
}

/// Stresses, strains and contacts of a packing.
fn packing(probe: &Probe, grains: &GrainSystem, origin: &Origin) -> Option<f64> {
    let (now, start) = (grains.box_lengths(), origin.lengths);
    let stretch = |k: usize| Some((now?[k] / start?[k]).ln());
    match probe {
        Probe::Strain { axis } => Some(-stretch(axis.number())?),
        Probe::VolumetricStrain {} => (0..3).map(stretch).sum(),
        Probe::Deviator { axis } => deviator(grains, axis.number()),
        Probe::MeanStress {} => grains.mean_stress().ok(),
        Probe::K0 { .. } => {
            let (axis, [from, to]) = probe.layer()?;
            pressure_at_rest(grains, axis, from..to)
        }
        Probe::Sliding {} => grains.sliding_share(),
        Probe::StrainDeviator {} => {
            let all = strain_deviators(grains, origin);
            Some(all.iter().sum::<f64>() / all.len() as f64)
        }
        _ => None,
    }
}

/// Size of the weight of the grains less buoyancy, N; the weight itself where there is no fluid.
pub fn buoyant_weight(model: &Model) -> f64 {
    match model {
        Model::Wet(system) => system.buoyant_weight().norm(),
        Model::Dry(system) => system.gravity.norm() * system.grains.mass.iter().sum::<f64>(),
    }
}

/// Slope −dp/dx of the pores in a part of the box, by least squares and volumes, over (ρ_s − ρ_f) g (1 − n) of the layer.
fn gradient(model: &Model, axis: usize, layer: [f64; 2], between: [f64; 2]) -> Option<f64> {
    let ([from, to], [left, right]) = (layer, between);
    let system = model.wet()?;
    let inside = |x: &Vector| (from..to).contains(&x[axis]) && (left..=right).contains(&x.x);
    let grains = model.grains();
    let share = 1.0 - porosity(grains, axis, from, to)?;
    let weight = buoyant_weight(model) / grains.grains.volume() * share;
    let slope = system.gradient(axis, inside)?;
    (weight > 0.0).then(|| slope / weight)
}

fn deviator(grains: &GrainSystem, axis: usize) -> Option<f64> {
    let mut sums = [0.0; 2];
    for wall in 0..6 {
        let stress = grains.wall_stress(wall).ok()?;
        match wall / 2 == axis {
            true => sums[0] += 0.5 * stress,
            false => sums[1] += 0.25 * stress,
        }
    }
    Some(sums[0] - sums[1])
}

/// Stress of the grains of a layer across an axis over that along it.
fn pressure_at_rest(grains: &GrainSystem, axis: usize, layer: Range<f64>) -> Option<f64> {
    let all = &grains.grains;
    let parts = grains.grain_stresses().into_iter();
    let parts = parts.zip(all.position.iter().zip(&all.radius));
    let inside = parts.filter(|(_, (x, _))| layer.contains(&x[axis]));
    let sum: Matrix3<f64> = inside.map(|(stress, (_, r))| stress * sphere(*r)).sum();
    let along = sum[(axis, axis)];
    (along > 0.0).then(|| 0.5 * (sum.trace() - along) / along)
}

/// Volume of a sphere on the lower side of a plane, m³; `up` is the plane's distance from the centre.
fn cap_volume(radius: f64, up: f64) -> f64 {
    let h = (up + radius).clamp(0.0, 2.0 * radius);
    PI * h * h * (radius - h / 3.0)
}

/// Porosity between two planes across an axis of a closed box.
fn porosity(grains: &GrainSystem, axis: usize, from: f64, to: f64) -> Option<f64> {
    let area = grains.section(axis).ok()?;
    let all = &grains.grains;
    let below = |x: &Vector, r: f64, at: f64| cap_volume(r, at - x[axis]);
    let parts = all.position.iter().zip(&all.radius);
    let solid = parts.map(|(x, r)| below(x, *r, to) - below(x, *r, from));
    Some(1.0 - solid.sum::<f64>() / (area * (to - from)))
}

/// Length of a deposit along an axis, m: from its start to the first slice of two diameters that holds less than a layer
/// of grains would with six tenths of its places taken.
fn deposit(grains: &GrainSystem, axis: usize) -> f64 {
    let all = &grains.grains;
    let diameter = 2.0 * all.mean_radius();
    let slice = 2.0 * diameter;
    let across = if axis == 0 { 1 } else { 0 };
    let width = match grains.period[across] {
        Some([low, high]) => high - low,
        None => {
            let reach = all.position.iter().zip(&all.radius);
            let reach = reach.flat_map(|(x, r)| [[x[across] - r], [x[across] + r]]);
            let [[low], [high]] = bounds(reach);
            high - low
        }
    };
    let begin = grains.walls.iter().find(|w| w.normal[axis] > 0.5);
    let begin = begin.map_or(0.0, |w| w.point[axis]);
    let mut volumes: Vec<f64> = Vec::new();
    for (x, r) in all.position.iter().zip(&all.radius) {
        let place = (x[axis] - begin) / slice;
        // Beyond ten thousand slices nothing belongs to a deposit.
        if (0.0..1e4).contains(&place) {
            let k = place as usize;
            volumes.resize(volumes.len().max(k + 1), 0.0);
            volumes[k] += sphere(*r);
        }
    }
    let layer = 0.6 * slice * width * diameter;
    let thin = volumes.iter().position(|v| *v < layer);
    thin.unwrap_or(volumes.len()) as f64 * slice
}

/// Name, unit and value of a column that runs have; the number is the last step, s.
type Common = (&'static str, &'static str, fn(&Model, f64) -> f64);

static COMMON: [Common; 8] = [
    ("time", "s", |m, _| m.grains().time),
    ("step", "", |m, _| m.grains().steps as f64),
    ("dt", "s", |_, dt| dt),
    ("kinetic_energy", "J", |m, _| m.grains().kinetic_energy()),
    ("unbalanced_force", "", |m, _| m.grains().unbalanced_force()),
    ("coordination", "", |m, _| m.grains().coordination()),
    ("porosity", "", |m, _| {
        m.grains().porosity().unwrap_or(f64::NAN)
    }),
    ("meshes", "", |m, _| {
        m.wet().map_or(0.0, |w| w.meshes as f64)
    }),
];

/// Columns that every run of a kind has.
fn common(scene: &Scene) -> impl Iterator<Item = &'static Common> {
    let has = |name: &str| match name {
        "porosity" => closed(scene),
        "meshes" => scene.fluid.is_some(),
        _ => true,
    };
    COMMON.iter().filter(move |(name, ..)| has(name))
}

/// True if the box has six walls or periodic ends all the time.
fn closed(scene: &Scene) -> bool {
    let removed = scene.wall.values().any(|w| w.removed);
    let whole = |b: &Box| b.open.is_empty() || (0..3).all(|axis| scene.periodic(axis));
    !removed && scene.r#box.as_ref().is_some_and(whole)
}

/// Names and units of all columns, in their order.
pub fn headings(scene: &Scene) -> Vec<(String, String)> {
    let own = common(scene).map(|(name, unit, _)| (name.to_string(), unit.to_string()));
    let probes = scene.probe.iter();
    let probes = probes.map(|(name, probe)| (name.clone(), unit(probe).to_string()));
    own.chain(probes).collect()
}

/// The row of now; `dt` is the last step, s.
pub fn row(scene: &Scene, model: &Model, origin: &Origin, dt: f64) -> Vec<f64> {
    let own = common(scene).map(|(_, _, value)| value(model, dt));
    let probes = scene.probe.values();
    let probes = probes.map(|p| value(p, scene, model, origin).unwrap_or(f64::NAN));
    own.chain(probes).collect()
}

/// Points along and across a mean radius.
const POINTS_PER_RADIUS: f64 = 4.0;

/// Mean height (m) of the top of a bed over a strip of a box along x or y: the upper surface of the grains, and the floor
/// between them. It follows every motion of the uppermost grains without a jump.
pub fn level(
    grains: &GrainSystem,
    [low, high]: [[f64; 3]; 2],
    axis: usize,
    [from, to]: [f64; 2],
) -> Option<f64> {
    let all = &grains.grains;
    let radius = all.mean_radius();
    let (mut first, mut last) = ([low[0], low[1]], [high[0], high[1]]);
    first[axis] = from.max(low[axis]);
    last[axis] = to.min(high[axis]);
    let length = |k: usize| last[k] - first[k];
    if length(0).min(length(1)) <= 0.0 {
        return None;
    }
    let counts = [0, 1].map(|k| ((POINTS_PER_RADIUS * length(k) / radius).ceil() as usize).max(1));
    let steps = [0, 1].map(|k| length(k) / counts[k] as f64);
    let place = |k: usize, n: usize| first[k] + (n as f64 + 0.5) * steps[k];
    let mut heights = vec![low[2]; counts[0] * counts[1]];
    for (x, r) in all.position.iter().zip(&all.radius) {
        let under = |k: usize| {
            let begin = ((x[k] - r - first[k]) / steps[k] - 0.5).ceil().max(0.0) as usize;
            let end = ((x[k] + r - first[k]) / steps[k] + 0.5).max(0.0) as usize;
            begin..end.min(counts[k])
        };
        for i in under(0) {
            for j in under(1) {
                let off = (place(0, i) - x[0]).powi(2) + (place(1, j) - x[1]).powi(2);
                if off <= r * r {
                    let height = &mut heights[i * counts[1] + j];
                    *height = height.max(x[2] + (r * r - off).sqrt());
                }
            }
        }
    }
    Some(heights.iter().sum::<f64>() / heights.len() as f64)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use crate::grains::{Grain, LinearElastic, Setup};

    use super::*;

    /// A hemisphere on a floor stands out by 2/3 π R³ over the area, at any depth.
    #[test]
    fn the_mean_height_of_a_ball_is_that_of_its_upper_half() {
        let (radius, depth) = (0.5, 0.7);
        let ball = Grain::new([1.0, 1.0, depth], radius, 2600.0);
        let setup = Setup::new(vec![ball], LinearElastic::new(1e6, 0.5, 0.5));
        let grains = GrainSystem::new(setup).expect("a grain");
        let room = [[0.0; 3], [2.0, 2.0, 2.0]];
        let whole = level(&grains, room, 0, [0.0, 2.0]).expect("a level");
        let disc = PI * radius * radius;
        let wanted = (disc * depth + 2.0 / 3.0 * PI * radius.powi(3)) / 4.0;
        // A disc of n points is counted to within its rim, of 2πR/step points.
        let step = radius / POINTS_PER_RADIUS;
        let bound = 2.0 * PI * radius * step * depth / 4.0;
        assert!(
            (whole - wanted).abs() < bound,
            "{whole} m, wanted {wanted} ± {bound} m"
        );
        assert_eq!(level(&grains, room, 0, [0.0, 0.2]), Some(0.0));
        assert_eq!(level(&grains, room, 0, [3.0, 4.0]), None);
    }
}
