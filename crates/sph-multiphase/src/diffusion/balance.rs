//! The acceleration that a pressure is in balance with, and gradients that are exact for linear fields.

use rayon::prelude::*;
use sph_contribution::{StepHook, StepMoment, StepPhase};
use sph_core::{Access, Field, StepError, Vect, Vector, fields};
use sph_neighbours::{Row, World};

/// s, ∇p/ρ.
pub const PRESSURE_SLOPE: Field<Vector> = Field::new(
    "pressure_slope",
    "m/s²",
    "gradient of the pressure over the density of pairs, exact for linear pressures",
);

/// Over how many h/c accelerations are averaged.
///
/// Sound of a shorter period is diffused as if at rest, what is slower is left alone. Ours. With 20, 40, 80 and 160 a tank under
/// 1 m/s² has 0.5, 0.6, 0.9 and 1.7 % too little pressure between its ends, a turning box 3.1 and 1.4 % too much, 4.1 and 6.5 %
/// too little; of a wave of sound with k h = π/80, four times as long as a layer of 40 rows is deep, 38, 71, 91 and 98 % are
/// diffused.
const MEMORY: f64 = 40.0;

/// Largest acceleration that counts, cτ⁻¹ times this: a flow that is not faster than a fifth of its sound has no larger
/// one for long, and changes by an impact within a few steps are sound. With c = 10 √(aH) it binds below H = 2h.
const SLOW: f64 = 0.2;

/// The acceleration of particles by all terms but friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accelerated {
    /// The acceleration of the sweep, a.
    Sweep,
    /// The slope s of the pressure: g − s.
    Slope,
}

/// A ← A + (1 − e^(−cΔt/40h)) (a − **f** − A): the mean acceleration of a particle, without the driving force **f**; |a − **f**|
/// counts up to c²/200h.
///
/// Under it the pressure has the gradient ρ (**g** − A), whatever accelerates the fluid: walls that move, a fall, a turn. A
/// smoother that takes this gradient off leaves all of them alone. The mean lags behind sound: with the frequency ω the share
/// (ω²τ² + iωτ)/(1 + ω²τ²) is diffused, τ = 40h/c, whose real part is positive.
pub struct MeanAcceleration {
    of: Accelerated,
    /// c of the fastest phase, m/s.
    sound: f64,
}

impl MeanAcceleration {
    /// Of these accelerations; `sound` is the speed of sound of the fastest phase, m/s.
    pub fn new(of: Accelerated, sound: f64) -> Self {
        MeanAcceleration { of, sound }
    }

    fn source(&self) -> Field<Vector> {
        match self.of {
            Accelerated::Sweep => fields::ACCELERATION,
            Accelerated::Slope => PRESSURE_SLOPE,
        }
    }

    /// A of all particles follows over `dt` seconds.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn follow<const D: usize>(&self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let memory = MEMORY * world.kernel.smoothing_length() / self.sound;
        let part = -(-dt / memory).exp_m1();
        let most = SLOW * self.sound / memory;
        let mut mean = world.free.take(fields::MEAN_ACCELERATION)?;
        let source = world.free.get(self.source())?;
        let (gravity, driving) = (world.gravity, world.driving);
        let toward = |mean: &mut Vect<D>, now: Vect<D>| {
            *mean += (now.cap_magnitude(most) - *mean) * part;
        };
        let all = mean.par_iter_mut().zip(source).with_min_len(2048);
        match self.of {
            Accelerated::Sweep => all.for_each(|(mean, a)| toward(mean, a - driving)),
            Accelerated::Slope => all.for_each(|(mean, s)| toward(mean, gravity - s)),
        }
        Ok(world.free.put(fields::MEAN_ACCELERATION, mean)?)
    }
}

impl<const D: usize> StepHook<D> for MeanAcceleration {
    fn name(&self) -> String {
        "mean acceleration".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here(self.source())
            .remembers(fields::MEAN_ACCELERATION)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::BeforeDrift]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        self.follow(moment.world, moment.dt)
    }
}

/// Least eigenvalue, as a share of 1, of the matrix that a gradient is renormalised with.
const LEAST: f64 = 0.05;

/// [Σ_b V_b (r_b − r_a) ⊗ ∇w_ab]⁻¹ Σ_b V_b (A_b − A_a) ∇w_ab over a row of neighbours; nothing where they span no
/// volume. Unit: that of A over metres.
///
/// `rise` gives A_b − A_a, or nothing for a neighbour that does not count.
pub fn linear_exact<const D: usize>(
    row: &Row<'_, D>,
    volume: &[f64],
    rise: impl Fn(usize) -> Option<f64>,
) -> Vect<D> {
    // Columns of the matrix, and its right side.
    let mut matrix = [Vect::<D>::zeros(); D];
    let mut sum = Vect::<D>::zeros();
    for (j, pair) in row.pairs() {
        if let Some(rise) = rise(j) {
            let slope = pair.separation * (volume[j] * pair.factor);
            sum += slope * rise;
            for (column, along) in matrix.iter_mut().zip(&pair.separation) {
                *column -= slope * *along;
            }
        }
    }
    solve(matrix, sum).unwrap_or_else(Vect::zeros)
}

/// The solution of a symmetric positive system by Cholesky's elimination, if every pivot is large enough.
fn solve<const D: usize>(mut matrix: [Vect<D>; D], mut right: Vect<D>) -> Option<Vect<D>> {
    for k in 0..D {
        if matrix[k][k] < LEAST {
            return None;
        }
        for row in k + 1..D {
            let factor = matrix[k][row] / matrix[k][k];
            for column in matrix.iter_mut().skip(k) {
                column[row] -= factor * column[k];
            }
            right[row] -= factor * right[k];
        }
    }
    for k in (0..D).rev() {
        for c in k + 1..D {
            right[k] -= matrix[c][k] * right[c];
        }
        right[k] /= matrix[k][k];
    }
    Some(right)
}
