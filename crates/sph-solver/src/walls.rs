//! From the scene's walls to those of the wall plugin.

use sph_boundary::{
    BoundaryError, Condition, Polyline, RigidMotion, Wall, WallSetup, WallSpec, thin_plate,
};
use sph_core::Vect;
use sph_kernels::Kernel;
use sph_neighbours::{Domain, WallSet};
use sph_scene::Scene;

use crate::error::SolverError;

/// Hands every named wall to the plugin; refusals point at the wall.
pub fn build_walls<const D: usize>(
    scene: &Scene,
    walls: &mut dyn Wall<D>,
    kernel: &dyn Kernel,
    domain: &Domain<D>,
    h: f64,
) -> Result<WallSet<D>, SolverError> {
    let mut specs = Vec::new();
    for (name, wall) in &scene.wall {
        let points: Vec<[f64; 2]> = wall.polyline.iter().map(|p| [p[0], p[1]]).collect();
        let refused = |e: BoundaryError| SolverError::at(format!("wall.{name}"), e.to_string());
        let polyline = match wall.thickness {
            Some(thickness) => thin_plate(name.clone(), &points, thickness).map_err(refused)?,
            None => Polyline {
                name: name.clone(),
                points,
                closed: wall.closed,
            },
        };
        let pair = |v: &Option<Vec<f64>>| v.as_ref().map_or([0.0; 2], |v| [v[0], v[1]]);
        let motion = wall
            .motion
            .as_ref()
            .map_or(RigidMotion::default(), |m| RigidMotion {
                velocity: pair(&m.velocity),
                angular_velocity: m.angular_velocity,
                centre: pair(&m.centre),
                start: m.start,
                stop: m.stop.unwrap_or(f64::INFINITY),
            });
        let surface = wall.velocity.as_ref();
        specs.push(WallSpec {
            polyline,
            condition: match wall.condition {
                sph_scene::Condition::NoSlip => Condition::NoSlip,
                sph_scene::Condition::FreeSlip => Condition::FreeSlip,
            },
            surface_velocity: surface.map_or_else(Vect::zeros, |v| Vect::from_column_slice(v)),
            motion,
        });
    }
    let setup = WallSetup {
        walls: &specs,
        spacing: scene.numerics.spacing,
        smoothing_length: h,
        kernel,
        domain,
    };
    let built = walls.build(&setup);
    built.map_err(|e| wall_problem(scene, &e))
}

/// A refused wall, pointed at if its message names one of the scene's in backquotes.
pub fn wall_problem(scene: &Scene, error: &BoundaryError) -> SolverError {
    let text = error.to_string();
    let named = scene.wall.keys().find(|n| text.contains(&format!("`{n}`")));
    let path = named.map_or("wall".to_string(), |n| format!("wall.{n}"));
    SolverError::at(path, text)
}
