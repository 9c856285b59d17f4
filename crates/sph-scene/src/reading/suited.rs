//! Plugins, parameters and a relaxation that suit the flow of a scene, where the scene leaves them out.

use std::collections::BTreeMap;

use sph_core::{FlowNature, LawNature, LawNatures, bounds, kinds};
use toml::Table;

use crate::geometry::vector::array;
use crate::tables::body::Pressure;
use crate::{Body, Region, Relax, Scene, Wall};

/// Distance between a body and a wall or the end of a period that counts as none, over the spacing: bodies are drawn to
/// whole rows, and their walls are not.
const GAP: f64 = 1.0;

/// Largest distance of a height from half a row beyond whole rows that counts as none, over the spacing.
const OFF_HALF: f64 = 0.05;

/// Corners of a wall beyond which its box is not asked for.
const MOST: usize = 100_000;

/// The relaxation of a scene that names none.
const SUITED: Relax = Relax {
    steps: 400,
    tolerance: 0.001,
};

/// Adds the plugins, parameters and relaxation that suit the flow of a scene, where it names none; an empty table of a
/// kind stands for no plugin.
pub(crate) fn add_suited(scene: &mut Scene) {
    let nature = match scene.dimension {
        2 => nature::<2>(scene),
        _ => nature::<3>(scene),
    };
    for kind in kinds() {
        let tables = scene.plugins.get(kind.name);
        if tables.is_some_and(BTreeMap::is_empty) {
            continue;
        }
        let named = tables.and_then(|tables| tables.keys().next());
        let Some(suited) = (kind.suited)(&nature, named.map(String::as_str)) else {
            continue;
        };
        let parameters: Table = suited.parameters.parse().unwrap_or_default();
        let tables = scene.plugins.entry(kind.name).or_default();
        let given = tables.entry(suited.name.to_string()).or_default();
        let left_out = parameters.keys().any(|key| !given.contains_key(key));
        if left_out || given.is_empty() {
            scene.suited.push((kind.name, suited.reason));
        }
        for (key, value) in parameters {
            given.entry(key).or_insert(value);
        }
    }
    match &scene.numerics.relax {
        Some(given) if given.steps == 0 => scene.numerics.relax = None,
        None if nature.law == LawNature::Fluid => {
            let reason = match &nature {
                _ if rests_beside_walls(scene) => {
                    "water starts at rest under its weight beside walls"
                }
                nature if nature.confined && !nature.heavy && leaves_space(scene) => {
                    "walls that rows do not meet leave space that no volume fills"
                }
                _ => return,
            };
            scene.numerics.relax = Some(SUITED);
            scene.suited.push(("numerics.relax", reason));
        }
        _ => (),
    }
}

/// True if a body starts at rest under its weight, and none moves, between walls without open faces: rows beside a face
/// pass it.
fn rests_beside_walls(scene: &Scene) -> bool {
    let moves = |body: &Body| body.velocity.is_some() || !body.initial.is_empty();
    let rests = |body: &Body| matches!(body.pressure, Pressure::Hydrostatic);
    heavy(scene)
        && closed(scene)
        && scene.body.values().any(rests)
        && !scene.body.values().any(moves)
}

/// True if walls without open faces bound the filling of a body, and rows do not end at all of them.
fn leaves_space(scene: &Scene) -> bool {
    closed(scene) && scene.body.values().any(Body::needs_walls) && off_rows(scene)
}

/// True if a corner of a wall is off whole rows from the lowest corner.
fn off_rows(scene: &Scene) -> bool {
    let corners = corners_of_walls::<3>(scene);
    let [lower, _] = bounds(corners.iter().copied());
    let periods = scene.numerics.periodic.bounds::<3>();
    let off = |x: &[f64; 3], k: usize| {
        let rows = (x[k] - lower[k]) / scene.numerics.spacing;
        periods[k].is_none() && (rows - rows.round()).abs() > OFF_HALF
    };
    corners.iter().any(|x| (0..3).any(|k| off(x, k)))
}

/// True if there are walls, and none has an open face.
fn closed(scene: &Scene) -> bool {
    let shut = |wall: &Wall| wall.open_boundary.is_empty();
    !scene.wall.is_empty() && scene.wall.values().all(shut)
}

