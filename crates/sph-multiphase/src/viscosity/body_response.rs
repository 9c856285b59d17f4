//! Bodies that give way to the friction that is solved for.

use nalgebra::{DMatrix, Matrix6, SMatrix, Vector6};
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{FreeBody, World};

use crate::linear::Operator;
use crate::viscosity::FrictionSystem;

/// The force of the friction over that of W alone, at the most: rows beside a flat wall have γ ≥ ½, and all that acts
/// on them goes with 1/γ. With less than the true one light bodies swing from step to step, with more they follow
/// within some steps.
const RESPONSE: f64 = 2.0;

/// Δt C/M up to which a body moves with the friction of the step before, far from where it swings.
const FAINT: f64 = 0.1;

/// Δt C/M up to which a step is right: beyond it the force on the wall oscillates.
const MOST: f64 = 4.0;

/// A body of mass M whose velocity v is an unknown of the friction of a step.
///
/// With B_a = W_a P_a J_a, W_a what walls do to a particle, P_a the part along the wall, J_a v the velocity of the
/// body at the particle, C = Σ JᵀPWPJ, a its acceleration over the last step, v* the velocity that friction was solved
/// with then, and M half of the mass,
///
/// (M + Δt C)(vⁿ⁺¹ − vⁿ) = Δt [M a + Bᵀ(uⁿ⁺¹ − uⁿ) − C (vⁿ − v*)], so that u is left with A − Δt² B (M + Δt C)⁻¹ Bᵀ.
struct BodyResponse<const D: usize> {
    body: FreeBody<D>,
    /// B of the particles at it.
    rows: Vec<(usize, SMatrix<f64, D, 6>)>,
    /// Columns of a root of (M + Δt C)⁻¹.
    roots: Vec<Vector6<f64>>,
    /// (M + Δt C)⁻¹ Δt [M a − C (vⁿ − v*)].
    ahead: Vector6<f64>,
    /// Bᵀuⁿ.
    before: Vector6<f64>,
}

/// All bodies that the friction of a step moves noticeably.
pub(crate) struct Bodies<const D: usize>(Vec<BodyResponse<D>>);

/// Bᵀu over all particles of one's own.
fn pushed<const D: usize>(
    world: &World<D>,
    rows: &[(usize, SMatrix<f64, D, 6>)],
    u: &[Vect<D>],
) -> Result<Vector6<f64>, StepError> {
    let owned = world.owned();
    let part = |k: usize| {
        let (i, b) = &rows[k];
        let own = || <[f64; 6]>::from(b.transpose() * u[*i]);
        owned.has(*i).then(own)
    };
    Ok(world.sums_of(rows.len(), &part)?.into())
}

impl<const D: usize> BodyResponse<D> {
    /// None where friction moves it too little.
    fn new(
        body: &FreeBody<D>,
        world: &World<D>,
        system: &FrictionSystem<D>,
        earlier: &[Vect<D>],
        dt: f64,
    ) -> Result<Option<Self>, StepError> {
        let position = world.free.get(fields::POSITION)?;
        let (walls, mut rows) = (&world.walls, Vec::new());
        let mut parts = Vec::new();
        let owned = world.owned();
        for (i, x) in position.iter().enumerate() {
            let (mut all, mut mine, mut normal) = (0.0, 0.0, Vect::<D>::zeros());
            for contact in walls.contacts.of_particle(i) {
                let s = contact.element as usize;
                let share = walls.elements.friction_factor[s] * contact.gradient.norm();
                all += share;
                if body.is(walls.elements.wall[s] as usize) {
                    mine += share;
                    normal += contact.gradient;
                }
            }
            let Some(n) = normal.try_normalize(0.0).filter(|_| mine > 0.0) else {
                continue;
            };
            let along = SMatrix::<f64, D, D>::identity() - n * n.transpose();
            let axis = |k: usize| Vect::from_fn(|i, _| f64::from(u8::from(i == k)));
            let lines: [_; D] = std::array::from_fn(|k| body.along(x, &axis(k)).transpose());
            let j = SMatrix::<f64, D, 6>::from_rows(&lines);
            let b = along * system.of_walls(i) * along * j * (mine / all);
            rows.push((i, b));
            if owned.has(i) {
                let c: Matrix6<f64> = j.transpose() * b;
                parts.push(<[f64; 36]>::try_from(c.as_slice()).unwrap_or([0.0; 36]));
            }
        }
        let friction = world.sums_of(parts.len(), &|k| Some(parts[k]))?;
        let friction = Matrix6::from_column_slice(&friction);
        let mobility = body.mobility * RESPONSE;
        let columns: Vec<_> = body.roots().map(|r| r * RESPONSE.sqrt()).collect();
        if columns.is_empty() {
            return Ok(None);
        }
        let root = DMatrix::from_fn(6, columns.len(), |i, k| columns[k][i]);
        let coupled = root.transpose() * friction * &root * dt;
        let share = coupled.symmetric_eigenvalues().max() / RESPONSE;
        if share < FAINT {
            return Ok(None);
        }
        if share > MOST {
            let reason = format!(
                "in a step of {dt:.1e} s friction moves a body {share:.1} times as much as its mass resists, {MOST} is \
                 the most: multiply `run.safety` by {:.2}, or take a heavier body or less viscosity",
                0.8 * MOST / share
            );
            return Err(StepError::stage("friction of a light body", reason));
        }
        let matrix = DMatrix::identity(columns.len(), columns.len()) + coupled;
        let factor = matrix.clone().try_inverse().and_then(|m| m.cholesky());
        let coupled = mobility * friction * dt;
        let factors = (Matrix6::identity() + coupled).lu();
        let ahead = factors.solve(&(body.rate * dt - coupled * body.missed));
        let (Some(factor), Some(ahead)) = (factor, ahead) else {
            return Ok(None);
        };
        let roots = root * factor.l();
        let roots = roots.column_iter();
        Ok(Some(BodyResponse {
            body: body.clone(),
            before: pushed(world, &rows, earlier)?,
            rows,
            roots: roots.map(|c| c.fixed_rows::<6>(0).into_owned()).collect(),
            ahead,
        }))
    }

