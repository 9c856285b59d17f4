//! Forces that push phases apart: a weight per pair of particles of different phases.

use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_core::{Vect, fields, plugin};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, add_scaled, pair_sum, pair_term, unlike,
};

use crate::gradient::{PairPressure, PairState};
use crate::{InterfaceEntry, offer_interface};

/// ρ_a a = −ε Σ_{b of other phases} V_b (|p_a| + |p_b|) ∇w_ab.
///
/// Symbols: ε number; p pressure (Pa); V volume (m^d). Conserves momentum to rounding. The source
/// divides p by the filling of the formulation it belongs to ([`Grenier`](crate::Grenier)), which is
/// 1 up to noise at an interface and left out here, so that it serves every formulation.
///
/// Source: Grenier et al. 2009; ε from 0.01 to 0.1.
///
/// ```toml
/// [interface.grenier]
/// strength = 0.08
/// ```
#[plugin(InterfaceEntry [2, 3], "grenier", "repulsion between phases that keeps interfaces sharp",
    source: "Grenier et al. 2009", cfg(not(test)))]
pub struct GrenierInterface {
    /// Strength ε.
    #[parameter(default: 0.08, unit: "1", min: 0.0, max: 1.0, source: "Grenier et al. 2009: 0.01 to 0.1")]
    pub strength: f64,
}

impl PairPressure for GrenierInterface {
    const NAME: &'static str = "Grenier interface force";
    #[inline(always)]
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L {
        here.volume * there.volume * (here.pressure.abs() + there.pressure.abs())
    }
}

impl<const D: usize> Contribution<D> for GrenierInterface {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer_interface(Box::new(Repelling(*self, self.strength)), setting, offer)
    }
}

/// m_a a = −ε Σ_{b of other phases} (|p_a| V_a² + |p_b| V_b²) ∇w_ab: a share ε of the pressure
/// gradient between phases, always repulsive.
///
/// Symbols: ε number; p pressure (Pa); V volume (m^d). Conserves momentum to rounding. It does
/// nothing where there is no pressure, and depends on the level of the pressure. Thickens the gap between the
/// phases by about ε: it is a numerical force, not surface tension.
///
/// Source: Ghaïtanellis 2017, Eq. 3.32, corrected: Eq. 3.33 and 4.124 print the sign of an attraction.
///
/// ```toml
/// [interface.micro-mixing]
/// strength = 0.01
/// ```
#[plugin(InterfaceEntry [2, 3], "micro-mixing", "repulsion between phases against micro-mixing",
    source: "Ghaïtanellis 2017, Eq. 3.32", cfg(not(test)))]
pub struct MicroMixing {
    /// Strength ε.
    #[parameter(default: 0.01, unit: "1", min: 0.0, max: 1.0, source: "Ghaïtanellis 2017, Eq. 3.32: 0.005 to 0.015")]
    pub strength: f64,
}

impl PairPressure for MicroMixing {
    const NAME: &'static str = "micro-mixing force";
    #[inline(always)]
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L {
        let other = there.pressure.abs() * there.volume * there.volume;
        here.pressure.abs() * here.volume * here.volume + other
    }
}

impl<const D: usize> Contribution<D> for MicroMixing {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer_interface(Box::new(Repelling(*self, self.strength)), setting, offer)
    }
}

/// m_a a = −ε Σ_{b of other phases} P_ab ∇w_ab with P_ab ≥ 0 and ε.
struct Repelling<P>(P, f64);

#[pair_term(Repelling<P>, P::NAME)]
struct BoundRepulsion<'a, P: PairPressure> {
    #[value(self.0)]
    weight: P,
    #[value(self.1)]
    strength: f64,
    #[both(fields::PRESSURE)]
    pressure: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[both(fields::PHASE)]
    phase: &'a [u32],
}

#[pair_sum]
impl<const D: usize, P: PairPressure> BoundRepulsion<'_, P> {
    /// State and phase.
    fn own<L: Lane>(&self, all: Particles) -> (PairState<L>, L) {
        let (pressure, volume) = (all.numbers(self.pressure), all.numbers(self.volume));
        let state = PairState::new(pressure, volume, L::splat(0.0));
        (state, all.phases(Some(self.phase)))
    }

    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let (here, phase) = *own;
        let unlike = unlike(phase, self.phase[j]);
        let zero = L::splat(0.0);
        // Most pairs are of one phase.
        if !zero.any_less(unlike) {
            return;
        }
        let (pressure, volume) = (L::splat(self.pressure[j]), L::splat(self.volume[j]));
        let there = PairState::new(pressure, volume, zero);
        let weight = self.weight.pair(here, there) * pair.factor;
        add_scaled(sum, &pair.separation, unlike.where_positive(weight, zero));
    }

    /// Without 1/γ: the gain of one particle is the loss of another.
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let inverse_mass = 1.0 / self.mass[at.particle];
        rates.acceleration -= Vect::from(sum) * (self.strength * inverse_mass);
    }
}
