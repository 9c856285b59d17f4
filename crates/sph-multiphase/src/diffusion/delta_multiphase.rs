//! The δ-SPH smoother for several phases.

use sph_core::{Vect, fields, parameters, plugin};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, PairSum, Particles, Rates, WallSet, dot, pair_sum, pair_term,
    splat,
};

use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_rheology::state::Laws;

use crate::diffusion::{Accelerated, SmootherEntry, Smoothing};

/// dρ_a/dt += 2 δ h c_a ρ₀_a/γ_a [Σ_b V_b (β_a − β_b) F_ab − Σ_s (β_a − β_s)/d_s |∇γ_as|], β = ρ/ρ₀,
/// over neighbours of all phases and over walls.
///
/// Symbols: δ number; h smoothing length (m); c, ρ₀ speed of sound (m/s) and density (kg/m³) of the
/// phase at rest; F = w'/r; d distance from an element (m), not below δr/2. A neighbour of another
/// phase counts as one of the own phase that is compressed as much. A wall point or element has
/// the β at which the own phase has the wall's pressure, and a point the volume V_a of the particle that
/// looks at it; without `walls` a hydrostatic density has a source at a bottom.
///
/// Limits: as printed, a hydrostatic density has a source of about δ ρ₀ g/c at a free surface, and
/// across an interface, where β has a kink at rest, because ρ₀g/(ρ₀c²) jumps unless c is the same: two
/// layers at rest have 6 to 8 % too much pressure between them. `balance = "hydrostatic"` takes
/// ½[ρ_a(g − A_a) + ρ_b(g − A_b)]·r_ab/(ρ₀_a c_a²) from every difference, A the
/// [mean acceleration](crate::diffusion::MeanAcceleration), as the Brezzi–Pitkäranta smoother does,
/// and nothing is left to diffuse at rest. The volume that a pair of phases exchanges balances only
/// if c is the same.
///
/// Source: Krimi et al. 2018, Eq. 30–31; c of the own phase and the walls are ours.
///
/// ```toml
/// [smoother.delta-msph]
/// strength = 0.1
/// balance = "hydrostatic"
/// ```
#[plugin(SmootherEntry [2, 3], "delta-msph", "diffusion of the relative density, across interfaces and at walls",
    source: "Krimi et al. 2018, Eq. 30–31")]
#[derive(Copy)]
pub struct DeltaMultiphase {
    /// Strength δ.
    #[parameter(default: 0.1, unit: "1", min: 0.0, max: 1.0, source: "Krimi et al. 2018: 0.1")]
    pub strength: f64,
    /// True if walls count.
    #[parameter(default: true, source: "ours")]
    pub walls: bool,
    /// The gradient that is not diffused.
    #[parameter(default, source: "ours; literal: Krimi et al. 2018, Eq. 30")]
    pub balance: Balance,
    /// True if the hydrostatic balance has the mean acceleration A. If left out, so where all walls move, and where the
    /// fluid falls without any.
    #[parameter(default, source: "ours")]
    pub accelerations: Option<bool>,
}

/// The gradient that is not diffused.
#[parameters]
pub enum Balance {
    /// The compression of a fluid at rest or in an accelerated frame.
    #[default]
    Hydrostatic,
    /// Nothing: as printed.
    Literal,
}

impl DeltaMultiphase {
    fn accelerated(&self) -> Option<Accelerated> {
        let hydrostatic = self.balance == Balance::Hydrostatic;
        (hydrostatic && self.accelerations == Some(true)).then_some(Accelerated::Sweep)
    }
}

impl<const D: usize> Contribution<D> for DeltaMultiphase {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        self.accelerations.get_or_insert(setting.carried);
        let laws = setting.laws;
        let at_rest = laws.iter().map(|law| law.reference());
        let smoothing = Smoothing {
            term: Box::new(DeltaTerm {
                smoother: *self,
                density: at_rest.clone().map(|rest| rest.density).collect(),
                sound_speed: at_rest.map(|rest| rest.sound_speed).collect(),
                laws: laws.clone(),
            }),
            strength: self.strength,
            accelerated: self.accelerated(),
            of_pressures: false,
        };
        smoothing.offer(setting, offer);
        Ok(())
    }
}

/// The term of [`DeltaMultiphase`].
pub struct DeltaTerm {
    smoother: DeltaMultiphase,
    /// At rest, of every phase.
    density: Vec<f64>,
    sound_speed: Vec<f64>,
    laws: Laws,
}

