//! Shifting down the gradient of concentration.

use rayon::prelude::*;
use sph_core::{Access, Stage, StepError, Vect, fields, parameters, plugin, stage};
use sph_neighbours::World;

use sph_contribution::{Contribution, Offer, Refusal, Setting};

use crate::diffusion::ShiftingEntry;
use crate::diffusion::evenness::{Evenness, ShiftLimit, evenness, held_normals};
use crate::diffusion::shift_transport::{ShiftTransport, ShiftedSum};

/// Particles move, besides their velocity, down the gradient of their concentration,
/// s_a = −B h c 1/γ_a [Σ_b θ_b V_b (1 + R (w_ab/w(δr))ⁿ) ∇w_ab − Σ_s (C_a + R (w(2d_as)/w(δr))ⁿ) ∇γ_as],
/// |s| ≤ L U.
///
/// Symbols: s shift velocity (m/s); h smoothing length (m); c speed of sound at rest of the particle's phase (m/s); U its
/// largest speed against the mean velocity (m/s), so that s vanishes at rest and in a uniform wind, and a gust of air does
/// not stir the water; C concentration ΣθVw/γ; d distance from a wall element (m); B, R, n, L numbers. The first
/// terms even the particles out; those with R keep pairs, and particles and their images behind a wall, from clumping.
/// Arrangements that noise disturbs at the speed of sound are mended at a share of it. B h c is kept below h²/4Δt, beyond which an explicit
/// diffusion would overshoot.
///
/// Carried quantities belong to the fluid, not to the particle: with `transport = "all"` it takes up
/// what is where it goes, du/dt += (s·∇)u and dρ/dt += s·∇ρ (and, where the density is a sum over
/// positions, the constant K takes back what the move does to the sum). Without it the density of a
/// summed formulation follows the rearrangement, which is noise, and noise rubs: a channel at Re = 100, 25 particles
/// across, is too slow by 22 % without (`nothing`), 5 % without any shifting, and 0.7 % with `all`.
///
/// Limits: where a support is less full than `surface`, and within a support of there, the
/// component along the normal is left out, and all of it where there is no single normal (thin
/// jets, corners); so is the component across an interface between phases, that into a wall nearer than δr/2, and all of it within reach of
/// wall points (`vertices` of semi-analytical walls, dummy particles). Where a wall moves, or with `along_walls`, so is all that
/// leads along the normal of a wall within some 1.5 h: a shift towards a wall lets fluid flow through it, and a cylinder sank 1.6
/// times too fast. Before plane walls at rest it does more harm than good: a channel at Re_τ = 180 misses its friction by 8 % with
/// it and by 4 % without, a swinging drop its period by 1.3 and 0.3 %. (s·∇)u does not conserve momentum to rounding
/// (1e-4 of Σm|u| in the vortices, 1.2e-3 in 1000 steps of a noisy box; `density` does). Jets of some five spacings gain energy
/// from fast shifts and burst: the arms of `rotating-square` need L = 0.1, with which waves in a flume are 3.9 % off in
/// height and not 0.7 %.
///
/// Source: Lind et al. 2012 (form, R, n); Sun et al. 2017 (limit,
/// surfaces); Adami et al. 2013 (the scale: their background pressure ρc² shifts with B = 2cΔt/h); Sun et al. 2019 (transport). The walls'
/// parts and the way back of the density ([`ShiftTransport`](crate::diffusion::ShiftTransport)) are ours.
///
/// ```toml
/// [shifting.fickian]
/// strength = 0.5
/// ```
#[plugin(ShiftingEntry [2, 3], "fickian", "particles move down the gradient of their concentration",
    source: "Lind et al. 2012; Sun et al. 2017")]
