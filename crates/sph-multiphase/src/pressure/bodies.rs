//! Bodies that give way to the pressure that is solved for.

use nalgebra::Vector6;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{FreeBody, World};

use crate::linear::Operator;

/// The force of the wall over Bᵀp that is reckoned with: it is 2 for a pressure that is the same everywhere, 2.5 were
/// measured for one that falls off from the body. With less than the true one light bodies swing from step to step,
/// with more they follow within some steps.
const RESPONSE: f64 = 4.0;

/// Share of bodies in the system of the pressure: p moves a body within the step, and the body the fluid.
///
/// With B_a = −γ_aV_a ∂(1/γ_a Σ_s u_s·∇γ_as)/∂(v, ω), W the mobility of a body, a its acceleration over the last step
/// and pⁿ the pressure before,
///
/// (A + 4Δt² B W Bᵀ) p = s − Δt² B (a − 4 W Bᵀ pⁿ): vⁿ⁺¹ = vⁿ + Δt [a + 4 W Bᵀ (p − pⁿ)].
///
/// All forces are in a, and p alone has changed since, so that a body at rest stays at rest; it may be lighter than
/// its added mass by any factor. Gives the vectors 2Δt B S, W = S Sᵀ, of that update.
pub(crate) fn give_way<const D: usize>(
    world: &World<D>,
    base: &dyn Operator<1>,
    right: &mut [Vect<1>],
    before: &[Vect<1>],
) -> Result<Vec<Vec<Vect<1>>>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let dt = world.dt;
    let mut vectors = Vec::new();
    for body in &world.walls.bodies {
        let first = vectors.len();
        for root in body.roots() {
            let along = |j: &Vector6<f64>| -(RESPONSE.sqrt() * dt) * j.dot(&root);
            let mut g = column(world, body, along, volume);
            base.import(&mut g);
            vectors.push(g);
        }
        if vectors.len() > first {
            let moved = column(world, body, |j| dt * dt * j.dot(&body.rate), volume);
            right.iter_mut().zip(moved).for_each(|(b, m)| *b += m);
        }
    }
    let shares: Vec<f64> = vectors.iter().map(|g| base.inner(g, before)).collect();
    for (g, share) in vectors.iter().zip(shares) {
        right.iter_mut().zip(g).for_each(|(b, g)| *b += g * share);
    }
    Ok(vectors)
}

/// V_a f(Σ_s (∇γ_as, r_s × ∇γ_as)) over the elements of a body, for every particle.
fn column<const D: usize>(
    world: &World<D>,
    body: &FreeBody<D>,
    of: impl Fn(&Vector6<f64>) -> f64,
    volume: &[f64],
) -> Vec<Vect<1>> {
    let walls = &world.walls;
    let one = |i: usize| {
        let mut sum = Vector6::zeros();
        for contact in walls.contacts.of_particle(i) {
            let s = contact.element as usize;
            if body.is(walls.elements.wall[s] as usize) {
                sum += body.along(&walls.elements.centre[s], &contact.gradient);
            }
        }
        Vect::from([volume[i] * of(&sum)])
    };
    (0..volume.len()).map(one).collect()
}
