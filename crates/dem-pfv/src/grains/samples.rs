//! Samples: random clouds of spheres that do not touch, grown or left to settle.

use sph_core::place_cells::{PlaceCells, offsets};
use sph_core::{SplitMix, parameters};

use crate::grains::{Grain, GrainError, GrainSystem, Period, Unrest, Vector, positive, separation};
use crate::{require, sphere};

/// Random places that are tried for a sphere.
const TRIES: usize = 20_000;

/// A box in which spheres are put at random without overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Cloud {
    low: Vector,
    high: Vector,
    period: Period,
}

impl Cloud {
    /// Between two corners, m; spheres stay inside.
    pub fn new(low: [f64; 3], high: [f64; 3]) -> Self {
        Self {
            low: low.into(),
            high: high.into(),
            period: [None; 3],
        }
    }

    /// The same, where spheres may lie across the ends of an axis.
    #[must_use]
    pub fn periodic(mut self, axis: usize) -> Self {
        if axis < 3 {
            self.period[axis] = Some([self.low[axis], self.high[axis]]);
        }
        self
    }

    /// Centres (m) of spheres of these radii (m) in their order; the same for the same seed. Large ones are placed
    /// first, so that small ones fill the gaps.
    ///
    /// # Errors
    /// Radii that are not positive; a sphere for which 20,000 random places were all taken, as happens from a porosity
    /// of about 0.62 downwards.
    pub fn place(&self, radii: &[f64], seed: u64) -> Result<Vec<Vector>, GrainError> {
        for (grain, &value) in radii.iter().enumerate() {
            positive(grain, "radius", value)?;
        }
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..radii.len()).collect();
        order.sort_by(|&i, &j| radii[j].total_cmp(&radii[i]).then(i.cmp(&j)));
        let mut draw = SplitMix(seed);
        // A little wider than the widest pair, so that rounding of cells loses none.
        let mut cells = PlaceCells::new(2.02 * largest, []);
        let repeats = |image: &[i64; 3]| (0..3).all(|k| image[k] == 0 || self.period[k].is_some());
        let images: Vec<_> = offsets().filter(repeats).collect();
        let length = self.high - self.low;
        let mut places = vec![Vector::zeros(); radii.len()];
        for grain in order {
            let radius = radii[grain];
            let inner = |axis: usize| {
                let rim = self.period[axis].map_or(radius, |_| 0.0);
                (self.low[axis] + rim, self.high[axis] - rim)
            };
            let ranges = [inner(0), inner(1), inner(2)];
            let fits = ranges.iter().all(|(from, to)| from <= to);
            let place = (0..if fits { TRIES } else { 0 }).find_map(|_| {
                let at = Vector::from(ranges.map(|(from, to)| from + (to - from) * draw.unit()));
                let free = cells.around(at.into()).all(|&other: &usize| {
                    let reach = radius + radii[other];
                    separation(&at, &places[other], &self.period).norm_squared() >= reach * reach
                });
                free.then_some(at)
            });
            let Some(at) = place else {
                return Err(GrainError::NoRoom(grain, radius, TRIES));
            };
            places[grain] = at;
            for image in &images {
                let place = std::array::from_fn(|k| at[k] + image[k] as f64 * length[k]);
                cells.add(place, grain);
            }
        }
        Ok(places)
    }

    /// Grains at rest with the centres of [`Cloud::place`] and this density, kg/m³.
    ///
    /// # Errors
    /// As [`Cloud::place`].
    pub fn grains(&self, radii: &[f64], density: f64, seed: u64) -> Result<Vec<Grain>, GrainError> {
        let places = self.place(radii, seed)?;
        let grain = |(x, r): (Vector, &f64)| Grain::new(x.into(), *r, density);
        Ok(places.into_iter().zip(radii).map(grain).collect())
    }
}

/// Radii drawn evenly from an interval, m; the same for the same seed.
pub fn uniform_radii(count: usize, smallest: f64, largest: f64, seed: u64) -> Vec<f64> {
    let mut draw = SplitMix(seed ^ 0x5eed);
    let mut radius = |_| smallest + (largest - smallest) * draw.unit();
    (0..count).map(&mut radius).collect()
}

/// Grains at rest for dry pluviation: a cloud of the given porosity above the floor z = `low`, as high as it must be.
/// Falling and coming to rest is [`crate::grains::step_to_rest`]'s work; the friction between grains sets how dense they lie.
/// The cross-section is from `low` to `high` in x and y, in m. Source: Catalano 2012, ch. 6 (deposited beds).
///
/// # Errors
/// As [`Cloud::place`].
pub fn rain(
    low: [f64; 3],
    high: [f64; 2],
    radii: &[f64],
    density: f64,
    porosity: f64,
    seed: u64,
) -> Result<Vec<Grain>, GrainError> {
    let solid: f64 = radii.iter().map(|r| sphere(*r)).sum();
    let area = (high[0] - low[0]) * (high[1] - low[1]);
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let height = (solid / ((1.0 - porosity) * area)).max(2.0 * largest);
    let cloud = Cloud::new(low, [high[0], high[1], low[2] + height]);
    cloud.grains(radii, density, seed)
}

