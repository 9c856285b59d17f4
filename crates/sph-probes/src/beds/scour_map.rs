//! A bed from above: how deep it is scoured, and where.

use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::phases::phase::{self, CountedPhase};
use crate::{Curves, Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Width of a cell in spacings: one that grains have spread from by less than a spacing is not empty.
const WIDTH: f64 = 2.0;
/// Gap in spacings above which grains float over the bed: rows of a bed are one apart.
const GAP: f64 = 2.0;

/// Deepest scour and highest deposit (m), and volume scoured (m³) of a bed.
///
/// The bed is seen from above in cells two spacings wide, or a little wider so that whole ones fill the part that counts: where a
/// bed begins in the middle of a cell, its grains leave the half cell for the next. Its top in a cell is half a spacing above the
/// last grain, from the bottom up, over which there is a gap of two spacings: grains in suspension do not count. Its height is
/// that of the ground, half a spacing below the lowest particle of any phase, and the share of the grains among the particles up to the
/// top, times the way to it: a row of which water has taken half counts half. The depth of scour is `level` less that height,
/// negative where the bed has risen.
///
/// With every output of fields the map goes to `curves/NAME_0003.csv`, with the columns x, y, height and depth in m, and to
/// `pictures/NAME_0003.png`. Where no grain is left within `within`, the bed is gone to its ground; without `within`, cells
/// without grains are left out. Three dimensions only.
///
/// Source: the scour map of Ghaïtanellis 2017, §5.4.3; cells, gap and heights are ours.
///
/// ```toml
/// [probe.scour]
/// kind = "scour-map"
/// phase = "sand"
/// level = 0.15
/// ```
#[plugin(ProbeEntry [3], "scour-map", "depth of scour and deposits of a bed, as a map",
    source: "Ghaïtanellis 2017, §5.4.3")]
pub struct ScourMap {
    /// Name of the phase that makes the bed.
    pub phase: String,
    /// Height of the bed's top at the start.
    #[parameter(unit: "m")]
    pub level: f64,
    /// Lower and upper corner, seen from above, of the part that counts; all of it if left out.
    #[parameter(unit: "m")]
    pub within: Option<[[f64; 2]; 2]>,
    #[serde(skip)]
    number: Option<u32>,
}

/// Cells of the counted part, m.
struct Grid {
    corner: [f64; 2],
    width: [f64; 2],
    /// Cells along x and y, if there is an end.
    cells: [i64; 2],
}

impl ScourMap {
    fn grid(&self, spacing: f64) -> Grid {
        let least = WIDTH * spacing;
        let Some([low, high]) = self.within else {
            return Grid {
                corner: [0.0; 2],
                width: [least; 2],
                cells: [i64::MAX; 2],
            };
        };
        let long = [0, 1].map(|k| high[k] - low[k]);
        let cells = long.map(|l| (l / least + 1e-9).floor().max(1.0));
        Grid {
            corner: low,
            width: [0, 1].map(|k| long[k] / cells[k]),
            cells: cells.map(|n| n as i64),
        }
    }

    /// The middles of the cells and the heights of the bed there, m.
    fn cells(&self, world: &World<3>) -> Result<Vec<[f64; 3]>, StepError> {
        let bed = CountedPhase::in_phase(world, Some(&self.phase), self.number)?;
        let grid = self.grid(world.spacing);
        let cell = |k: usize, x: f64| {
            let n = ((x - grid.corner[k]) / grid.width[k]).floor() as i64;
            n.min(grid.cells[k] - 1)
        };
        let inside = |x: &Vect<3>| {
            let between = |[lo, hi]: [[f64; 2]; 2]| (0..2).all(|k| lo[k] <= x[k] && x[k] <= hi[k]);
            self.within.is_none_or(between)
        };
        let positions = world.free.get(fields::POSITION)?.iter().enumerate();
        let mut all: Vec<([i64; 2], f64, bool)> = positions
            .filter(|(_, x)| inside(x))
            .map(|(k, x)| ([0, 1].map(|k| cell(k, x[k])), x[2], bed.has(k)))
            .collect();
        all.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let columns = all.chunk_by(|a, b| a.0 == b.0);
        Ok(columns
            .filter_map(|column| {
                let middle = |k: usize| {
                    let n = column[0].0[k] as f64;
                    grid.corner[k] + (n + 0.5) * grid.width[k]
                };
                let particles = column.iter().map(|(_, z, grain)| (*z, *grain));
                let height = height(particles, world.spacing);
                let emptied = self.within.map(|_| column[0].1 - 0.5 * world.spacing);
                Some([middle(0), middle(1), height.or(emptied)?])
            })
            .collect())
    }
}

/// Height of the bed in a cell from the particles there, from the lowest up, each with whether it is a grain of the bed; none
/// without grains.
fn height(particles: impl Iterator<Item = (f64, bool)> + Clone, spacing: f64) -> Option<f64> {
    let ground = particles.clone().next()?.0 - 0.5 * spacing;
    let mut grains = particles.clone().filter(|(_, grain)| *grain);
    let mut top = grains.next()?.0;
    for (z, _) in grains {
        if z - top > GAP * spacing {
            break;
        }
        top = z;
    }
    let (mut own, mut all) = (0.0, 0.0);
    for (_, grain) in particles.take_while(|(z, _)| *z <= top) {
        all += 1.0;
        own += f64::from(u8::from(grain));
    }
    Some(ground + (top + 0.5 * spacing - ground) * own / all)
}

impl Probe<3> for ScourMap {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".deepest", "m"), (".highest", "m"), (".volume", "m³")])
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(Some(&self.phase), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<3>) -> Result<Vec<f64>, StepError> {
        let cells = self.cells(world)?;
        let depths = || cells.iter().map(|[.., height]| self.level - height);
        let [long, wide] = self.grid(world.spacing).width;
        let area = long * wide;
        Ok(vec![
            depths().fold(f64::NAN, f64::max),
            -depths().fold(f64::NAN, f64::min),
            depths().map(|depth| depth.max(0.0) * area).sum(),
        ])
    }

    fn as_curves(&self) -> Option<&dyn Curves<3>> {
        Some(self)
    }
}

impl Curves<3> for ScourMap {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let names = ["x", "y", "height", "depth"];
        names.map(|name| ProbeColumn::named(name, "m")).into()
    }

    fn curves(&self, world: &World<3>) -> Result<Vec<Vec<f64>>, StepError> {
        let row = |[x, y, height]: &[f64; 3]| vec![*x, *y, *height, self.level - height];
        Ok(self.cells(world)?.iter().map(row).collect())
    }

    fn drawn_column(&self) -> Option<usize> {
        Some(3)
    }
}