/// True if gravity acts, steadily or over time.
fn heavy(scene: &Scene) -> bool {
    let steady = scene.numerics.gravity.iter().flatten().any(|g| *g != 0.0);
    steady || scene.swings()
}

/// The nature of the flow, by the boxes around bodies and walls.
fn nature<const D: usize>(scene: &Scene) -> FlowNature {
    let regions = scene.regions::<D>();
    let [low, high] = bounds(regions.iter().flat_map(|region| {
        let (low, high) = region.bounds();
        [low, high]
    }));
    let corners = corners_of_walls::<D>(scene);
    let [lower, upper] = bounds(corners.iter().copied());
    let spacing = scene.numerics.spacing;
    let periods = scene.numerics.periodic.bounds::<D>();
    let meets = |a: f64, b: f64| (a - b).abs() <= GAP * spacing;
    let both = |k: usize| meets(low[k], lower[k]) && meets(high[k], upper[k]);
    let spans = |k: usize| periods[k].is_some() || both(k);
    let half = |x: f64, k: usize| {
        let rows = (x - lower[k]) / spacing;
        let at_half = (rows - rows.floor() - 0.5).abs() < OFF_HALF;
        let free = !meets(x, lower[k]) && !meets(x, upper[k]);
        lower[k].is_finite() && periods[k].is_none() && free && at_half
    };
    let drawn_to_half_rows = |body: &Body| {
        let flat = body.shape.bounds.is_some() || body.shape.polygon.is_some();
        let region = Region::<D>::from_body(body).filter(|_| flat);
        region.is_some_and(|region| {
            let (low, high) = region.bounds();
            (0..D).any(|k| half(low[k], k) || half(high[k], k))
        })
    };
    let along = |k: usize| {
        periods[k].is_some_and(|[from, to]| {
            let at_end = |x: &[f64; D]| meets(x[k], from) || meets(x[k], to);
            corners.iter().all(at_end)
        })
    };
    let filled = scene.body.values().any(|body| body.fill.is_some());
    let bounded = scene.body.values().any(|body| body.shape.bounds.is_some());
    let stirred = scene.choice("eddy-viscosity").is_some();
    let all_known = scene.wall.values().all(|wall| known(wall, spacing));
    let laws = scene.phase.keys().map(|phase| law(scene, phase));
    FlowNature {
        confined: if filled { !bounded } else { (0..D).all(spans) },
        parallel: all_known && !stirred && !corners.is_empty() && (0..D).any(along),
        open: (scene.wall.values()).any(|w| !w.mover.is_empty() || !w.open_boundary.is_empty()),
        heavy: heavy(scene),
        half_rows: scene.body.values().any(drawn_to_half_rows),
        phases: scene.phase.len(),
        law: laws.max().unwrap_or_default(),
    }
}

fn law(scene: &Scene, phase: &str) -> LawNature {
    let known = scene.choice_in("rheology", phase).and_then(|choice| {
        let mut all = inventory::iter::<LawNatures>.into_iter();
        all.find_map(|natures| (natures.0)(&choice.name, &choice.table))
    });
    known.unwrap_or_default()
}

/// True if the box around a wall is cheap to know.
fn known(wall: &Wall, spacing: f64) -> bool {
    wall.file.is_none() && wall.declared(spacing) <= MOST
}

/// Corners of all walls whose box is known, m, those in the plane at z = 0.
fn corners_of_walls<const D: usize>(scene: &Scene) -> Vec<[f64; D]> {
    let spacing = scene.numerics.spacing;
    let all = scene.wall.values().filter(|wall| known(wall, spacing));
    let corners = |wall: &Wall| -> Vec<[f64; D]> {
        if scene.dimension == 3 {
            let facets = wall.facets("", spacing).unwrap_or_default();
            return facets.points.iter().map(|x| array(x)).collect();
        }
        let lines = wall.lines("", spacing).unwrap_or_default();
        let points = lines.iter().flat_map(|line| &line.points);
        points.map(|x| array(x)).collect()
    };
    all.flat_map(corners).collect()
}
