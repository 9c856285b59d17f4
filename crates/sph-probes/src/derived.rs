//! Fields for outputs and probes that name them: those that follow from velocity and viscosity, and the distance to the free
//! surface.
//!
//! A scene without them has no column, no stage and no velocity gradient for their sake.

use rayon::prelude::*;
use sph_core::{Access, BoxTree, Field, Kind, Stage, StepError, Tensor, Vect, fields, stage};
use sph_neighbours::{Around, Values, World, walk, walk_some};

sph_core::fields! {
    pub SPEED: Scalar = "speed", "m/s", "length of the velocity";
    /// ω = ∂v/∂x − ∂u/∂y in the plane, positive where the fluid turns to the left.
    pub VORTICITY: Scalar = "vorticity", "1/s", "curl of the velocity, ∂v/∂x − ∂u/∂y in the plane";
    /// ω = ∇×u in space.
    pub VORTICITY_IN_SPACE: Vector = "vorticity", "1/s", "curl of the velocity";
    /// Q = ½(|Ω|² − |S|²): positive in vortices. Source: Hunt, Wray & Moin 1988.
    pub Q_CRITERION: Scalar = "q_criterion", "1/s²",
        "half of the squared rotation rate less the squared strain rate, positive in vortices";
    /// τ = η γ̇ with the viscosity of law and eddies; of an elastic law the viscous part alone.
    pub SHEAR_STRESS: Scalar = "shear_stress", "Pa",
        "viscosity times the magnitude of the strain rate; the viscous part alone";
    pub SURFACE_DISTANCE: Scalar = "surface_distance", "m",
        "distance to the nearest particle at a free surface, plus half a spacing";
}

/// True if a field of that name needs the gradient of the velocity.
pub fn needs_gradient(name: &str) -> bool {
    matches!(
        name,
        "velocity_gradient" | "strain_rate" | "vorticity" | "q_criterion" | "shear_stress"
    )
}

/// Names of the fields on request besides those that the plugins of a scene write.
pub fn derived_fields() -> impl Iterator<Item = &'static str> {
    let all = [SPEED, VORTICITY, Q_CRITERION, SHEAR_STRESS];
    all.into_iter().map(|field| field.name)
}

/// The stages of the fields that are `shown`, and no others.
pub fn derived_stages<const D: usize>(shown: &[String]) -> Vec<Box<dyn Stage<World<D>>>> {
    let gradient = fields::VELOCITY_GRADIENT;
    let in_plane = |g: &Gradient<D>| g[(1, 0)] - g[(0, 1)];
    let in_space = |g: &Gradient<D>| {
        Vect::from_fn(|k, _| g[((k + 2) % 3, (k + 1) % 3)] - g[((k + 1) % 3, (k + 2) % 3)])
    };
    let vorticity = match D {
        2 => of_one("vorticity", gradient, VORTICITY, in_plane),
        _ => of_one("vorticity", gradient, VORTICITY_IN_SPACE, in_space),
    };
    let access = Access::none()
        .here((fields::VISCOSITY, fields::STRAIN_RATE))
        .writes(SHEAR_STRESS);
    let shear_stress = stage("shear stress", access, |world: &mut World<D>| {
        let rates = world.free.get(fields::STRAIN_RATE)?;
        let both = world.free.get(fields::VISCOSITY)?.iter().zip(rates);
        let stress = both.map(|(eta, rate)| eta * rate).collect();
        Ok(world.free.put(SHEAR_STRESS, stress)?)
    });
    let all: [Box<dyn Stage<World<D>>>; 4] = [
        of_one("speed", fields::VELOCITY, SPEED, |u: &Vect<D>| u.norm()),
        vorticity,
        // |Ω|² − |S|² = −Σ G_ij G_ji, since the mixed terms cancel.
        of_one("q criterion", gradient, Q_CRITERION, |g: &Gradient<D>| {
            -0.5 * (g * g).trace()
        }),
        Box::new(shear_stress),
    ];
    let all = all.into_iter();
    all.filter(|stage| shown.iter().any(|s| s == stage.access().writes[0].name))
        .collect()
}

/// ∇u, 1/s.
type Gradient<const D: usize> = <Tensor as Kind>::Item<D>;

/// The stage of a field that follows from one other.
fn of_one<const D: usize, F: Kind + Send, K: Kind + Send>(
    name: &'static str,
    from: Field<F>,
    field: Field<K>,
    formula: fn(&F::Item<D>) -> K::Item<D>,
) -> Box<dyn Stage<World<D>>> {
    let access = Access::none().here(from).writes(field);
    Box::new(stage(name, access, move |world: &mut World<D>| {
        let values = world.free.get(from)?.iter().map(formula).collect();
        Ok(world.free.put(field, values)?)
    }))
}

