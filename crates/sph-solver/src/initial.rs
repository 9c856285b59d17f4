//! Particles at time zero: where they are, and in what state.

use sph_boundary::Wall;
use sph_core::{SceneProblem, Vect};
use sph_multiphase::BoundState;
use sph_probes::Solution;
use sph_scene::{Body, Offset, Pressure, Region, Scene, disturb, fill};

/// A particle nearer to a wall than this share of a spacing is left out.
const TOO_NEAR: f64 = 0.4;

/// Positions with the number of their body, in the order of identities.
pub struct Placed<const D: usize> {
    /// Positions, m.
    pub positions: Vec<Vect<D>>,
    /// Number of the body, in the scene's order of names.
    pub body: Vec<u32>,
    /// Remarks.
    pub warnings: Vec<String>,
}

/// Fills all bodies and holds them against the walls.
pub fn place<const D: usize>(
    scene: &Scene,
    walls: Option<&dyn Wall<D>>,
) -> Result<Placed<D>, Vec<SceneProblem>> {
    let spacing = scene.numerics.spacing;
    let offset = match walls.map_or(0.0, |w| w.lattice_offset()) {
        x if x < 0.25 => Offset::None,
        _ => Offset::Half,
    };
    let periodic = scene.numerics.periodic.bounds::<D>();
    let mut filled = fill(&scene.regions::<D>(), spacing, offset, &periodic);
    let n = &scene.numerics;
    if n.disorder > 0.0 {
        disturb(&mut filled, spacing, n.disorder, n.seed, &periodic);
    }
    let names: Vec<&String> = scene.body.keys().collect();
    let mut placed = Placed {
        positions: Vec::new(),
        body: Vec::new(),
        warnings: Vec::new(),
    };
    let mut problems = Vec::new();
    for body in &filled {
        let name = names[body.body];
        let mut dropped = 0;
        for position in &body.positions {
            let x = Vect::from(*position);
            if let Some(walls) = walls {
                let near = walls.clearance(&x, TOO_NEAR * spacing);
                if near.is_some() {
                    dropped += 1;
                    continue;
                }
                if !walls.contains(&x) {
                    problems.push(through_a_wall(name, &x, walls, spacing));
                    break;
                }
            }
            placed.positions.push(x);
            placed.body.push(body.body as u32);
        }
        if dropped > 0 {
            placed.warnings.push(format!(
                "{dropped} particles of body `{name}` were left out: nearer than {TOO_NEAR} spacings to a wall"
            ));
        }
        if placed.body.last() != Some(&(body.body as u32)) && problems.is_empty() {
            problems.push(SceneProblem::new(
                format!("body.{name}"),
                format!("the body is too small for a single particle at a spacing of {spacing} m"),
            ));
        }
    }
    match problems.is_empty() {
        true => Ok(placed),
        false => Err(problems),
    }
}

fn through_a_wall<const D: usize>(
    body: &str,
    x: &Vect<D>,
    walls: &dyn Wall<D>,
    spacing: f64,
) -> SceneProblem {
    let at = x
        .iter()
        .map(|c| format!("{c:.6}"))
        .collect::<Vec<_>>()
        .join(", ");
    // The nearest wall, looked for ever farther out.
    let named = (0..12).find_map(|k| walls.clearance(x, spacing * f64::from(1 << k)));
    let wall = named.map_or(String::from("the walls"), |(_, name)| {
        format!("wall `{name}`")
    });
    SceneProblem::new(
        format!("body.{body}"),
        format!(
            "the body reaches through {wall}: ({at}) is behind it; the fluid must be on the left \
             of every wall's direction of travel"
        ),
    )
}

/// Density and velocity of a body's particles at the start.
pub struct InitialState<'a, const D: usize> {
    body: &'a Body,
    law: &'a dyn BoundState,
    field: Option<&'a dyn Solution<D>>,
    gravity: Vect<D>,
    /// Height of the free surface along −gravity, m.
    surface: f64,
}

impl<'a, const D: usize> InitialState<'a, D> {
    /// The state of one body.
    pub fn new(
        scene: &Scene,
        body: &'a Body,
        law: &'a dyn BoundState,
        field: Option<&'a dyn Solution<D>>,
    ) -> Self {
        let gravity = scene.gravity::<D>();
        let top = Region::<D>::of(body).map_or(0.0, |region| {
            let (lower, upper) = region.base.bounds();
            (0..D)
                .map(|k| match gravity[k] > 0.0 {
                    true => -gravity[k] * lower[k],
                    false => -gravity[k] * upper[k],
                })
                .sum::<f64>()
                / gravity.norm().max(f64::MIN_POSITIVE)
        });
        InitialState {
            body,
            law,
            field,
            gravity,
            surface: body.surface.unwrap_or(top),
        }
    }

    /// Density, kg/m³, at a position.
    pub fn density(&self, x: &Vect<D>) -> f64 {
        let given = self.field.and_then(|f| f.pressure(x, 0.0));
        let pressure = given.unwrap_or_else(|| match self.body.pressure {
            Pressure::Zero => 0.0,
            Pressure::Hydrostatic => {
                let g = self.gravity.norm();
                let height = -self.gravity.dot(x) / g.max(f64::MIN_POSITIVE);
                self.law.reference().density * g * (self.surface - height).max(0.0)
            }
        });
        match (given, self.body.pressure) {
            (None, Pressure::Zero) => self.law.reference().density,
            // Given pressures count from that of the reference density.
            _ => self.law.density(pressure + self.background()),
        }
    }

    /// Pressure at the reference density, Pa.
    fn background(&self) -> f64 {
        let mut pressure = [0.0];
        self.law
            .pressure(&[self.law.reference().density], &mut pressure);
        pressure[0]
    }

    /// Velocity, m/s, at a position.
    pub fn velocity(&self, x: &Vect<D>) -> Vect<D> {
        let plain = || {
            self.body
                .velocity
                .as_ref()
                .map(|u| Vect::from_column_slice(u))
        };
        self.field
            .and_then(|f| f.velocity(x, 0.0))
            .or_else(plain)
            .unwrap_or_else(Vect::zeros)
    }
}
