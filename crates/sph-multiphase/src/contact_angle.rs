//! The angle at which interfaces meet walls, as the tension of films on them.

use std::collections::BTreeMap;

use sph_contribution::{Refusal, Setting};
use sph_core::{Access, Field, Stage, Vect, Vector, fields, parameters, stage, suggestion};
use sph_neighbours::{Around, Values, World, walk_into};

/// Angle at which an interface meets walls at rest, measured through one of its phases.
#[parameters]
pub struct ContactAngle {
    /// The phase through which angles are measured.
    pub phase: String,
    /// The angle: 0 where the phase wets walls, 180° where it shuns them.
    #[parameter(unit: "rad", min: 0.0, max: 3.15)]
    pub angle: f64,
    /// Angles at walls of their own, by the names of the walls.
    #[parameter(default, unit: "rad")]
    pub walls: BTreeMap<String, f64>,
}

impl ContactAngle {
    /// Checks that there are such a phase and such walls.
    ///
    /// # Errors
    /// The key that names none.
    pub(crate) fn check<const D: usize>(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let refused = |key: &str, why: String| {
            let key = format!("contact_angle.{key}");
            Err(Refusal::at_key("interface", key.trim_end_matches('.'), why))
        };
        setting.phase_number("interface", "contact_angle.phase", &self.phase)?;
        let walls = &setting.world.walls;
        if walls.elements.centre.is_empty() {
            let why = "it needs walls of the kind `usaw`, whose share of every kernel is known";
            return refused("", why.into());
        }
        if walls.points.in_density() {
            let why = "the film would miss the half row that belongs to the wall: give `[walls.usaw]` the key \
                       `vertices = false`";
            return refused("", why.into());
        }
        for (name, angle) in &self.walls {
            if !walls.names.contains(name) {
                let near = suggestion(name, walls.names.iter().map(String::as_str));
                let why = format!("there is no wall `{name}`{near}");
                return refused(&format!("walls.{name}"), why);
            }
            if !(0.0..=std::f64::consts::PI).contains(angle) {
                return refused(&format!("walls.{name}"), "expected 0 to 180 deg".into());
            }
        }
        Ok(())
    }

    /// The stage that finds [`FILM`].
    pub(crate) fn films<const D: usize>(
        &self,
        setting: &Setting<'_, D>,
    ) -> impl Stage<World<D>> + use<D> {
        let number = setting.phases.iter().position(|p| *p == self.phase);
        let wetting = number.unwrap_or(0) as u32;
        let of_wall = |name: &String| self.walls.get(name).unwrap_or(&self.angle).cos();
        let cosines: Vec<f64> = setting.world.walls.names.iter().map(of_wall).collect();
        let access = Access::none()
            .here((fields::POSITION, fields::PHASE, fields::RENORMALISATION))
            .writes(FILM);
        stage("films on walls", access, move |world: &mut World<D>| {
            let mut films = world.free.take(FILM)?;
            let phase = world.free.get(fields::PHASE)?;
            let wall = &world.walls.elements.wall;
            let film = |around: &Around<'_, D>| {
                let wets = phase[around.rows.particle] == wetting;
                let mut sum = Vect::<D>::zeros();
                for contact in around.rows.contacts.iter() {
                    let cosine = cosines[wall[contact.element as usize] as usize];
                    if (cosine > 0.0) == wets {
                        sum += contact.gradient * (2.0 * cosine.abs());
                    }
                }
                sum * around.rows.inverse_renormalisation
            };
            walk_into(world, Values::Gradient, |_| true, &mut films, film)?;
            Ok(world.free.put(FILM, films)?)
        })
    }
}

/// Σ_s 2 cos θ ∇γ_as/γ_a of the phase that wets a wall, 1/m; −σ times it is the tension of the film on the wall.
pub const FILM: Field<Vector> = Field::new("film", "1/m", "tension of films on walls over −σ");
