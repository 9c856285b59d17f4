//! Places of the particles at time zero.

use rayon::prelude::*;
use sph_boundary::Wall;
use sph_core::place_cells::PlaceCells;
use sph_core::{SceneProblem, Vect, comma_list};
use sph_scene::{Body, BodyParticles, Offset, Region, Scene, disturb, fill};
use sph_solver::SolverError;

/// A particle nearer to a wall than this share of a spacing is left out.
const TOO_NEAR: f64 = 0.4;

/// Positions with the number of their body, in the order of identities.
#[derive(Default)]
pub struct PlacedParticles<const D: usize> {
    pub positions: Vec<Vect<D>>,
    /// Number of the body, in the scene's order of names.
    pub body: Vec<u32>,
    pub warnings: Vec<String>,
}

/// Side of a place, as the walls see it.
enum Site<'a, const D: usize> {
    Fluid,
    TooNear,
    Behind(&'a dyn Wall<D>),
}

/// Fills all bodies and holds them against the walls.
pub fn place<const D: usize>(
    scene: &Scene,
    regions: &[Region<D>],
    walls: Option<&dyn Wall<D>>,
) -> Result<PlacedParticles<D>, SolverError> {
    let spacing = scene.numerics.spacing;
    let offset = match walls.map_or(0.0, |w| w.lattice_offset()) {
        x if x < 0.25 => Offset::None,
        _ => Offset::Half,
    };
    let filled = filled(scene, regions, offset);
    let bodies: Vec<(&String, &Body)> = scene.body.iter().collect();
    let mut placed = PlacedParticles::default();
    let mut problems = Vec::new();
    let mut numbers = vec![0; regions.len()];
    for filled in &filled {
        let (name, body) = bodies[filled.body];
        let clipped = body.needs_walls();
        let (mut kept, mut dropped, mut behind) = (Vec::new(), 0, Vec::new());
        let held = |position: &[f64; D]| {
            let x = Vect::from(*position);
            let side = match walls {
                Some(walls) if walls.clearance(&x, TOO_NEAR * spacing).is_some() => Site::TooNear,
                Some(walls) if !walls.contains(&x) => Site::Behind(walls),
                _ => Site::Fluid,
            };
            (x, side)
        };
        let all: Vec<_> = filled.positions.par_iter().map(held).collect();
        for (x, side) in all {
            match side {
                Site::Fluid => kept.push(x),
                Site::TooNear => dropped += usize::from(!clipped),
                Site::Behind(_) if clipped => behind.push(x),
                Site::Behind(walls) => {
                    problems.push(through_a_wall(name, &x, walls, spacing));
                    break;
                }
            }
        }
        if let Some(walls) = walls {
            problems.extend(facing_away(scene, name, kept.len(), &behind, walls));
        }
        let before = kept.len();
        if let Some(seed) = &body.seed {
            kept = connected(kept, &Vect::from_column_slice(seed), spacing);
        }
        if dropped > 0 {
            placed.warnings.push(format!(
                "{dropped} particles of body `{name}` were left out: nearer than {TOO_NEAR} spacings to a wall"
            ));
        }
        if kept.is_empty() && problems.is_empty() && scene.window.is_none() {
            let why = nothing_left(body, spacing, before);
            problems.push(SceneProblem::new(format!("body.{name}"), why));
        }
        numbers[filled.body] = kept.len();
        placed.body.extend(kept.iter().map(|_| filled.body as u32));
        placed.positions.extend(kept);
    }
    SolverError::refuse(problems)?;
    if let (Some(walls), Offset::Half, None) = (walls, offset, &scene.window) {
        let remarks = shares(scene, regions, walls, &numbers);
        placed.warnings.extend(remarks);
    }
    Ok(placed)
}

/// The lattices of all bodies, disturbed, within the window of a scene.
fn filled<const D: usize>(
    scene: &Scene,
    regions: &[Region<D>],
    offset: Offset,
) -> Vec<BodyParticles<D>> {
    let spacing = scene.numerics.spacing;
    let periodic = scene.numerics.periodic.bounds::<D>();
    let mut filled = fill(regions, spacing, offset, &periodic);
    let (disorder, seed) = (scene.jitter(), scene.numerics.seed);
    if disorder > 0.0 {
        disturb(&mut filled, spacing, disorder, seed, &periodic);
    }
    if let Some([low, high]) = &scene.window {
        let within = |x: &[f64; D]| (0..D).all(|k| low[k] <= x[k] && x[k] < high[k]);
        let bodies = filled.iter_mut();
        bodies.for_each(|body| body.positions.retain(within));
    }
    filled
}

fn nothing_left(body: &Body, spacing: f64, before: usize) -> String {
    match (&body.seed, body.needs_walls()) {
        (Some(_), _) => format!(
            "no particle is within a spacing of the `seed`; {before} are on the fluid's side of the walls"
        ),
        (None, true) => format!(
            "no particle is left on the fluid's side of the walls at a spacing of {spacing} m: \
             are the walls drawn with the fluid on the right side?"
        ),
        (None, false) => {
            format!("the body is too small for a single particle at a spacing of {spacing} m")
        }
    }
}