#[derive(Copy)]
pub struct Fickian {
    /// Strength B: the diffusivity of the arrangement over h c.
    #[parameter(default: 0.5, unit: "1", min: 0.0, max: 2.0,
        source: "after Adami et al. 2013, who have 0.5 at Δt = 0.25 h/c")]
    pub strength: f64,
    /// Weight R of the term against clumping.
    #[parameter(default: 0.2, unit: "1", min: 0.0, max: 1.0, source: "Lind et al. 2012, after Monaghan 2000")]
    pub tensile: f64,
    /// Exponent n of the term against clumping.
    #[parameter(default: 4, unit: "1", min: 1, max: 8, source: "Lind et al. 2012, after Monaghan 2000")]
    pub exponent: i32,
    /// Largest |s| over U.
    #[parameter(default: 0.5, unit: "1", min: 0.0, max: 1.0, source: "Sun et al. 2017")]
    pub limit: f64,
    /// Share of a full support, ΣθVw/γ, below which a particle is at a free surface.
    ///
    /// The outer row of a lattice has 0.78, 0.69 and 0.62 at h/δr = 1.3, 2 and 3.
    #[parameter(default: 0.85, unit: "1", min: 0.0, max: 1.0, source: "measured on lattices")]
    pub surface: f64,
    /// Quantities that a shifted particle takes up where it goes.
    #[parameter(default: Transport::All, source: "Sun et al. 2019")]
    pub transport: Transport,
    /// Rate at which the transported density returns to that of the arrangement, over the rate of rearrangement.
    #[parameter(default: 0.5, unit: "1", min: 0.0, max: 10.0,
        source: "ours; 0.1 to 1 in channels and cavities at c = 10 to 40 U")]
    pub relaxation: f64,
    /// True if shifts keep along walls at rest, too, as they do where a wall moves: for curved walls.
    #[parameter(default, source: "ours")]
    pub along_walls: bool,
}

/// Quantities that a shifted particle takes up where it goes.
#[parameters]
pub enum Transport {
    /// Nothing: it keeps its velocity, and its density follows the formulation.
    Nothing,
    /// The density.
    Density,
    /// The density and the velocity.
    All,
}

impl<const D: usize> Contribution<D> for Fickian {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.goals.push(fields::SHIFT_VELOCITY.any());
        let laws = setting.laws.iter();
        let speeds = laws.map(|l| l.reference().sound_speed).collect();
        offer.stage(shift_velocity(*self, speeds));
        if self.transport != Transport::Nothing {
            offer.changes_density = true;
            offer.term(ShiftTransport {
                velocity: self.transport == Transport::All,
                relaxation: self.relaxation,
                summed: setting.summed && !setting.world.walls.scales,
            });
            if setting.summed && setting.world.walls.scales {
                offer.term(ShiftedSum);
            }
        }
        offer.remedy = Some(format!("weaken {}", offer.path));
        Ok(())
    }
}

/// Share of h²/Δt that a diffusivity may have.
const STABLE: f64 = 0.25;

/// The shift velocity; `speeds` are those of sound of every phase, m/s.
fn shift_velocity<const D: usize>(shifting: Fickian, speeds: Vec<f64>) -> impl Stage<World<D>> {
    let access = Access::none()
        .both((fields::POSITION, fields::VOLUME))
        .where_there(fields::PHASE)
        .here((fields::VELOCITY, fields::MASS))
        // Drifts may sort particles between their halves: the shift must be sorted, too.
        .remembers(fields::SHIFT_VELOCITY)
        .writes(fields::VOID_FRACTION)
        // Normals are sums over sums at neighbours.
        .rings(2);
    // The measures of every particle's neighbourhood, kept from step to step.
    let mut all = Vec::new();
    stage("Fickian shifting", access, move |world: &mut World<D>| {
        let fastest = largest_speeds(world)?;
        let mut shift = world.free.take(fields::SHIFT_VELOCITY)?;
        let mut void_fraction = world.free.take(fields::VOID_FRACTION)?;
        let phase = world.free.get(fields::PHASE).ok();
        if fastest.iter().any(|u| *u > 0.0) {
            let h = world.kernel.smoothing_length();
            evenness(world, shifting.tensile, shifting.exponent, &mut all)?;
            let normals = held_normals(world, &all, shifting.surface)?;
            // Rows that pass points that stand are rearranged all the time, so that no density is taken up beside them: a shift
            // would change the pressure by ρc², and a tank at rest would sing.
            let rough = world.walls.points.in_sums();
            let along_walls = shifting.along_walls || !world.walls.frames.is_empty();
            let results = shift.par_iter_mut().zip(&mut void_fraction).zip(&all);
            let results = results.enumerate().with_min_len(1024);
            results.for_each(|(i, ((s, empty), even))| {
                if rough && !world.lists.wall.candidates(i).is_empty() {
                    (*s, *empty) = (Vect::zeros(), 0.0);
                    return;
                }
                *empty = 1.0 - even.filling;
                let phase = phase.map_or(0, |p| p[i] as usize);
                let diffusivity = shifting.strength * h * speeds[phase];
                let diffusivity = diffusivity.min(STABLE * h * h / world.dt);
                let most = shifting.limit * fastest[phase];
                *s = along_interface(even, -diffusivity * even.push).cap_magnitude(most);
                if let Some(normals) = &normals {
                    *s = normals[i].held(*s);
                    if !matches!(normals[i], ShiftLimit::No) {
                        *empty = 0.0;
                    }
                }
                if along_walls {
                    keep_along(world, i, s);
                }
                keep_off(world, i, s);
            });
        } else {
            shift.fill(Vect::zeros());
            void_fraction.fill(0.0);
        }
        world.free.put(fields::VOID_FRACTION, void_fraction)?;
        Ok(world.free.put(fields::SHIFT_VELOCITY, shift)?)
    })
}

