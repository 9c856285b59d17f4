//! Dissipation of what two particles do not share with the flow around them.
//!
//! * [`Riemann`] is the plugin, `[dissipation.riemann]`.
//! * [`DissipationEntry`] is the kind, for plugins of other crates.

use nalgebra::SMatrix;
use sph_contribution::{Contribution, Offer, Refusal, Setting, contribution_kind};
use sph_core::{Vect, Work, fields, plugin};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, add_scaled, beyond_linear, dot, minus,
    pair_sum, pair_term,
};

contribution_kind!(
    /// A dissipation that a scene may name.
    pub DissipationEntry, "dissipation", One, "damping of noise between particles that approach each other",
    .works(Work::Damping)
);

/// m_a a = −Σ_b (V_a² + V_b²) p_ab ∇w_ab, p_ab = Z_aZ_b/(Z_a + Z_b) u min(η u/c̄, 1), u = −Δu·r_ab/r where it is positive.
///
/// The pressure that a Riemann problem between two particles adds to their mean: that of two states which meet with the
/// speed u (m/s), Z = ρ c (kg/(m² s)). Δu = u_ab − ½(G_a + G_b) r_ab (m/s) is the velocity that a linear field does not
/// explain, G the velocity gradient (1/s): shear, strain and compression of the flow are left alone, disorder and the
/// fronts of impacts are not. The limiter η u/c̄ leaves slow motion alone: the dissipation is of third order in u. Conserves
/// momentum and angular momentum between particles; walls take no part. A walk over the neighbours more, for G.
///
/// Source: Zhang, Hu & Adams 2017, J. Comput. Phys. 335, 605–620, Eq. 16–18, η = 3; the volumes of Hu & Adams 2006 for
/// densities, and Δu for u_ab, ours.
///
/// ```toml
/// [dissipation.riemann]
/// limiter = 3.0
/// ```
#[plugin(DissipationEntry [2, 3], "riemann", "pressure of Riemann problems between particles, limited",
    source: "after Zhang, Hu & Adams 2017, Eq. 16–18", cfg(not(test)))]
pub struct Riemann {
    /// η of the limiter; the larger, the nearer to the whole Riemann problem.
    #[parameter(default: 3.0, unit: "1", min: 0.0, source: "Zhang, Hu & Adams 2017")]
    pub limiter: f64,
    /// False for Δu = u_ab, as in the source: takes energy of strain and compression, too, and saves the walk.
    #[parameter(default: true)]
    pub linear: bool,
}

impl<const D: usize> Contribution<D> for Riemann {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let sound = setting.laws.iter().map(|law| law.reference().sound_speed);
        offer.term(Dissipation {
            riemann: *self,
            sound: sound.collect(),
        });
        offer.remedy = Some(format!("lower the limiter in {}", offer.path));
        Ok(())
    }
}

/// The term of [`Riemann`] with the speeds of sound of the phases, m/s.
struct Dissipation {
    riemann: Riemann,
    sound: Vec<f64>,
}

#[pair_term(Dissipation, "Riemann dissipation")]
struct BoundDissipation<'a, const D: usize> {
    #[value(self.riemann.limiter)]
    limiter: f64,
    #[value(&self.sound)]
    sound: &'a [f64],
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[both(fields::VELOCITY_GRADIENT, if self.riemann.linear)]
    gradient: Option<&'a [SMatrix<f64, D, D>]>,
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::PHASE, if self.sound.len() > 1)]
    phase: Option<&'a [u32]>,
    #[here(fields::MASS)]
    mass: &'a [f64],
}

impl<const D: usize> BoundDissipation<'_, D> {
    /// c of a particle, m/s.
    fn sound(&self, i: usize) -> f64 {
        self.sound[self.phase.map_or(0, |phase| phase[i] as usize)]
    }
}

#[derive(Clone, Copy)]
struct Own<const D: usize, L> {
    velocity: [L; D],
    /// Rows of the velocity gradient.
    gradient: [[L; D]; D],
    sound: L,
    impedance: L,
    volume2: L,
}

#[pair_sum]
impl<const D: usize> BoundDissipation<'_, D> {
    fn own<L: Lane>(&self, all: Particles) -> Own<D, L> {
        let volume = all.numbers::<L>(self.volume);
        let [sound] = all.each(|i| [self.sound(i)]);
        Own {
            velocity: all.vectors(self.velocity),
            gradient: match self.gradient {
                Some(gradient) => all.matrices(gradient),
                None => [[L::splat(0.0); D]; D],
            },
            sound,
            impedance: all.numbers::<L>(self.density) * sound,
            volume2: volume * volume,
        }
    }
    fn pair<L: Lane>(&self, own: &Own<D, L>, j: usize, pair: &LanePair<D, L>, sum: &mut [L; D]) {
        let sound = self.sound(j);
        let impedance = L::splat(self.density[j] * sound);
        let parting = match self.gradient {
            Some(gradient) => {
                let other = (&self.velocity[j], &gradient[j]);
                beyond_linear((&own.velocity, &own.gradient), other, &pair.separation)
            }
            None => minus(&own.velocity, &self.velocity[j]),
        };
        let closing = -dot(&parting, &pair.separation);
        let speed = closing.max(L::splat(0.0)) / pair.distance2.sqrt();
        let share = speed * L::splat(2.0 * self.limiter) / (own.sound + L::splat(sound));
        let share = -(-share).max(L::splat(-1.0));
        let pressure = own.impedance * impedance / (own.impedance + impedance) * speed * share;
        let volumes = own.volume2 + L::splat(self.volume[j] * self.volume[j]);
        add_scaled(sum, &pair.separation, pressure * volumes * pair.factor);
    }
    fn finish(&self, sum: [f64; D], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.acceleration -= Vect::from(sum) / self.mass[at.particle];
    }
}