/// A body that is clipped to nothing by walls with their backs to it, or of which more is enclosed by the backs of
/// open walls than is kept.
fn facing_away<const D: usize>(
    scene: &Scene,
    body: &str,
    kept: usize,
    behind: &[Vect<D>],
    walls: &dyn Wall<D>,
) -> Option<SceneProblem> {
    if behind.len() <= kept {
        return None;
    }
    let turned = |x: &&Vect<D>| kept == 0 || walls.enclosed(x).is_some_and(|w| w < -0.5);
    let backs: Vec<&Vect<D>> = behind.par_iter().filter(turned).collect();
    let first = backs.first().filter(|_| backs.len() > kept)?;
    let name = nearest(first, walls, scene.numerics.spacing)?;
    let wall = scene.wall.get(name)?;
    let turn = match wall.polyline.is_some() || wall.file.is_some() && wall.fluid.is_none() {
        true => "`flip = true` turns it round",
        false => "its key `fluid` turns it round",
    };
    let why = format!(
        "{kept} of {} particles are on the fluid's side of the walls, and {} are behind wall `{name}`: are the \
         walls drawn with the fluid on the right side? {turn}",
        kept + behind.len(),
        backs.len()
    );
    Some(SceneProblem::new(format!("body.{body}"), why))
}

/// The nearest wall, looked for within a reach, m, and ever farther out.
fn nearest<'a, const D: usize>(x: &Vect<D>, walls: &'a dyn Wall<D>, reach: f64) -> Option<&'a str> {
    let found = (0..12).find_map(|k| walls.clearance(x, reach * f64::from(1 << k)));
    found.map(|(_, name)| name)
}

/// The particles that are joined to the seed by steps of at most 1½ spacings.
fn connected<const D: usize>(all: Vec<Vect<D>>, seed: &Vect<D>, spacing: f64) -> Vec<Vect<D>> {
    let reach = 1.5 * spacing;
    let places = all.iter().enumerate().map(|(i, x)| ((*x).into(), i));
    let cells = PlaceCells::new(reach, places);
    let around = |x: &Vect<D>| -> Vec<usize> {
        let near = cells.around((*x).into()).copied();
        near.filter(|i| (all[*i] - x).norm() <= reach).collect()
    };
    let mut reached = vec![false; all.len()];
    let mut open = around(seed);
    while let Some(i) = open.pop() {
        if !reached[i] {
            reached[i] = true;
            open.extend(around(&all[i]).into_iter().filter(|j| !reached[*j]));
        }
    }
    let kept = all.iter().zip(&reached).filter(|(_, reached)| **reached);
    kept.map(|(x, _)| *x).collect()
}

fn through_a_wall<const D: usize>(
    body: &str,
    x: &Vect<D>,
    walls: &dyn Wall<D>,
    spacing: f64,
) -> SceneProblem {
    let at = comma_list(x.iter().map(|c| format!("{c:.6}")));
    let named = nearest(x, walls, spacing);
    let wall = named.map_or(String::from("the walls"), |name| format!("wall `{name}`"));
    let side = match D {
        2 => "the fluid must be on the left of every wall's direction of travel",
        _ => "the normals of every wall must point into the fluid",
    };
    let why = format!(
        "the body reaches through {wall}: ({at}) is behind it; {side}. `clip = true` keeps \
         only what is in front of the walls"
    );
    SceneProblem::new(format!("body.{body}"), why)
}

/// A body that fills less or more than this off its space is remarked upon.
const OFF: f64 = 0.015;
/// Largest number of samples: finer lattices find the space to a smaller share of its surface.
const SAMPLES: usize = 100_000;
/// Samples per spacing, at most.
const FINEST: usize = 16;

/// Remarks on bodies whose particles do not fill their box, or the space between walls, in a scene without gravity:
/// there is no surface then that could fall or rise, and the missing volume opens as a void or lowers the pressure by
/// ρc² times its share. Walls with points of their own, which have volumes, get no remark.
pub fn shares<const D: usize>(
    scene: &Scene,
    regions: &[Region<D>],
    walls: &dyn Wall<D>,
    kept: &[usize],
) -> Vec<String> {
    let spacing = scene.numerics.spacing;
    let most = kept.iter().copied().max().unwrap_or(0).max(1);
    let finer = (SAMPLES / most) as f64;
    let finer = (finer.powf(1.0 / D as f64) as usize).min(FINEST);
    let fills = |body: &Body| body.needs_walls() || body.shape.bounds.is_some();
    let weightless = scene.numerics.gravity.iter().flatten().all(|g| *g == 0.0);
    if finer < 2 || !weightless || !scene.body.values().any(fills) {
        return Vec::new();
    }
    let step = spacing / finer as f64;
    let periodic = scene.numerics.periodic.bounds();
    let samples = fill(regions, step, Offset::Half, &periodic);
    let share = |filled: &BodyParticles<D>| {
        let inside = filled.positions.iter().map(|x| Vect::from(*x));
        let inside = inside.filter(|x| walls.contains(x)).count() as f64;
        kept[filled.body] as f64 * (finer as f64).powi(D as i32) / inside
    };
    let bodies = scene.body.iter().zip(&samples);
    let odd = bodies.filter(|((_, body), _)| fills(body) && body.seed.is_none());
    odd.map(|((name, _), filled)| (name, share(filled)))
        .filter(|(_, share)| share.is_finite() && (share - 1.0).abs() > OFF)
        .map(|(name, share)| {
            format!(
                "the particles of body `{name}` fill {:.1} % of its space between the walls: where no surface can fall, the \
                 rest opens as a void or changes the pressure by as much of \u{3c1}c\u{b2}; choose a spacing that divides the \
                 distances between walls",
                100.0 * share
            )
        })
        .collect()
}
