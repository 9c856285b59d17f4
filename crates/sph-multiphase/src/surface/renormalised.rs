//! Densities and pressures at free surfaces that are exact for linear velocities.

use rayon::prelude::*;
use sph_contribution::{Contribution, Offer, Refusal, Setting, StepHook, StepMoment, StepPhase};
use sph_core::{Access, StepError, Symmetric, Vect, fields, plugin};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Particles, Rates, WallSet, World, add_scaled, dot, minus,
    pair_sum, pair_term, splat, walk_in_lanes,
};

use super::cone::free_surface;
use super::moments::{EXPLAINED_DEFICIT, MOMENT_EXCESS, moments};
use super::relaxed::{SurfaceEntry, are_sums, set_parts};

/// The density constant K of [`HuAdams`](crate::HuAdams) follows the strain at a free surface,
/// dK_a/dt = m_aγ_a Σ_b θ_b u_ab·N_a ∇w_ab − (K_a − K′_a)/τ, and a pressure force is adjoint to the strain,
/// m_a du_a/dt += −Σ_b θ_b (p_aV_a²N_a + p_bV_b²N_b) ∇w_ab.
///
/// Symbols: N = ψ (A⁻¹ − I)/γ; A = −Σ_b θ_b δr^d r_ab⊗∇w_ab/γ_a first moment of the support, across a wall its filling
/// C = Σθδr^d w/γ; ψ = (1 − C)/0.03 between 0 and 1, 0 for ‖A⁻¹ − I‖ > 3 (sheets, tips); τ = n h/c; K′ = m (1 − S)/δr^d, S(d)
/// the kernel's share of a half-space at the depth d below its surface, d from |∇C|, and more where over 0.05 lacks besides.
/// Beside walls that do not scale the kernel K does not relax.
///
/// A cut sum Σw changes when rows at a surface move apart, though volumes do not. Without the term rows follow the sum, and
/// a wave of 20 rows loses 1.5 % of its amplitude in a period, whatever its height, smoother and damper. The relaxation takes
/// the drift of K, by which a disordered surface would sink. [`AcousticDamper`](crate::AcousticDamper) leaves out what has N.
///
/// For waves, with `[walls.symmetric]`: `usaw` gives energy to them. At rest the pressure of the first rows is less exact
/// than without (L2 of a tank of 25 rows 0.042 for 0.018). For densities that are sums, without open faces, where half of a
/// row is in no sum. A step takes 1.5 times as long. Energy is conserved to the error of the step, and momentum between
/// particles.
///
/// Source: N after Bonet & Lok 1999, J. Comput. Phys. 180, 67–88; its use at surfaces, and K′, ours.
///
/// ```toml
/// [surface.renormalised]
/// time = 100.0
/// ```
#[plugin(SurfaceEntry [2, 3], "renormalised", "densities follow the strain at a free surface, for waves",
    source: "after Bonet & Lok 1999", cfg(not(test)))]
#[derive(Copy)]
pub struct Renormalised {
    /// n: the time τ over h/c.
    #[parameter(default: 100.0, unit: "1", min: 1.0, max: 1e6,
        source: "ours: a standing wave is alike from 30 to 300")]
    pub time: f64,
}

impl<const D: usize> Contribution<D> for Renormalised {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let refused = |why: &str| Err(Refusal::at_key("surface", "", why));
        if !are_sums(setting) {
            return refused("densities are no sums here: take `[formulation.hu-adams]`");
        }
        if setting.world.walls.elements.open.contains(&true) {
            return refused(
                "half of a row that passes an open face is in no sum: take `[surface.cone-test]`",
            );
        }
        offer.stage(moments());
        // For readers that ask for free surfaces.
        offer.stage(free_surface(true));
        offer.term(SurfacePressure);
        let laws = setting.laws.iter();
        offer.hook(SurfaceStrain {
            time: self.time,
            speeds: laws.map(|law| law.reference().sound_speed).collect(),
            rates: Vec::new(),
            parts: Vec::new(),
        });
        Ok(())
    }
}

