//! Walls of dummy particles after Adami, Hu & Adams (2012).

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{StepError, Vect, fields, register};
use sph_neighbours::{Contacts, WallPoints, WallSet, World, shepard};

use crate::layers::layers;
use crate::near::NearLists;
use crate::outline::{Outline, checks_by_outline};
use crate::{BoundaryError, Wall, WallEntry, WallSetup};

/// Layers of fixed particles behind the wall that take part in all sums like fluid particles.
///
/// p_w = Σ [p_f + ρ_f g·(r_w − r_f)] w / Σ w (their Eq. 27); no-slip by the velocity
/// 2 u_wall − Σ u_f w / Σ w in viscous sums (their Eq. 23). No renormalisation: the layers fill
/// the kernel. Walls thinner than two supports lack layers and push too little.
///
/// Source: Adami, Hu & Adams 2012, J. Comput. Phys. 231, 7057–7075.
///
/// ```toml
/// [walls.dummy-particles]
/// ```
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DummyParticles {
    #[serde(skip)]
    set_up: Option<SetUp>,
}

#[derive(Debug)]
struct SetUp {
    outline: Outline,
    /// Positions of the particles as drawn, with their wall.
    drawn: Vec<(usize, [f64; 2])>,
    motions: Vec<crate::RigidMotion>,
    near: NearLists,
}

register!(
    WallEntry[2],
    DummyParticles,
    "dummy-particles",
    "layers of fixed particles behind the wall",
    "Adami, Hu & Adams 2012"
);

impl Wall<2> for DummyParticles {
    fn lattice_offset(&self) -> f64 {
        0.5
    }

    fn renormalises(&self) -> bool {
        false
    }

    fn build(&mut self, setup: &WallSetup<'_, 2>) -> Result<WallSet<2>, BoundaryError> {
        let support = setup.kernel.support() * setup.smoothing_length;
        let outline = Outline::new(setup, support)?;
        let drawn = layers(&outline, setup.spacing, support);
        let mut points = WallPoints::default();
        for &(wall, position) in &drawn {
            let velocity = outline.velocity(wall, position, 0.0);
            points.position.push(position.into());
            points.velocity.push(velocity);
            points.viscous_velocity.push(velocity);
            points.share.push(1.0);
            points.volume.push(setup.spacing.powi(2));
            points.pressure.push(0.0);
            points.grip.push(outline.grip(wall));
            points.wall.push(wall as u32);
        }
        let names = outline.mesh.walls().to_vec();
        let motions = setup.walls.iter().map(|w| w.motion).collect();
        self.set_up = Some(SetUp {
            outline,
            drawn,
            motions,
            near: NearLists::default(),
        });
        Ok(WallSet {
            names,
            points,
            elements: Default::default(),
            contacts: Contacts::default(),
        })
    }

    checks_by_outline!();

    fn move_to(&mut self, walls: &mut WallSet<2>, time: f64) -> Result<(), BoundaryError> {
        let Some(set_up) = &mut self.set_up else {
            return Ok(());
        };
        if !set_up.outline.moves() {
            return Ok(());
        }
        set_up.outline.move_to(time)?;
        set_up.near.expire();
        for (v, &(wall, drawn)) in set_up.drawn.iter().enumerate() {
            let position = set_up.motions[wall].pose(time).map()(drawn);
            walls.points.position[v] = position.into();
            walls.points.velocity[v] = set_up.outline.velocity(wall, position, time);
        }
        Ok(())
    }

    fn geometry(&mut self, world: &mut World<2>) -> Result<(), StepError> {
        match &mut self.set_up {
            Some(set_up) => set_up.near.refresh(&set_up.outline, world),
            None => Ok(()),
        }
    }

    fn constrain(&mut self, world: &mut World<2>, dt: f64) -> Result<(), StepError> {
        match &self.set_up {
            Some(set_up) => set_up.near.constrain(&set_up.outline, world, dt),
            None => Ok(()),
        }
    }

    fn state(&mut self, world: &mut World<2>) -> Result<(), StepError> {
        let position = world.free.get(fields::POSITION)?;
        let velocity = world.free.get(fields::VELOCITY)?;
        let pressure = world.free.get(fields::PRESSURE)?;
        let density = world.free.get(fields::DENSITY)?;
        let points = &world.walls.points;
        let means = shepard(
            world,
            &points.position,
            &world.lists.of_points,
            |v, row, w| {
                let (mut sum_w, mut sum_p, mut sum_u) = (0.0, 0.0, Vect::<2>::zeros());
                for (&j, w) in row.iter().zip(w) {
                    let j = j as usize;
                    let apart = world.domain.nearest_image(points.position[v] - position[j]);
                    sum_w += w;
                    sum_p += w * (pressure[j] + density[j] * world.gravity.dot(&apart));
                    sum_u += velocity[j] * *w;
                }
                if sum_w > 0.0 {
                    (sum_p / sum_w, points.velocity[v] * 2.0 - sum_u / sum_w)
                } else {
                    (0.0, points.velocity[v])
                }
            },
        )?;
        let points = &mut world.walls.points;
        for (v, (pressure, velocity)) in means.into_iter().enumerate() {
            points.pressure[v] = pressure;
            points.viscous_velocity[v] = velocity;
        }
        Ok(())
    }
}
