//! Columns of the series.

use crate::scene::measure;
use crate::scene::model::Model;
use crate::scene::names::periodic;
use crate::scene::origin::Origin;
use crate::scene::tables::Scene;

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
        m.wet().map_or(0.0, |w| w.meshes() as f64)
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
    let Some(given) = &scene.r#box else {
        return false;
    };
    !removed && (given.open.is_empty() || (0..3).all(|axis| periodic(scene, axis)))
}

/// Names and units of all columns, in their order.
pub fn headings(scene: &Scene) -> Vec<(String, String)> {
    let own = common(scene).map(|(name, unit, _)| (name.to_string(), unit.to_string()));
    let probes = scene.probe.iter();
    let probes = probes.map(|(name, probe)| (name.clone(), measure::unit(probe).to_string()));
    own.chain(probes).collect()
}

/// The row of now; `dt` is the last step, s.
pub fn row(scene: &Scene, model: &Model, origin: &Origin, dt: f64) -> Vec<f64> {
    let own = common(scene).map(|(_, _, value)| value(model, dt));
    let probes = scene.probe.values();
    own.chain(probes.map(|p| measure::value(p, scene, model, origin)))
        .collect()
}
