//! A bed from above: how deep it is scoured, and where.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{StepError, fields, register};
use sph_neighbours::World;

use crate::phase::{self, Counted};
use crate::{Probe, ProbeColumn, ProbeEntry};

/// Width of a cell in spacings: one that grains have spread from by less than a spacing is not empty.
const WIDTH: f64 = 2.0;
/// Gap in spacings above which grains float over the bed: rows of a bed are one apart.
const GAP: f64 = 2.0;

/// Deepest scour and highest deposit (m), and volume scoured (m³) of a bed.
///
/// The bed is seen from above in square cells two spacings wide. Its height in a cell is half a spacing above the
/// last grain, from the bottom up, over which there is a gap of two spacings: what is in suspension does not count.
/// The depth of scour is `level` less that height, negative where the bed has risen.
///
/// With every output of fields the map goes to `curves/NAME_0003.csv`, with the columns x, y, height and depth in m, and to
/// `pictures/NAME_0003.png`. Cells without grains are left out: where the bed is gone to its ground there is nothing to
/// measure. Three dimensions only.
///
/// Source: the scour map of Ghaïtanellis 2017, §5.4.3; cells and gap are ours.
///
/// ```toml
/// [probe.scour]
/// kind = "scour-map"
/// phase = "sand"
/// level = 0.15
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScourMap {
    /// Name of the phase that makes the bed.
    pub phase: String,
    /// Height of the bed's top at the start.
    #[schemars(extend("unit" = "m"))]
    pub level: f64,
    /// Lower and upper corner, seen from above, of the part that counts; all of it if left out.
    #[schemars(extend("unit" = "m"))]
    pub within: Option<[[f64; 2]; 2]>,
    #[serde(skip)]
    number: Option<u32>,
}

/// A cell: its middle and the height of the bed, m.
struct Cell {
    middle: [f64; 2],
    height: f64,
}

impl ScourMap {
    fn cells(&self, world: &World<3>) -> Result<Vec<Cell>, StepError> {
        let bed = Counted::of(world, Some(&self.phase), self.number)?;
        let width = WIDTH * world.spacing;
        let inside = |x: f64, y: f64| {
            let between = |[low, high]: [f64; 2], v: f64| low <= v && v <= high;
            self.within
                .is_none_or(|[lo, hi]| between([lo[0], hi[0]], x) && between([lo[1], hi[1]], y))
        };
        let positions = world.free.get(fields::POSITION)?.iter().enumerate();
        let grains = positions.filter(|(k, x)| bed.has(*k) && inside(x[0], x[1]));
        let mut grains: Vec<([i64; 2], f64)> = grains
            .map(|(_, x)| ([0, 1].map(|axis| (x[axis] / width).floor() as i64), x[2]))
            .collect();
        grains.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let columns = grains.chunk_by(|a, b| a.0 == b.0);
        Ok(columns
            .map(|column| {
                let mut top = column[0].1;
                for (_, height) in column {
                    if height - top > GAP * world.spacing {
                        break;
                    }
                    top = *height;
                }
                Cell {
                    middle: column[0].0.map(|n| (n as f64 + 0.5) * width),
                    height: top + 0.5 * world.spacing,
                }
            })
            .collect())
    }
}

impl Probe<3> for ScourMap {
    fn columns(&self) -> Vec<ProbeColumn> {
        vec![
            ProbeColumn::named(".deepest", "m"),
            ProbeColumn::named(".highest", "m"),
            ProbeColumn::named(".volume", "m³"),
        ]
    }

    fn name_phases(&mut self, names: &[String]) -> Result<(), String> {
        self.number = Some(phase::number(&self.phase, names)?);
        Ok(())
    }

    fn measure(&self, world: &World<3>) -> Result<Vec<f64>, StepError> {
        let cells = self.cells(world)?;
        let depths = || cells.iter().map(|cell| self.level - cell.height);
        let area = (WIDTH * world.spacing).powi(2);
        Ok(vec![
            depths().fold(f64::NAN, f64::max),
            -depths().fold(f64::NAN, f64::min),
            depths().map(|depth| depth.max(0.0) * area).sum(),
        ])
    }

    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let names = ["x", "y", "height", "depth"];
        names.map(|name| ProbeColumn::named(name, "m")).into()
    }

    fn curves(&self, world: &World<3>) -> Result<Vec<Vec<f64>>, StepError> {
        let row = |cell: &Cell| {
            let [x, y] = cell.middle;
            vec![x, y, cell.height, self.level - cell.height]
        };
        Ok(self.cells(world)?.iter().map(row).collect())
    }

    fn drawn_column(&self) -> Option<usize> {
        Some(3)
    }
}

register!(
    ProbeEntry[3],
    ScourMap,
    "scour-map",
    "depth of scour and deposits of a bed, as a map",
    "Ghaïtanellis 2017, §5.4.3"
);
