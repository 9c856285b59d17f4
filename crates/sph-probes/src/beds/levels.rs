//! Levels of beds and suspensions, and the mass that a bed has lost.

use sph_core::bed::Bed;
use sph_core::{StepError, fields, plugin, suggestion};
use sph_neighbours::World;

use crate::measure::level::highest_place;
use crate::measure::presets::Direction;
use crate::phases::phase::{self, CountedPhase};
use crate::{Curves, Probe, ProbeColumn, ProbeEntry, ProbeScene};

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
        // Of equals the first place.
        let [lowest, highest] = [1.0, -1.0].map(|sign| {
            let level = |place: &usize| sign * bed.level(*place);
            let found = self
                .places(bed)
                .min_by(|a, b| level(a).total_cmp(&level(b)));
            found.map_or([f64::NAN; 2], |k| [bed.level(k), bed.grid.position(k)[0]])
        });
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

    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        Some(self)
    }
}

impl<const D: usize> Curves<D> for BedLevels {
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

/// The highest place at which the concentration of suspended grains comes up to a value, m: the interface below clear fluid, or
/// that of a deposit. NaN where it does not.
///
/// The concentration at a height is the mean over the particles within a spacing, weighed with their mass and 1 − |Δz|/δr;
/// between heights a quarter of a spacing apart it is linear.
///
/// Source: ours.
///
/// ```toml
/// [probe.deposit]
/// kind = "concentration-level"
/// concentration = 0.55
/// ```
#[plugin(ProbeEntry [2, 3], "concentration-level", "height of a concentration of suspended grains",
    source: "the highest place where the mean over a spacing comes up to it")]
pub struct ConcentrationLevel {
    /// The concentration.
    #[parameter(unit: "1", above: 0.0, max: 1.0)]
    pub concentration: f64,
}

impl<const D: usize> Probe<D> for ConcentrationLevel {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("m")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let concentration = world.free.get(fields::CONCENTRATION).map_err(|_| {
            let reason = "no fluid of this scene carries grains: expected `[suspension.PLUGIN]`";
            StepError::stage("probe `concentration-level`", reason)
        })?;
        let (position, mass) = world.free.all((fields::POSITION, fields::MASS))?;
        let grains = (0..position.len()).map(|k| [position[k][D - 1], mass[k], concentration[k]]);
        let level = highest_place(grains.collect(), world.spacing, self.concentration);
        Ok(vec![level])
    }
}

/// Mass of a bed that has left its place at the start, kg (per metre of width in 2D).
///
/// The thesis takes the error Er = (m_SPH − m_exp)/m_exp of the mass m of all sediment that has
/// reached the downstream outlet of the flume. Here
/// * `.out` is the mass of the phase beyond the outlet, a place along x, and of what has left by any
///   `[outlet.NAME]`: the m of the error;
/// * `.risen` is the mass of those before the outlet that are above `level`, the level of the bed at
///   the start: what is under way, or came to rest on the bed;
/// * `.total` is the sum of both: all that has left the region of the bed at the start.
///
/// Motion within that region does not count. The centre of a particle decides: the top row of a
/// flat bed has to rise by half a spacing until it counts.
///
/// Source: Ghaïtanellis 2017, §5.4.1 and Eq. 5.17; `.risen` is ours.
///
/// ```toml
/// [probe.eroded]
/// kind = "eroded-mass"
/// phase = "sand"
/// level = 0.1
/// beyond = 6.0
/// ```
#[plugin(ProbeEntry [2, 3], "eroded-mass", "mass of a bed beyond an outlet and above its first level",
    source: "Ghaïtanellis 2017, Eq. 5.17")]
pub struct ErodedMass {
    /// Name of the phase that makes the bed.
    pub phase: String,
    /// Height of the bed's top at the start.
    #[parameter(unit: "m")]
    pub level: f64,
    /// Place of the outlet along x; there is none if left out.
    #[parameter(unit: "m")]
    pub beyond: Option<f64>,
    /// The way out: towards larger or smaller x.
    #[parameter(default)]
    pub direction: Direction,
    #[serde(skip)]
    number: Option<u32>,
}

impl<const D: usize> Probe<D> for ErodedMass {
    fn columns(&self) -> Vec<ProbeColumn> {
        let suffixes = [".out", ".risen", ".total"];
        suffixes.map(|s| ProbeColumn::named(s, "kg")).into()
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(Some(&self.phase), scene)?;
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let bed = CountedPhase::in_phase(world, Some(&self.phase), self.number)?;
        let sign = match self.direction {
            Direction::Forward => 1.0,
            Direction::Backward => -1.0,
        };
        let is_out = |x: f64| self.beyond.is_some_and(|end| sign * (x - end) > 0.0);
        let positions = world.free.get(fields::POSITION)?.iter();
        let all = positions.zip(world.free.get(fields::MASS)?).enumerate();
        let taken = world.free.removed.iter();
        let taken = taken.filter(|t| Some(t.phase) == self.number);
        let (mut out, mut risen) = (taken.map(|t| t.mass).sum(), 0.0);
        for (_, (x, mass)) in all.filter(|(k, _)| bed.has(*k)) {
            if is_out(x[0]) {
                out += mass;
            } else if x[D - 1] > self.level {
                risen += mass;
            }
        }
        Ok(vec![out, risen, out + risen])
    }
}