fn along_interface<const D: usize>(even: &Evenness<D>, shift: Vect<D>) -> Vect<D> {
    match even.interface {
        Some(normal) => shift - normal * normal.dot(&shift),
        None => shift,
    }
}

/// Decay of the component along a wall's normal towards the wall: it is multiplied with exp(−h |∇γ|/0.05), of which 3 %
/// are left a smoothing length before a flat wall and three quarters at one and a half.
const TOWARDS_WALLS: f64 = 0.05;

/// Removes the part towards walls or away from them.
///
/// A density that takes no notice of shifts lets u = −s stand at a wall that no particle passes: fluid would flow through
/// the wall, and the shift would bring its particles back.
fn keep_along<const D: usize>(world: &World<D>, particle: usize, shift: &mut Vect<D>) {
    let least = TOWARDS_WALLS / world.kernel.smoothing_length();
    let mut whole = Vect::zeros();
    for contact in world.walls.contacts.of_particle(particle) {
        // Element by element, so that a flat wall has the same of it however it is divided, and a corner both its normals.
        let normal = world.walls.elements.normal[contact.element as usize];
        let left = (-contact.gradient.norm() / least).exp();
        *shift -= normal * (shift.dot(&normal) * (1.0 - left));
        whole += contact.gradient;
    }
    // Of a curved wall the last elements turn the result of the first.
    let size = whole.norm();
    if size > 0.0 {
        let normal = whole / size;
        *shift -= normal * (shift.dot(&normal) * (1.0 - (-size / least).exp()));
    }
}

/// Removes the part into a wall that is nearer than half a spacing.
fn keep_off<const D: usize>(world: &World<D>, particle: usize, shift: &mut Vect<D>) {
    for contact in world.walls.contacts.of_particle(particle) {
        if contact.distance < 0.5 * world.spacing {
            let normal = world.walls.elements.normal[contact.element as usize];
            *shift -= normal * shift.dot(&normal).min(0.0);
        }
    }
}

/// The largest speed of every phase against the mean velocity of all, m/s.
fn largest_speeds<const D: usize>(world: &World<D>) -> Result<Vec<f64>, StepError> {
    const BATCH: usize = 4096;
    let (velocity, mass) = world.free.all((fields::VELOCITY, fields::MASS))?;
    let phase = world.free.get(fields::PHASE).ok();
    // Mass and momentum, of which the last component is not there in the plane.
    let sums = world.sums(|i| {
        let part = |axis: usize| velocity[i].get(axis).map_or(0.0, |u| mass[i] * u);
        [mass[i], part(0), part(1), part(2)]
    })?;
    let mean = Vect::<D>::from_fn(|k, _| sums[1 + k]) / sums[0];
    let mut phases = [phase.map_or(0.0, |p| f64::from(p.iter().max().copied().unwrap_or(0)))];
    world.largest(&mut phases)?;
    let phases = phases[0] as usize + 1;
    let scale = mean.norm_squared();
    let largest = |k: usize| {
        let all = velocity.par_iter().enumerate().with_min_len(BATCH);
        let of_phase = all.filter(|(i, _)| phase.is_none_or(|p| p[*i] as usize == k));
        let squares = of_phase.map(|(_, u)| (u - mean).norm_squared());
        squares.reduce(|| 0.0, f64::max)
    };
    let mut squares: Vec<f64> = (0..phases).map(largest).collect();
    world.largest(&mut squares)?;
    // A uniform wind differs from its own mean by rounding.
    let speed = |square: &f64| match *square > 1e-24 * scale {
        true => square.sqrt(),
        false => 0.0,
    };
    Ok(squares.iter().map(speed).collect())
}
