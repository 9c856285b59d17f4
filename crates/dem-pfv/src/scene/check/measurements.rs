//! Mistakes of probes, and of the references that they are compared with.

use scene_text::{Problems, suggestion};

use crate::scene::names::planes;
use crate::scene::tables::{Axis, Probe, Reference, Scene};

/// Mistakes of a probe.
pub fn probe(scene: &Scene, name: &str, probe: &Probe, found: &mut Problems) {
    let at = |key: &str| format!("probe.{name}.{key}");
    let wet = "needs a `[fluid]`";
    match probe {
        Probe::Stress { wall }
        | Probe::Borne { wall }
        | Probe::Flux { wall }
        | Probe::Amplitude { wall } => {
            let names = planes(scene);
            if !names.contains(wall) {
                let near = suggestion(wall, names.iter().map(String::as_str));
                found.add(at("wall"), format!("there is no wall `{wall}`{near}"));
            }
            let waves = scene.wall.get(wall).is_some_and(|w| w.wave.is_some());
            if matches!(probe, Probe::Amplitude { .. }) && !waves {
                found.add(at("wall"), format!("there is no wave on `{wall}`"));
            }
            if matches!(probe, Probe::Flux { .. }) && scene.fluid.is_none() {
                found.add(at("kind"), wet);
            }
        }
        Probe::Carried {}
        | Probe::Pressure { .. }
        | Probe::Gradient { .. }
        | Probe::Permeability { .. }
            if scene.fluid.is_none() =>
        {
            found.add(at("kind"), wet);
        }
        Probe::Consolidation {} if scene.oedometer.is_none() => {
            found.add(at("kind"), "needs an `[oedometer]`");
        }
        Probe::Strain { .. }
        | Probe::VolumetricStrain {}
        | Probe::Deviator { .. }
        | Probe::MeanStress {}
        | Probe::EffectiveStress { .. }
        | Probe::Porosity { .. } => {
            let closed = scene.r#box.as_ref().is_some_and(|b| b.open.is_empty());
            if !closed {
                found.add(at("kind"), "needs a closed `[box]`");
            }
        }
        Probe::Level { .. } if scene.r#box.is_none() => found.add(at("kind"), "needs a `[box]`"),
        Probe::Level { axis: Axis::Z, .. } => found.add(at("axis"), "must be x or y"),
        _ => {}
    }
    if let Probe::Pressure { from, to, .. }
    | Probe::Gradient { from, to, .. }
    | Probe::Level { from, to, .. }
    | Probe::K0 { from, to, .. }
    | Probe::Porosity { from, to, .. } = probe
        && from >= to
    {
        found.add(
            at("to"),
            format!("must be above `from`: {to} m is not above {from} m"),
        );
    }
}

/// Mistakes of a reference.
pub fn reference(scene: &Scene, name: &str, reference: &Reference, found: &mut Problems) {
    let probes = &scene.probe;
    let at = |key: &str| format!("reference.{name}.{key}");
    let mut known = |key: &str, probe: &str| {
        if !probes.contains_key(probe) {
            let near = suggestion(probe, probes.keys().map(String::as_str));
            found.add(at(key), format!("there is no probe `{probe}`{near}"));
        }
    };
    match reference {
        Reference::Terzaghi { probe, .. } => {
            known("probe", probe);
            if scene.oedometer.is_none() {
                found.add(at("kind"), "needs an `[oedometer]`");
            }
        }
        Reference::Line { along, probe, .. } => {
            known("along", along);
            known("probe", probe);
        }
        Reference::Scaling { probe, .. } => {
            known("probe", probe);
            let fits = matches!(probes.get(probe), Some(Probe::RunOut { .. }) | None);
            if !fits {
                found.add(at("probe"), "a probe of the kind `run-out` is needed");
            }
        }
        Reference::Value { probe, .. } | Reference::Curve { probe, .. } => known("probe", probe),
    }
}
