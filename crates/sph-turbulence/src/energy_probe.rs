//! The energy of eddies that particles do not resolve.

use sph_core::{StepError, fields, plugin};
use sph_neighbours::World;
use sph_probes::{Needs, Probe, ProbeColumn, ProbeEntry};

use crate::columns::{DISSIPATION, TURBULENT_ENERGY};

/// Σ m k, J (per metre of depth in 2D), its mean Σ m k/Σ m and the largest k, m²/s², of a closure that transports k; and with k–ε
/// the mean dissipation Σ m ε/Σ m, m²/s³. Particles without eddies do not count.
///
/// ```toml
/// [probe.eddies]
/// kind = "turbulent-energy"
/// ```
#[plugin(ProbeEntry [2, 3], "turbulent-energy", "energy of the eddies that a closure transports", source: "Σ m k", cfg(not(test)))]
pub struct TurbulentEnergyProbe {}

impl<const D: usize> Probe<D> for TurbulentEnergyProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        vec![
            ProbeColumn::named("", "J"),
            ProbeColumn::named(".mean", "m²/s²"),
            ProbeColumn::named(".largest", "m²/s²"),
            ProbeColumn::named(".dissipation", "m²/s³"),
        ]
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: vec![TURBULENT_ENERGY.name.into()],
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        if !world.free.has(TURBULENT_ENERGY.name) {
            let why = "no closure of this scene transports k: name one, `[eddy-viscosity.k-epsilon]` or \
                       `[eddy-viscosity.k-length]`";
            return Err(StepError::stage("probe `turbulent-energy`", why));
        }
        let (mass, energy) = world.free.all((fields::MASS, TURBULENT_ENERGY))?;
        let dissipation = world.free.get(DISSIPATION).ok();
        let [mut all, mut total, mut largest, mut lost] = [0.0; 4];
        for (i, (m, k)) in mass.iter().zip(energy).enumerate() {
            if *k > 0.0 {
                all += m;
                total += m * k;
                largest = k.max(largest);
                lost += m * dissipation.map_or(f64::NAN, |e| e[i]);
            }
        }
        Ok(match all > 0.0 {
            true => vec![total, total / all, largest, lost / all],
            false => vec![0.0, f64::NAN, f64::NAN, f64::NAN],
        })
    }
}
