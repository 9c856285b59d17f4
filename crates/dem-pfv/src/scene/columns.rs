//! Columns of the series.

use crate::scene::measure;
use crate::scene::model::Model;
use crate::scene::names::periodic;
use crate::scene::origin::Origin;
use crate::scene::read::Loaded;
use crate::scene::tables::Scene;

/// Columns that every run of a kind has, with their units.
fn common(scene: &Scene) -> Vec<(&'static str, &'static str)> {
    let mut all = vec![
        ("time", "s"),
        ("step", ""),
        ("dt", "s"),
        ("kinetic_energy", "J"),
        ("unbalanced_force", ""),
        ("coordination", ""),
    ];
    if closed(scene) {
        all.push(("porosity", ""));
    }
    if scene.fluid.is_some() {
        all.push(("meshes", ""));
    }
    all
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
pub fn headings(loaded: &Loaded) -> Vec<(String, &'static str)> {
    let own = common(&loaded.scene).into_iter();
    let own = own.map(|(name, unit)| (name.to_string(), unit));
    let probes = (loaded.scene.probe)
        .iter()
        .map(|(name, probe)| (name.clone(), measure::unit(probe)));
    own.chain(probes).collect()
}

/// The row of now; `dt` is the last step, s.
pub fn row(loaded: &Loaded, model: &Model, origin: &Origin, dt: f64) -> Vec<f64> {
    let grains = model.grains();
    let scene = &loaded.scene;
    let own = common(scene).into_iter().map(|(name, _)| match name {
        "time" => grains.time,
        "step" => grains.steps as f64,
        "dt" => dt,
        "kinetic_energy" => grains.kinetic_energy(),
        "unbalanced_force" => grains.unbalanced_force(),
        "coordination" => grains.coordination(),
        "porosity" => grains.porosity().unwrap_or(f64::NAN),
        "meshes" => model.wet().map_or(0.0, |w| w.meshes() as f64),
        _ => f64::NAN,
    });
    let probes = scene.probe.values();
    own.chain(probes.map(|p| measure::value(p, scene, model, origin)))
        .collect()
}