/// Share of a full support, ΣVw/γ, above which a particle is not at a surface, however its neighbours stand.
const FULL: f64 = 0.9;
/// Radius of the cone that is empty above a surface particle, in spacings.
const CONE: f64 = 2.0;
/// Cosine of half of its angle.
const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The distance of every particle to the free surface, m; NaN where there is none.
///
/// A particle is at the surface if its support is less than 90 % full, walls counted as full (ΣVw/γ < 0.9), and no other
/// is in the cone of 45° and two spacings that opens against ∇C, the gradient of that share. The surface is taken half a
/// spacing outside of such particles. On a lattice whose rows are parallel to a flat surface this is exact; elsewhere it is
/// right to a spacing.
///
/// It is computed for outputs, when they are written, and never in a step.
///
/// Source: the cone is that of Marrone et al. 2010, Eq. 9, with the spacing for its length; the rest is ours.
///
/// # Errors
/// If a column of the flow is missing.
pub fn surface_distance<const D: usize>(world: &World<D>) -> Result<Vec<f64>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let surface = at_surface(world)?;
    let found = positions.iter().zip(&surface).filter(|(_, s)| **s);
    let places: Vec<Vect<D>> = found.flat_map(|(x, _)| images_of(world, *x)).collect();
    let tree = BoxTree::new(places.iter().map(|place| [(*place).into(); 2]).collect());
    let half = 0.5 * world.spacing;
    let distance = |x: &Vect<D>| {
        let apart = |k: usize| (x - places[k]).norm_squared();
        let nearest = tree.nearest((*x).into(), f64::INFINITY, apart);
        nearest.map_or(f64::NAN, |(apart, _)| apart.sqrt() + half)
    };
    let all = positions.par_iter().with_min_len(256).map(distance);
    Ok(all.collect())
}

/// A place and its images beyond periodic borders.
pub(crate) fn images_of<const D: usize>(world: &World<D>, x: Vect<D>) -> Vec<Vect<D>> {
    let mut all = vec![x];
    for axis in (0..D).filter(|a| world.domain.periodic[*a]) {
        let length = world.domain.length(axis);
        for k in 0..all.len() {
            for turn in [-1.0, 1.0] {
                let mut image = all[k];
                image[axis] += turn * length;
                all.push(image);
            }
        }
    }
    all
}

fn at_surface<const D: usize>(world: &World<D>) -> Result<Vec<bool>, StepError> {
    let outward = outward(world)?;
    let reach = CONE * world.spacing;
    let empty = walk_some(
        world,
        Values::Gradient,
        |i| outward[i].is_some(),
        |around: &Around<'_, D>| {
            let Some(normal) = outward[around.rows.particle] else {
                return false;
            };
            let rows = &around.rows.free;
            let mut others = rows.separation.iter().zip(rows.distance2);
            // The separation points from the neighbour to the particle.
            !others.any(|(d, r2)| *r2 < reach * reach && -d.dot(&normal) > HALF * r2.sqrt())
        },
    )?;
    Ok(empty.into_iter().map(|e| e.unwrap_or(false)).collect())
}

/// The direction out of the fluid, of particles whose support is not full; zero where it has none.
fn outward<const D: usize>(world: &World<D>) -> Result<Vec<Option<Vect<D>>>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let points = &world.walls.points;
    let own = world.kernel.value_at_zero();
    walk(world, Values::Both, |around: &Around<'_, D>| {
        let (rows, i) = (&around.rows, around.rows.particle);
        let mut filling = volume[i] * own;
        let mut gradient = Vect::<D>::zeros();
        for (k, (&j, w)) in rows.free.index.iter().zip(around.free).enumerate() {
            let v = volume[j as usize];
            filling += v * w;
            gradient += rows.free.separation[k] * (v * rows.free.factor[k]);
        }
        for (k, (&v, w)) in rows.wall.index.iter().zip(around.wall).enumerate() {
            let part = points.share[v as usize] * points.volume[v as usize];
            filling += part * w;
            gradient += rows.wall.separation[k] * (part * rows.wall.factor[k]);
        }
        let share = filling * rows.inverse_renormalisation;
        for contact in rows.contacts {
            gradient -= contact.gradient * share;
        }
        (share < FULL).then(|| -gradient.try_normalize(0.0).unwrap_or_else(Vect::zeros))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_nobody_asks_for_is_made() {
        assert!(derived_stages::<2>(&[]).is_empty());
        let shown = ["pressure", "vorticity", "speed"].map(String::from);
        let names: Vec<String> = derived_stages::<3>(&shown)
            .iter()
            .map(|s| s.name())
            .collect();
        assert_eq!(names, ["speed", "vorticity"]);
    }
}