/// N·r for tensors in lanes.
#[inline(always)]
fn apply<L: Lane, const D: usize>(tensor: &[L; 6], r: &[L; D]) -> [L; D] {
    let mut out = [L::splat(0.0); D];
    for (out, places) in out.iter_mut().zip(Symmetric::PLACE) {
        for (component, place) in r.iter().zip(places) {
            *out += tensor[place] * *component;
        }
    }
    out
}

struct SurfacePressure;

#[pair_term(SurfacePressure, "pressure at free surfaces")]
struct BoundSurfacePressure<'a, const D: usize> {
    #[both(MOMENT_EXCESS)]
    excess: &'a [Symmetric],
    #[both(fields::PRESSURE)]
    pressure: &'a [f64],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
}

#[pair_sum]
impl<const D: usize> BoundSurfacePressure<'_, D> {
    const SCALED: bool = true;

    /// p V² N.
    fn own<L: Lane>(&self, all: Particles) -> [L; 6] {
        all.each(|i| self.weighted(i))
    }
    /// Σ (p V² N)∇w over both, and Σ of the tensors times w.
    fn pair<L: Lane>(
        &self,
        own: &[L; 6],
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut ([L; D], [L; 6]),
    ) {
        let both = plus(own, &self.weighted(j));
        let force = apply(&both, &pair.separation);
        add_scaled(&mut sum.0, &force, pair.factor);
    }
    fn pair_at_walls<L: Lane>(
        &self,
        own: &[L; 6],
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut Self::Sum<L>,
    ) {
        let both = plus(own, &self.weighted(j));
        add_scaled(&mut sum.1, &both, pair.value);
    }

    fn finish(&self, sum: ([f64; D], [f64; 6]), at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let own = Symmetric(self.weighted(at.particle));
        let (mut sum, of_values) = (Vect::from(sum.0), sum.1);
        if let Some(scale) = at.scale() {
            let all = Symmetric(of_values) + own * (2.0 * scale.own_value);
            sum += all.apply(&scale.slope);
        }
        for (v, pair) in at.wall.pairs() {
            sum += own.apply(&pair.separation) * (self.walls.points.share[v] * pair.factor);
        }
        for contact in at.contacts {
            sum -= own.apply(&contact.gradient) / contact.volume;
        }
        rates.acceleration -= sum / self.mass[at.particle];
    }

    /// p V² N.
    fn weighted(&self, i: usize) -> [f64; 6] {
        (self.excess[i] * (self.pressure[i] * self.volume[i] * self.volume[i])).0
    }
}

/// The sum of a tensor in lanes and of one for all.
#[inline(always)]
fn plus<L: Lane>(own: &[L; 6], other: &[f64; 6]) -> [L; 6] {
    std::array::from_fn(|k| own[k] + L::splat(other[k]))
}

/// Σ θ u_ab·N_a ∇w_ab of free neighbours.
struct StrainSum<'a, const D: usize> {
    excess: &'a [Symmetric],
    velocity: &'a [Vect<D>],
    slope: Option<&'a [Vect<D>]>,
}

#[pair_sum]
impl<const D: usize> StrainSum<'_, D> {
    const SCALED: bool = true;

    /// N, velocity, N ∇ln s.
    fn own<L: Lane>(&self, all: Particles) -> ([L; 6], [L; D], [L; D]) {
        let excess = all.each(|i| self.excess[i].0);
        let slope = match self.slope {
            Some(slope) => apply(&excess, &all.vectors(slope)),
            None => [L::splat(0.0); D],
        };
        (excess, all.vectors(self.velocity), slope)
    }
    fn pair<L: Lane>(&self, own: &Self::Own<L>, j: usize, pair: &LanePair<D, L>, sum: &mut L) {
        let apart = minus(&own.1, &self.velocity[j]);
        *sum += dot(&apart, &apply(&own.0, &pair.separation)) * pair.factor;
    }
    fn pair_at_walls<L: Lane>(
        &self,
        own: &Self::Own<L>,
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut L,
    ) {
        if let Some(slope) = self.slope {
            let other = dot(&splat(&self.velocity[j]), &apply(&own.0, &splat(&slope[j])));
            *sum += (dot(&own.1, &own.2) + other) * pair.value;
        }
    }
}

