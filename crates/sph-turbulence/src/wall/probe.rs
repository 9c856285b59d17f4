//! The friction velocity of a wall.

use sph_core::{StepError, plugin, suggestion};
use sph_neighbours::World;
use sph_probes::{Needs, Probe, ProbeColumn, ProbeEntry};

use crate::columns::{FRICTION_VELOCITY, WALL_UNITS};

/// u* = √(Σ w u*²/Σ w) and z⁺ = Σ w z⁺/Σ w of the particles near a wall with a wall function, weighted with their shares
/// w = Σ_s |∇γ_as| of its shear, and the least z⁺.
///
/// ```toml
/// [probe.bed]
/// kind = "friction-velocity"
/// wall = "bed"
/// ```
#[plugin(ProbeEntry [2, 3], "friction-velocity", "friction velocity and z+ of a wall with a wall function",
    source: "Issa 2004, Eq. 6.34–6.36", cfg(not(test)))]
pub struct FrictionVelocityProbe {
    /// Name of the wall.
    pub wall: String,
}

impl<const D: usize> Probe<D> for FrictionVelocityProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        vec![
            ProbeColumn::named("", "m/s"),
            ProbeColumn::named(".z-plus", "1"),
            ProbeColumn::named(".least-z-plus", "1"),
        ]
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            around: true,
            fields: vec![FRICTION_VELOCITY.name.into(), WALL_UNITS.name.into()],
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let refused = |why: &str| StepError::stage("probe `friction-velocity`", why);
        let walls = &world.walls;
        if !walls.names.contains(&self.wall) {
            let near = suggestion(&self.wall, walls.names.iter().map(String::as_str));
            let why = format!("there is no wall `{}`{near}", self.wall);
            return Err(refused(&why));
        }
        if !world.free.has(FRICTION_VELOCITY.name) {
            let why =
                "no wall of this scene has a wall function: name one, `[wall-function.log-law]`";
            return Err(refused(why));
        }
        let (friction, units) = world.free.all((FRICTION_VELOCITY, WALL_UNITS))?;
        let of_it = |s: u32| {
            let elements = &walls.elements;
            let marked = elements.wall_function.get(s as usize) == Some(&true);
            marked && walls.names[elements.wall[s as usize] as usize] == self.wall
        };
        let (mut weight, mut shear, mut mean, mut least) = (0.0, 0.0, 0.0, f64::INFINITY);
        for &particle in &walls.contacts.particles {
            let i = particle as usize;
            let contacts = walls.contacts.of_particle(i).iter();
            let own = contacts.filter(|c| of_it(c.element));
            let own: f64 = own.map(|c| c.gradient.norm()).sum();
            if own > 0.0 && units[i].is_finite() {
                weight += own;
                shear += own * friction[i] * friction[i];
                mean += own * units[i];
                least = units[i].min(least);
            }
        }
        Ok(match weight > 0.0 {
            true => vec![(shear / weight).sqrt(), mean / weight, least],
            false => vec![f64::NAN; 3],
        })
    }
}