    /// Change of the body's velocity by Bᵀu.
    fn pulled(&self, push: &Vector6<f64>, dt: f64) -> Vector6<f64> {
        let pull = |r: &Vector6<f64>| r * (dt * r.dot(push));
        self.roots.iter().map(pull).sum()
    }

    /// Change of the body's velocity without the friction at the end of the step.
    fn freely(&self, dt: f64) -> Vector6<f64> {
        self.ahead - self.pulled(&self.before, dt)
    }
}

impl<const D: usize> Bodies<D> {
    /// Of a world and a system that was filled for a step of Δt; `earlier` is uⁿ.
    pub fn new(
        world: &World<D>,
        system: &FrictionSystem<D>,
        earlier: &[Vect<D>],
        dt: f64,
    ) -> Result<Option<Self>, StepError> {
        let mut all = Vec::new();
        for body in &world.walls.bodies {
            all.extend(BodyResponse::new(body, world, system, earlier, dt)?);
        }
        Ok((!all.is_empty()).then_some(Bodies(all)))
    }

    /// Adds the further effect of bodies on the fluid, and gives the vectors of the update.
    pub fn bind(
        &self,
        base: &dyn Operator<D>,
        right: &mut [Vect<D>],
        dt: f64,
    ) -> Vec<Vec<Vect<D>>> {
        let mut vectors = Vec::new();
        for one in &self.0 {
            let column = |v: &Vector6<f64>| {
                let mut g = vec![Vect::<D>::zeros(); base.rows()];
                one.rows.iter().for_each(|(i, b)| g[*i] = b * v * dt);
                base.import(&mut g);
                g
            };
            let source = column(&one.freely(dt));
            right.iter_mut().zip(source).for_each(|(b, s)| *b += s);
            vectors.extend(one.roots.iter().map(column));
        }
        vectors
    }

    /// Gives the walls the velocity that their bodies have with a velocity of the fluid, for sums over this step.
    pub fn carry(&self, world: &mut World<D>, u: &[Vect<D>], dt: f64) -> Result<(), StepError> {
        for one in &self.0 {
            let push = pushed(world, &one.rows, u)?;
            let change = one.freely(dt) + one.pulled(&push, dt);
            let bodies = world.walls.bodies.iter_mut();
            let same = |body: &&mut FreeBody<D>| body.walls == one.body.walls;
            bodies.filter(same).for_each(|body| body.expected = change);
            let elements = &mut world.walls.elements;
            for s in (0..elements.wall.len()).filter(|s| one.body.is(elements.wall[*s] as usize)) {
                let axis = |k: usize| Vect::from_fn(|i, _| f64::from(u8::from(i == k)));
                let at = |k: usize| one.body.along(&elements.centre[s], &axis(k)).dot(&change);
                elements.velocity[s] += Vect::from_fn(|k, _| at(k));
            }
        }
        Ok(())
    }
}
