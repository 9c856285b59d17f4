//! Random clouds of spheres that do not touch.

use sph_core::SplitMix;

use crate::grains::setup::{Period, positive};
use crate::grains::space::separation;
use crate::grains::{Grain, GrainError, Vector};

/// A box in which spheres are put at random without overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Cloud {
    low: Vector,
    high: Vector,
    period: Period,
    tries: usize,
}

impl Cloud {
    /// Between two corners, m; spheres stay inside.
    pub fn new(low: [f64; 3], high: [f64; 3]) -> Self {
        Self {
            low: low.into(),
            high: high.into(),
            period: [None; 3],
            tries: 20_000,
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
        let mut cells = Cells::new(self, largest, radii.len());
        let mut places = vec![Vector::zeros(); radii.len()];
        for grain in order {
            let radius = radii[grain];
            let inner = |axis: usize| {
                let rim = if self.period[axis].is_some() {
                    0.0
                } else {
                    radius
                };
                (self.low[axis] + rim, self.high[axis] - rim)
            };
            let ranges = [inner(0), inner(1), inner(2)];
            let fits = ranges.iter().all(|(from, to)| from <= to);
            let place = (0..if fits { self.tries } else { 0 }).find_map(|_| {
                let at = Vector::from(ranges.map(|(from, to)| from + (to - from) * draw.unit()));
                let free = cells.around(&at).all(|other| {
                    let reach = radius + radii[other];
                    separation(&at, &places[other], &self.period).norm_squared() >= reach * reach
                });
                free.then_some(at)
            });
            let Some(at) = place else {
                return Err(GrainError::NoRoom(grain, radius, self.tries));
            };
            places[grain] = at;
            cells.put(&at, grain);
        }
        Ok(places)
    }
}

/// Radii drawn evenly from an interval, m; the same for the same seed.
pub fn uniform_radii(count: usize, smallest: f64, largest: f64, seed: u64) -> Vec<f64> {
    let mut draw = SplitMix(seed ^ 0x5eed);
    (0..count)
        .map(|_| smallest + (largest - smallest) * draw.unit())
        .collect()
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
    let solid: f64 = radii
        .iter()
        .map(|r| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3))
        .sum();
    let area = (high[0] - low[0]) * (high[1] - low[1]);
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let height = (solid / ((1.0 - porosity) * area)).max(2.0 * largest);
    let cloud = Cloud::new(low, [high[0], high[1], low[2] + height]);
    let places = cloud.place(radii, seed)?;
    let grains = places.iter().zip(radii);
    Ok(grains
        .map(|(at, &radius)| Grain::new((*at).into(), radius, density))
        .collect())
}

/// A grid that is filled as spheres are placed.
struct Cells {
    low: Vector,
    size: Vector,
    count: [usize; 3],
    periodic: [bool; 3],
    members: Vec<Vec<usize>>,
}

impl Cells {
    fn new(cloud: &Cloud, largest: f64, spheres: usize) -> Self {
        let length = cloud.high - cloud.low;
        let most = (spheres as f64).cbrt().ceil().max(1.0);
        let count: [usize; 3] = std::array::from_fn(|k| {
            (length[k] / (2.0 * largest)).floor().clamp(1.0, 4.0 * most) as usize
        });
        Self {
            low: cloud.low,
            size: Vector::from_fn(|k, _| length[k] / count[k] as f64),
            count,
            periodic: cloud.period.map(|p| p.is_some()),
            members: vec![Vec::new(); count.iter().product()],
        }
    }

    fn cell(&self, at: &Vector) -> [usize; 3] {
        std::array::from_fn(|k| {
            (((at[k] - self.low[k]) / self.size[k]) as usize).min(self.count[k] - 1)
        })
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    fn put(&mut self, at: &Vector, sphere: usize) {
        let number = self.number(self.cell(at));
        self.members[number].push(sphere);
    }

    fn around(&self, at: &Vector) -> impl Iterator<Item = usize> {
        let cell = self.cell(at);
        let near = move |axis: usize| {
            let (n, at) = (self.count[axis], cell[axis]);
            (0..n).filter(move |&other| {
                let apart = at.abs_diff(other);
                apart <= 1 || (self.periodic[axis] && apart == n - 1)
            })
        };
        near(2).flat_map(move |z| {
            near(1).flat_map(move |y| {
                near(0).flat_map(move |x| self.members[self.number([x, y, z])].iter().copied())
            })
        })
    }
}