impl DeltaTerm {
    /// β of every phase at given pressures: entry k n + i for phase k and place i of n.
    fn compressions(&self, pressure: &[f64]) -> Vec<f64> {
        let each = 0..self.laws.len();
        each.flat_map(|phase| pressure.iter().map(move |p| self.compression(phase, *p)))
            .collect()
    }

    /// β of a phase at a pressure.
    fn compression(&self, phase: usize, pressure: f64) -> f64 {
        let law = &self.laws[phase];
        law.density(pressure) / law.reference().density
    }
}

/// [`DeltaTerm`] with its columns.
#[pair_term(DeltaTerm, "δ-SPH smoother for several phases")]
pub struct BoundDelta<'a, const D: usize> {
    #[value(self)]
    term: &'a DeltaTerm,
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::PHASE, if self.density.len() > 1)]
    phase: Option<&'a [u32]>,
    #[both(fields::MEAN_ACCELERATION, if self.smoother.accelerated().is_some())]
    acceleration: Option<&'a [Vect<D>]>,
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
    /// β of every phase at the points' pressures; empty where walls do not count.
    #[value(match self.smoother.walls {
        true => self.compressions(&world.walls.points.pressure),
        false => Vec::new(),
    })]
    at_points: Vec<f64>,
    #[value(match self.smoother.balance {
        Balance::Hydrostatic => world.gravity,
        Balance::Literal => Vect::zeros(),
    })]
    gravity: Vect<D>,
    #[value(0.5 * world.spacing)]
    nearest: f64,
    #[value(2.0 * self.smoother.strength * world.kernel.smoothing_length())]
    weight: f64,
}

/// The own values of a particle.
#[derive(Clone, Copy)]
pub struct Own<const D: usize, L> {
    compression: L,
    /// ∇p at rest, Pa/m.
    at_rest: [L; D],
    /// 1/(ρ₀c²).
    compressibility: L,
}

#[pair_sum]
impl<const D: usize> BoundDelta<'_, D> {
    const SCALED: bool = true;

    fn own<L: Lane>(&self, all: Particles) -> Own<D, L> {
        let [compression, compressibility] = all.each(|i| {
            let phase = self.phase.map_or(0, |p| p[i] as usize);
            let (rest, c) = (self.term.density[phase], self.term.sound_speed[phase]);
            [self.density[i] / rest, 1.0 / (rest * c * c)]
        });
        Own {
            compression,
            at_rest: all.each(|i| self.at_rest(i, self.density[i]).into()),
            compressibility,
        }
    }

    fn pair<L: Lane>(&self, own: &Own<D, L>, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let phase = self.phase.map_or(0, |p| p[j] as usize);
        let compression = L::splat(self.density[j] / self.term.density[phase]);
        let mut mean = splat::<D, L>(&self.at_rest(j, self.density[j]));
        for (mean, own) in mean.iter_mut().zip(own.at_rest) {
            *mean = (own + *mean) * L::splat(0.5);
        }
        let at_rest = dot(&mean, &pair.separation) * own.compressibility;
        *sum += L::splat(self.volume[j]) * (own.compression - compression - at_rest) * pair.factor;
    }

    fn finish(&self, mut sum: f64, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let i = at.particle;
        let own = self.own::<f64>(Particles::one(i));
        let own_at_rest = Vect::from(own.at_rest);
        let phase = self.phase.map_or(0, |p| p[i] as usize);
        if !self.at_points.is_empty() {
            for (v, pair) in at.wall.pairs() {
                let share = &self.walls.points.share;
                let there = self.at_points[phase * share.len() + v];
                let weight = share[v] * self.volume[i];
                let at_rest = own_at_rest.dot(&pair.separation) * own.compressibility;
                sum += weight * (own.compression - there - at_rest) * pair.factor;
            }
        }
        if self.term.smoother.walls {
            for contact in at.contacts {
                let there = self.term.compression(phase, contact.pressure);
                let slope = (own.compression - there) / contact.distance.max(self.nearest);
                let normal = &self.walls.elements.normal[contact.element as usize];
                let at_rest = own_at_rest.dot(normal) * own.compressibility;
                sum -= (slope - at_rest) * contact.gradient.norm();
            }
        }
        let scale = self.term.density[phase] * self.term.sound_speed[phase];
        rates.scalar += self.weight * scale * sum * at.inverse_renormalisation;
    }

    /// ∇p of the undiffused pressure, Pa/m.
    fn at_rest(&self, i: usize, density: f64) -> Vect<D> {
        (self.gravity - self.acceleration.map_or(Vect::zeros(), |a| a[i])) * density
    }
}