/// The change of K by strain, and its relaxation.
struct SurfaceStrain {
    time: f64,
    /// c of every phase, m/s.
    speeds: Vec<f64>,
    /// Kept for its memory.
    rates: Vec<f64>,
    /// Share of the difference that goes in a step, phase by phase.
    parts: Vec<f64>,
}

impl SurfaceStrain {
    /// dK/dt of every particle by the present velocities, over its mass.
    fn strain<const D: usize>(&mut self, world: &World<D>) -> Result<(), StepError> {
        let sum = StrainSum {
            excess: world.free.get(MOMENT_EXCESS)?,
            velocity: world.free.get(fields::VELOCITY)?,
            slope: world.free.get(fields::SCALE_SLOPE).ok(),
        };
        let (excess, velocity, walls) = (sum.excess, sum.velocity, &world.walls);
        let volume = world.free.get(fields::VOLUME)?;
        self.rates.clear();
        self.rates.resize(world.free.len(), 0.0);
        let cut = |i: usize| excess[i] != Symmetric::ZERO;
        walk_in_lanes(world, &sum, cut, &mut self.rates, |mut strain, rows| {
            let i = rows.particle;
            if let Some(scale) = rows.scale() {
                strain += 2.0 * scale.own_value * velocity[i].dot(&excess[i].apply(&scale.slope));
                return strain;
            }
            for (v, pair) in rows.wall.pairs() {
                let apart = velocity[i] - walls.points.velocity[v];
                let along = apart.dot(&excess[i].apply(&pair.separation));
                strain += walls.points.share[v] * along * pair.factor;
            }
            for contact in rows.contacts {
                let apart = velocity[i] - walls.elements.velocity_at(&contact);
                strain -= apart.dot(&excess[i].apply(&contact.gradient)) / volume[i];
            }
            strain
        })
    }
}

impl<const D: usize> StepHook<D> for SurfaceStrain {
    fn name(&self) -> String {
        "strain of free surfaces".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both((fields::POSITION, fields::VELOCITY, MOMENT_EXCESS))
            .where_there(fields::SCALE_SLOPE)
            .here((EXPLAINED_DEFICIT, fields::MASS, fields::VOLUME))
            .here(fields::DENSITY_CONSTANT)
            .where_there((fields::PHASE, fields::RENORMALISATION))
            .writes(fields::DENSITY_CONSTANT)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
        self.strain(world)?;
        let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
        let (explained, mass) = world.free.all((EXPLAINED_DEFICIT, fields::MASS))?;
        let phase = world.free.get(fields::PHASE).ok();
        let gamma = world.sum_renormalisation();
        let length = self.time * world.kernel.smoothing_length();
        set_parts(&mut self.parts, self.speeds.iter().copied(), length, dt);
        let parts = &self.parts;
        let per_cell = world.spacing.powi(D as i32).recip();
        let walls = &world.walls;
        // Beside walls that do not scale the kernel a plane surface leaves another slope.
        let points = walls.points.in_sums();
        let walled = |i: usize| {
            let seen = || walls.contacts.of_particle(i).iter().next().is_some();
            !world.walls.scales && (seen() || points && !world.lists.wall.candidates(i).is_empty())
        };
        let all = constant.par_iter_mut().zip(&self.rates).enumerate();
        all.with_min_len(1024).for_each(|(i, (k, rate))| {
            let gamma = gamma.map_or(1.0, |g| g[i]);
            // N is over γ, and K the density times γ.
            *k += gamma * mass[i] * rate * dt;
            if !walled(i) {
                let rest = mass[i] * per_cell * explained[i];
                *k += parts[phase.map_or(0, |p| p[i] as usize)] * (rest - *k);
            }
        });
        Ok(world.free.put(fields::DENSITY_CONSTANT, constant)?)
    }
}
