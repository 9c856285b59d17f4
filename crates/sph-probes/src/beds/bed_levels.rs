//! The level of a wall that grains make.

use sph_core::bed::Bed;
use sph_core::{StepError, plugin, suggestion};
use sph_neighbours::World;

use crate::{Probe, ProbeColumn, ProbeEntry};

/// Levels of a bed, its load, and Shields numbers.
///
/// Columns: the lowest place of the bed, `.lowest` (m), with its `.lowest-x`, and the highest, `.highest`, with `.highest-x`;
/// the change of its volume with pores, `.volume`; the mean Shields number, `.shields`; the mean flux of grains without pores
/// along x, `.transport` (m²/s), and over √((s − 1) g d³), `.rate`; the volume of grains that came in at the ends, `.fed`, that
/// slid, `.slid`, and that the flow has lifted into suspension less what settled, `.lifted`. With every output of fields a row
/// for each place goes to `curves/NAME_0003.csv`: x, y in three dimensions, level, rise since the start, Shields number and flux.
///
/// ```toml
/// [probe.bed]
/// kind = "bed-levels"
/// wall = "bed"
/// ```
#[plugin(ProbeEntry [2, 3], "bed-levels", "levels, Shields numbers and transport of a wall that grains make",
    source: "Exner 1925")]
pub struct BedLevels {
    /// Name of the `erodible` wall.
    pub wall: String,
    /// Only places from here on along x count.
    #[parameter(unit: "m")]
    pub from: Option<f64>,
    /// Only places up to here along x count.
    #[parameter(unit: "m")]
    pub to: Option<f64>,
}

impl BedLevels {
    fn bed<'a, const D: usize>(&self, world: &'a World<D>) -> Result<&'a Bed, StepError> {
        let name = |bed: &Bed| world.walls.names[bed.walls[0] as usize].as_str();
        let beds = &world.walls.beds;
        let found = beds.iter().find(|bed| name(bed) == self.wall);
        found.ok_or_else(|| {
            let near = suggestion(&self.wall, beds.iter().map(name));
            let reason = format!("no wall `{}` is `erodible`{near}", self.wall);
            StepError::stage("probe `bed-levels`", reason)
        })
    }

    /// The places that count.
    fn places<'a>(&self, bed: &'a Bed) -> impl Iterator<Item = usize> + 'a {
        let from = self.from.unwrap_or(f64::NEG_INFINITY);
        let to = self.to.unwrap_or(f64::INFINITY);
        let counts = move |k: &usize| {
            let x = bed.grid.position(*k)[0];
            !bed.covered[*k] && x >= from && x <= to
        };
        (0..bed.grid.len()).filter(counts)
    }
}

impl<const D: usize> Probe<D> for BedLevels {
    fn columns(&self) -> Vec<ProbeColumn> {
        let volume = if D == 2 { "m²" } else { "m³" };
        ProbeColumn::several(&[
            (".lowest", "m"),
            (".lowest-x", "m"),
            (".highest", "m"),
            (".highest-x", "m"),
            (".volume", volume),
            (".shields", "1"),
            (".transport", "m²/s"),
            (".rate", "1"),
            (".fed", volume),
            (".slid", volume),
            (".lifted", volume),
        ])
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let bed = self.bed(world)?;
        let none = [f64::NAN; 2];
        let best = |better: fn(f64, f64) -> bool| {
            self.places(bed).fold(none, |[level, x], place| {
                let here = bed.level(place);
                match level.is_nan() || better(here, level) {
                    true => [here, bed.grid.position(place)[0]],
                    false => [level, x],
                }
            })
        };
        let (lowest, highest) = (best(|a, b| a < b), best(|a, b| a > b));
        let area: f64 = self.places(bed).map(|k| bed.grid.area(k)).sum();
        let total = |value: &dyn Fn(usize) -> f64| -> f64 {
            self.places(bed).map(|k| bed.grid.area(k) * value(k)).sum()
        };
        let transport = total(&|k| bed.transport[k][0]) / area;
        Ok(vec![
            lowest[0],
            lowest[1],
            highest[0],
            highest[1],
            total(&|k| bed.lift[k]),
            total(&|k| bed.shields(k)) / area,
            transport,
            match bed.unit_transport > 0.0 {
                true => transport / bed.unit_transport,
                false => 0.0,
            },
            bed.fed,
            bed.slid,
            bed.lifted,
        ])
    }

    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let mut all = ProbeColumn::several(&[
            ("x", "m"),
            ("y", "m"),
            ("level", "m"),
            ("rise", "m"),
            ("shields", "1"),
            ("transport", "m²/s"),
            ("transport-y", "m²/s"),
        ]);
        all.retain(|column| D == 3 || !column.suffix.ends_with('y'));
        all
    }

    fn curves(&self, world: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        let bed = self.bed(world)?;
        let row = |k: usize| {
            let mut row = bed.grid.position(k)[..D - 1].to_vec();
            row.extend([bed.level(k), bed.lift[k], bed.shields(k)]);
            row.extend(&bed.transport[k][..D - 1]);
            row
        };
        Ok(self.places(bed).map(row).collect())
    }
}
