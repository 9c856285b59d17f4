//! A bulk viscosity against the sound of impacts.

use std::sync::OnceLock;

use sph_contribution::{Contribution, Limiter, Offer, Refusal, Setting, bound};
use sph_core::{Field, Scalar, Stage, StepError, Symmetric, Vect, fields, plugin, stage};
use sph_neighbours::{Lane, Sums, Values, World, all_sums, declared, walk_some};
use sph_rheology::state::Reference;

use crate::damping::DampingEntry;
use crate::divergence::{Divergence, OwnVolume};
use crate::gradient::{PairPressure, PairState, PressureGradient, SquaredVolumes};
use crate::interface_limit::shortest_wave;
use crate::surface::MOMENT_EXCESS;

/// m_a a = −1/γ_a [Σ_b θ_b (q_aV_a² + q_bV_b²) ∇w_ab − Σ_s q_a (V_a² + V_s²)/V_s ∇γ_as],
/// q_a = −α ρ₀ c h D_a{u}, not below −max(p_a, 0), ρ₀ that of the lightest phase within the support.
///
/// A pressure against the rate of compression, that is a bulk viscosity ζ = α ρ₀ c h. Symbols: h smoothing length (m),
/// c speed of sound of the phase at rest (m/s), D{u} divergence of the velocity (1/s), α number. Divergence and force
/// are adjoint, so that between particles it takes Σ V q²/ζ from the motion and never gives. A wave of sound of the
/// wave number k loses the share ½ α h c k² of its amplitude in a second; a flow free of divergence is left alone.
/// q is no tension where there is no pressure: a splash tears. Conserves momentum between particles, and angular
/// momentum. The sound of a heavy phase moves the light particles next to it: what resists there may not be more than
/// these can take within a step, so that rows within a support of a lighter phase are damped as that phase is.
///
/// Limits: a divergence that is made by free surfaces and by disorder is damped as that of sound is. One more walk over the
/// neighbours in a step.
///
/// Source: after the acoustic damper of Sun et al. 2023; with the adjoint pair of Hu & Adams 2006, and the bound, ours.
///
/// ```toml
/// [damping.acoustic]
/// strength = 0.5
/// ```
#[plugin(DampingEntry [2, 3], "acoustic", "a bulk viscosity against the sound of impacts",
    source: "after Sun et al. 2023", cfg(not(test)))]
pub struct AcousticDamper {
    /// Strength α: the bulk viscosity over ρ₀ c h.
    #[parameter(default: 0.5, unit: "1", min: 0.0, max: 2.0,
        source: "ours: a wave of 20 h loses 1 % in a period at 0.03, a fifth at 0.5")]
    pub strength: f64,
}

impl<const D: usize> Contribution<D> for AcousticDamper {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let laws = setting.laws.iter().map(|law| law.reference());
        let impedance = |r: Reference| self.strength * r.density * r.sound_speed;
        let densities = laws.clone().map(|r| r.density).collect();
        offer.stage(resistance(laws.clone().map(impedance).collect(), densities));
        offer.term(PressureGradient(DampingForce));
        if self.strength > 0.0 {
            let fastest = laws.map(|r| r.sound_speed).fold(0.0, f64::max);
            offer.limiter(damper_limit(self.strength, fastest));
        }
        offer.remedy = Some(format!("lower the strength in {}", offer.path));
        Ok(())
    }
}

sph_core::fields! {
    /// The damper's part of the pressure.
    pub DAMPING_PRESSURE: Scalar = "damping_pressure", "Pa", "pressure of the bulk viscosity against sound";
}