/// Growth to a stress or to a porosity, without gravity. `radius` gives the proportions; at the start they fill a quarter
/// of the box.
#[parameters]
#[derive(Copy, PartialEq)]
pub struct Grown {
    /// Mean stress of the walls, Pa.
    #[parameter(unit: "Pa", above: 0.0)]
    pub stress: Option<f64>,
    /// Porosity.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub porosity: Option<f64>,
    /// Largest factor of the radii in ten steps before the stress was first reached.
    #[parameter(default: 1.0 + 2e4 / 15e6, unit: "1", above: 1.0)]
    pub fast: f64,
    /// The same afterwards.
    #[parameter(default: 1.0 + 2e3 / 15e6, unit: "1", above: 1.0)]
    pub slow: f64,
    /// Unbalanced force ratio and relative distance from the stress at which it ends.
    #[parameter(default: 1e-3, unit: "1", above: 0.0)]
    pub tolerance: f64,
}

/// Steps between two changes of the radii.
const EVERY: u64 = 10;

impl Grown {
    /// Internal compaction: grows the radii of a system between fixed walls until a stress or, without one, a porosity is
    /// reached, by steps of a share `safety` of the critical one; returns the number of steps.
    ///
    /// Every ten steps all radii are multiplied by 1 + (1 − σ_m/σ₀) (m − 1), σ_m the mean stress of the walls, where m is
    /// `fast` until σ₀ was first exceeded and `slow` from then on; to a porosity they grow by `fast` alone and
    /// stop there. Walls without friction and some damping are the custom, and m_fast = 1 + 2·10⁴ Pa/E,
    /// m_slow = 1 + 2·10³ Pa/E with the micro modulus E in Pa. Source: the triaxial controller of YADE; the method is named
    /// by Catalano 2012, ch. 2, without equations.
    ///
    /// # Errors
    /// A box that is not closed; a target out of range; [`GrainError::NotReached`] after so many steps, `most`; the
    /// refusals of a step.
    pub fn run(&self, system: &mut GrainSystem, safety: f64, most: u64) -> Result<u64, GrainError> {
        let goal = self.stress.or(self.porosity).unwrap_or(f64::NAN);
        let (what, fine) = match self.stress {
            Some(_) => ("the stress is", goal > 0.0),
            None => ("the porosity is", goal > 0.0 && goal < 1.0),
        };
        require(what, goal, "positive, a porosity below 1", fine)?;
        let mut reached = false;
        let (mut unbalanced, mut stress) = (f64::INFINITY, 0.0);
        for made in 0..most {
            system.evaluate()?;
            if made % EVERY == 0 {
                unbalanced = system.unbalanced_force();
                stress = system.mean_stress()?;
                let still = unbalanced < self.tolerance;
                let factor = match self.stress {
                    Some(_) => {
                        reached |= stress >= goal;
                        if still && (stress / goal - 1.0).abs() < self.tolerance {
                            return Ok(made);
                        }
                        let most = if reached { self.slow } else { self.fast };
                        1.0 + (1.0 - stress / goal) * (most - 1.0)
                    }
                    None => {
                        let (volume, solid) = (system.box_volume(), system.grains.volume());
                        let volume = volume.ok_or(GrainError::NoArea(0))?;
                        let left = ((1.0 - goal) * volume / solid).cbrt();
                        if left <= 1.0 && still {
                            return Ok(made);
                        }
                        left.min(self.fast).max(1.0)
                    }
                };
                // A factor near zero or below would come from a stress far above the target.
                if factor != 1.0 {
                    system.scale_radii(factor.max(0.99))?;
                }
            }
            let step = safety * system.current_limit();
            system.integrate(step)?;
        }
        Err(GrainError::NotReached(most, unbalanced, stress))
    }
}

/// Steps at a share `safety` of the critical step until the grains are at rest to a `tolerance`
/// ([`GrainSystem::unrest`]); returns the number of steps. Motion that is left while all forces are in balance, as that
/// of grains that roll over a floor, is taken away.
///
/// # Errors
/// [`GrainError::NotSettled`] after `most_steps`; the refusals of a step.
pub fn step_to_rest(
    system: &mut GrainSystem,
    safety: f64,
    tolerance: f64,
    most_steps: u64,
) -> Result<u64, GrainError> {
    let mut last = Unrest::Unbalanced(f64::INFINITY);
    for made in 0..most_steps {
        system.evaluate()?;
        if made % EVERY == 0 {
            match system.unrest(tolerance)? {
                None => return Ok(made),
                Some(unrest) => last = unrest,
            }
            if let Unrest::Moving(_) = last {
                system.stop();
            }
        }
        let step = safety * system.current_limit();
        system.integrate(step)?;
    }
    Err(GrainError::NotSettled(most_steps, last))
}
