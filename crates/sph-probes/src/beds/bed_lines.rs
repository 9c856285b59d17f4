//! The lines of a movable bed: free surface, water–sediment interface, limit of motion.

use sph_core::{StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::beds::columns::{Columns, End};
use crate::phases::phase::{self, CountedPhase};
use crate::{Curves, Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Three curves over a movable bed, moving mass of it (kg, per metre of width), and lowest point of the motion (m).
///
/// A grain moves if its speed |u| is above `threshold` = Δx/Δt, one pixel of the experiment's
/// camera in one of its images: 1 mm in 5 ms. Columns are two spacings wide, and in every one
/// * `surface` is half a spacing above the highest particle of all,
/// * `interface` half a spacing above the highest grain,
/// * `limit` half a spacing below the lowest grain that moves; the interface where none does.
///
/// Between the particles of neighbouring columns the curves are straight; they are given at the
/// middles of the columns from the first particle to the last, and NaN where there is none. With every
/// output of fields they go to `curves/NAME_0003.csv`, numbered as the pictures, with the columns x,
/// surface, interface and limit in m. `line` compares any of the three with a drawn one.
///
/// The lowest point is that of the limit where something moves, NaN where nothing does. A single
/// grain that moves deep in the bed draws the limit down to it. Two dimensions only.
///
/// Source: Ghaïtanellis 2017, §5.4.1 and Eq. 5.21.
///
/// ```toml
/// [probe.bed]
/// kind = "bed-lines"
/// phase = "sand"
/// ```
#[plugin(ProbeEntry [2], "bed-lines", "free surface, interface and limit of motion over a movable bed, as curves",
    source: "outermost particles; Ghaïtanellis 2017, Eq. 5.21")]
pub struct BedLines {
    /// Name of the phase that makes the bed.
    pub phase: String,
    /// Speed above which a grain moves.
    #[parameter(default: 0.2, unit: "m/s", above: 0.0, source: "Ghaïtanellis 2017, Eq. 5.21")]
    pub threshold: f64,
    #[serde(skip)]
    number: Option<u32>,
}

impl BedLines {
    /// Surface, interface and lowest moving grains, and the moving mass, kg.
    fn draw(&self, world: &World<2>) -> Result<([Columns; 3], f64), StepError> {
        let bed = CountedPhase::in_phase(world, Some(&self.phase), self.number)?;
        let positions = world.free.get(fields::POSITION)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let mass = world.free.get(fields::MASS)?;
        let xs = || positions.iter().map(|x: &Vect<2>| x[0]);
        let ends = [End::Highest, End::Highest, End::Lowest];
        let mut drawn = ends.map(|end| Columns::over(xs(), world.spacing, end));
        let [surface, interface, moving] = &mut drawn;
        let mut moving_mass = 0.0;
        for (k, x) in positions.iter().enumerate() {
            surface.put(x);
            if !bed.has(k) {
                continue;
            }
            interface.put(x);
            if velocity[k].norm() > self.threshold {
                moving.put(x);
                moving_mass += mass[k];
            }
        }
        Ok((drawn, moving_mass))
    }
}

impl Probe<2> for BedLines {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".moving", "kg"), (".lowest", "m")])
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        self.number = phase::number(Some(&self.phase), scene)?;
        Ok(())
    }

    fn as_curves(&self) -> Option<&dyn Curves<2>> {
        Some(self)
    }

    fn measure(&self, world: &World<2>) -> Result<Vec<f64>, StepError> {
        let ([.., moving], mass) = self.draw(world)?;
        let heights = moving.places().map(|place| place[1]);
        Ok(vec![mass, heights.fold(f64::NAN, f64::min)])
    }
}

impl Curves<2> for BedLines {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let names = ["x", "surface", "interface", "limit"];
        names.map(|name| ProbeColumn::named(name, "m")).into()
    }

    fn curves(&self, world: &World<2>) -> Result<Vec<Vec<f64>>, StepError> {
        let ([surface, interface, moving], _) = self.draw(world)?;
        let limit = moving.or(&interface);
        let lines = [&surface, &interface, &limit];
        let row = |x: f64| {
            let heights = lines.map(|line| line.height(x).unwrap_or(f64::NAN));
            [x].into_iter().chain(heights).collect()
        };
        Ok(surface.middles().map(row).collect())
    }
}
