//! The pressure of the water in the pores at a point.

use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::contract::refused;
use crate::flow::point::{carried, point};
use crate::sampling::mean_around;
use crate::{Needs, Probe, ProbeColumn, ProbeEntry};

/// Pore-water pressure q = p − p' at a point: that of the water in the pores of a soil, and of the
/// water beside it.
///
/// q = Σ V [q_b + ρ_w g·(x − r_b)] w / Σ V w, as `pressure` with the weight of the pores' fluid;
/// 0 where there is nothing. p is the pressure of the equation of state and p' the effective
/// pressure, 0 outside of soils. Only scenes with `[effective-pressure.PLUGIN]` have it; for such
/// probes the field `pore_pressure` is computed.
///
/// Source: Ghaïtanellis 2017, Eqs. 2.91 and 5.26.
///
/// ```toml
/// [gauge.PG1]
/// kind = "pore-pressure"
/// at = [1.2, 0.05]
/// ```
#[plugin(ProbeEntry [2, 3], "pore-pressure", "pressure of the water in a soil's pores at a point",
    source: "p − p'; Ghaïtanellis 2017, Eqs. 2.91, 5.26")]
pub struct PorePressureProbe {
    /// Position, m.
    #[parameter(unit: "m")]
    pub at: Vec<f64>,
    /// Density ρ_w of the fluid in the pores.
    #[parameter(default: 1000.0, unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Name of the moving wall that carries the sensor; it stands still if left out.
    pub follows: Option<String>,
}

impl<const D: usize> Probe<D> for PorePressureProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("Pa")
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: vec![fields::PORE_PRESSURE.name.into()],
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let pore = world.free.get(fields::PORE_PRESSURE).map_err(|_| {
            let reason =
                "there is no pore pressure without an effective one: [effective-pressure.PLUGIN]";
            refused("probes", reason)
        })?;
        let x = carried(world, point::<D>(&self.at), self.follows.as_deref())?;
        let own =
            |j: usize, d: &Vect<D>| Vect::from([pore[j] + self.density * world.gravity.dot(d)]);
        Ok(vec![mean_around(world, x, own)?[0]])
    }
}