/// q of [`AcousticDamper`], with α ρ₀ c, kg/(m² s), and ρ₀, kg/m³, of every phase.
fn resistance<const D: usize>(impedance: Vec<f64>, densities: Vec<f64>) -> impl Stage<World<D>> {
    let term = [Divergence::boxed::<D>(OwnVolume)];
    let access = term[0].access().both(fields::POSITION);
    let access = access.here((fields::MASS, fields::PRESSURE));
    let mut access = access.where_there(MOMENT_EXCESS).writes(DAMPING_PRESSURE);
    if densities.len() > 1 {
        access = access.both(fields::PHASE);
    }
    // No step allocates memory for the declared columns; the sweep sums accelerations, too, which are not read.
    let (declared, mut unused) = (declared(&term), Vec::new());
    let name = "acoustic damper's pressure";
    stage(name, access, move |world: &mut World<D>| {
        let mut pressure = world.free.take(DAMPING_PRESSURE)?;
        pressure.fill(0.0);
        unused.resize(world.free.len(), Vect::zeros());
        let sums = Sums {
            acceleration: &mut unused,
            scalar: Some(&mut pressure),
            more: &mut [],
        };
        all_sums(world, &declared, &term, sums)?;
        let lightest = lightest(world, &densities)?;
        let h = world.kernel.smoothing_length();
        let phase = world.free.get(fields::PHASE).ok();
        let fluid = world.free.get(fields::PRESSURE)?;
        let excess = world.free.get(MOMENT_EXCESS).ok();
        for (i, (q, p)) in pressure.iter_mut().zip(fluid).enumerate() {
            // There densities do not follow this divergence, and a flow free of any would be damped.
            if excess.is_some_and(|n| n[i] != Symmetric::ZERO) {
                *q = 0.0;
                continue;
            }
            let lighter = lightest.get(i).copied().flatten().unwrap_or(1.0);
            let impedance = impedance[phase.map_or(0, |p| p[i] as usize)] * lighter;
            *q = (-impedance * h * *q).max(-p.max(0.0));
        }
        Ok(world.free.put(DAMPING_PRESSURE, pressure)?)
    })
}

/// Least density of a phase within the support over that of a particle's own, where it sees another phase.
fn lightest<const D: usize>(
    world: &World<D>,
    densities: &[f64],
) -> Result<Vec<Option<f64>>, StepError> {
    let Ok(phase) = world.free.get(fields::PHASE) else {
        return Ok(Vec::new());
    };
    let density = |i: usize| densities[phase[i] as usize];
    let lists = world.lists.nearest();
    let near = |i: usize| {
        let mut others = lists.candidates(i).iter();
        others.any(|j| density(*j as usize) < density(i))
    };
    walk_some(world, Values::Gradient, near, |around| {
        let (own, row) = (density(around.rows.particle), &around.rows.free);
        let all = row.index.iter().zip(row.factor);
        let seen = all.filter(|(_, factor)| **factor != 0.0);
        let least = seen.map(|(j, _)| density(*j as usize));
        least.fold(own, f64::min) / own
    })
}

/// Δt ≤ 1/(α h c S²), S = max_k ΣV|∂w/∂x sin kx| on a lattice, 1.2/h: half of where the fastest mode would be turned round.
fn damper_limit<const D: usize>(strength: f64, fastest: f64) -> impl Limiter<D> {
    let formula = format!("acoustic damper: dt <= 1 / ({strength} h c S²)");
    let remedy = "a smaller `strength` of the damper lengthens the step";
    // Lattice and kernel stay.
    let wave = OnceLock::new();
    let dt = move |world: &World<D>| {
        let wave = wave.get_or_init(|| shortest_wave(world));
        Ok(1.0 / (strength * world.kernel.smoothing_length() * fastest * wave * wave))
    };
    bound("acoustic damper", formula, Some(remedy), dt)
}

/// P_ab = q_a V_a² + q_b V_b²; a wall resists as the particle does.
#[derive(Clone, Copy)]
struct DampingForce;

impl PairPressure for DampingForce {
    const NAME: &'static str = "acoustic damper";
    const PRESSURE: Field<Scalar> = DAMPING_PRESSURE;
    #[inline(always)]
    fn pair<L: Lane>(self, here: PairState<L>, there: PairState<L>) -> L {
        SquaredVolumes.pair(here, there)
    }
    #[inline(always)]
    fn at_wall(self, here: PairState, there: PairState) -> f64 {
        here.pressure * (here.volume * here.volume + there.volume * there.volume)
    }
}
