//! The least and largest value of a field.

use std::sync::OnceLock;

use sph_core::{Plain, StepError, plugin};
use sph_neighbours::World;

use crate::{Needs, Probe, ProbeColumn, ProbeEntry};

/// Smallest and largest value of a field, in its own unit; over `scale`, without one.
///
/// ```toml
/// [probe.deficit]
/// kind = "range"
/// field = "density_constant"
/// scale = 1000
/// ```
#[plugin(ProbeEntry [2, 3], "range", "smallest and largest value of a field", source: "plain extrema")]
pub struct FieldRange {
    /// Name of the field.
    pub field: String,
    /// The values are divided by this, in the field's own unit; 1 leaves them as they are.
    #[parameter(default: 1.0, above: 0.0)]
    pub scale: f64,
    /// Unit of the field, known from the first measurement on.
    #[serde(skip)]
    unit: OnceLock<&'static str>,
}

impl<const D: usize> Probe<D> for FieldRange {
    fn columns(&self) -> Vec<ProbeColumn> {
        let own = self.unit.get().filter(|_| self.scale == 1.0);
        let unit = own.copied().unwrap_or("1");
        [".min", ".max"]
            .map(|suffix| ProbeColumn::named(suffix, unit))
            .into()
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: vec![&self.field],
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let mut columns = world.free.columns();
        let found = columns.find(|(name, ..)| *name == self.field);
        match found {
            Some((_, unit, _, components, Plain::Real(values))) => {
                self.unit.get_or_init(|| unit);
                let magnitude = |v: &[f64]| match v {
                    [x] => *x,
                    _ => v.iter().map(|x| x * x).sum::<f64>().sqrt(),
                };
                let all = || values.chunks(components).map(|v| magnitude(v) / self.scale);
                Ok(vec![
                    all().fold(f64::NAN, f64::min),
                    all().fold(f64::NAN, f64::max),
                ])
            }
            _ => Err(StepError::Stage {
                stage: "probe `range`".into(),
                reason: format!(
                    "there is no field `{}` in this scene; there are: {}",
                    self.field,
                    world
                        .free
                        .columns()
                        .map(|c| c.0)
                        .collect::<Vec<_>>()
                        .join(", ")
                ),
            }),
        }
    }
}
