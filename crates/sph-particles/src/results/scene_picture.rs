//! A picture of a scene before any run.

use std::path::Path;

use sph_core::{Vect, fields, parse_quantity};
use sph_io::{Colour, Picture, View};
use sph_scene::Scene;
use sph_solver::Flow;
use toml::{Table, Value};

use crate::failure::error::Result;
use crate::running::pieces::{drawn_walls, padded, points};
use crate::setup::{Assembled, assemble, box_around, corner};

const NORMAL: Colour = Colour([0x7a, 0x7a, 0x7a]);
const OPEN: Colour = Colour([0x1b, 0x9e, 0x3c]);
const PROBE: Colour = Colour([0xb0, 0x10, 0xb0]);
const WRONG: Colour = Colour([0xd0, 0x02, 0x1b]);

/// Most ticks that show on which side of the walls the fluid is.
const TICKS: usize = 160;
/// Length of ticks and half the width of crosses over the spacing, and over the width of the scene at least.
const LENGTH: f64 = 1.5;
const SHARE: f64 = 0.008;
/// Largest distance of a shown line from the scene, over the width of the scene.
const FAR: f64 = 0.25;

/// Draws walls with ticks to the fluid's side, particles by their phases, open faces, outlets, probes, and ends of walls that
/// are warned of.
///
/// # Errors
/// As [`assemble`]; a file that cannot be written.
pub fn draw_scene(scene: &Scene, path: &Path) -> Result<()> {
    match scene.dimension {
        3 => draw::<3>(scene, path),
        _ => draw::<2>(scene, path),
    }
}

type Line = (Vec<[f64; 3]>, Colour);

/// Lines and texts over particles and walls.
struct Notes<const D: usize> {
    lines: Vec<Line>,
    texts: Vec<([f64; 3], String)>,
    /// Corners of the box around particles, walls and their surroundings, m.
    low: Vect<D>,
    high: Vect<D>,
    /// Length of ticks, m.
    tick: f64,
}

fn draw<const D: usize>(scene: &Scene, path: &Path) -> Result<()> {
    let parts = assemble::<D>(scene)?;
    let flow = &parts.flow;
    let places = points(flow)?;
    let values: Vec<f64> = match flow.world.free.get(fields::PHASE) {
        Ok(phase) => phase.iter().map(|p| f64::from(*p)).collect(),
        Err(_) => vec![0.0; places.len()],
    };
    let mut notes = Notes::around(flow)?;
    notes.walls(scene, flow);
    notes.bodies(scene, &parts)?;
    notes.outlets(scene);
    for (name, table) in scene.probe.iter().chain(&scene.gauge) {
        notes.probe(name, table);
    }
    for place in parts.leaks.iter().flat_map(|leak| &leak.places) {
        notes.cross(place, 2.0, WRONG);
    }
    let classes: Vec<String> = scene.phase.keys().cloned().collect();
    let walls = drawn_walls(&flow.world);
    let margin = 0.02 * (notes.high - notes.low).max();
    let window = [0, 1].map(|k| [notes.low[k] - margin, notes.high[k] + margin]);
    let picture = Picture {
        title: &scene.title,
        time: Some(0.0),
        diameter: flow.world.spacing,
        walls: &walls,
        strokes: &notes.lines,
        labels: &notes.texts,
        classes: &classes,
        window: (D == 2).then_some(window),
        view: if D == 2 { View::Plane } else { View::Above },
        ..Picture::new(&places, &values)
    };
    Ok(picture.save(path)?)
}

impl<const D: usize> Notes<D> {
    fn around(flow: &Flow<D>) -> Result<Self> {
        let particles = flow.world.free.get(fields::POSITION)?;
        let [low, high] = box_around(particles.iter().chain(&flow.world.walls.points.position));
        let wide = (high - low).max();
        Ok(Notes {
            lines: Vec::new(),
            texts: Vec::new(),
            low,
            high,
            tick: (LENGTH * flow.world.spacing).max(SHARE * wide),
        })
    }

    fn text(&mut self, at: &Vect<D>, text: &str) {
        self.texts.push((padded(at), text.to_string()));
    }

    /// A line. The picture shows it unless it leads far away from particles and walls.
    fn line(&mut self, points: &[Vect<D>], colour: Colour) {
        let far = FAR * (self.high - self.low).max();
        let [lower, upper] = [self.low.add_scalar(-far), self.high.add_scalar(far)];
        let beside = |x: &&Vect<D>| (0..D).all(|k| lower[k] < x[k] && x[k] < upper[k]);
        for x in points.iter().filter(beside) {
            (self.low, self.high) = (self.low.inf(x), self.high.sup(x));
        }
        let line = points.iter().map(padded).collect();
        self.lines.push((line, colour));
    }

    fn cross(&mut self, at: &Vect<D>, size: f64, colour: Colour) {
        let arm = |x: f64, up: f64| {
            let mut arm = Vect::<D>::zeros();
            (arm[0], arm[D - 1]) = (x, up);
            0.5 * size * self.tick * arm
        };
        for arm in [arm(1.0, 1.0), arm(1.0, -1.0)] {
            self.line(&[at - arm, at + arm], colour);
        }
    }

    /// The edges of a box.
    fn frame(&mut self, low: &Vect<D>, high: &Vect<D>, colour: Colour) {
        let corner = |n: usize| corner(low, high, n);
        for n in 0..1usize << D {
            for k in (0..D).filter(|k| n >> k & 1 == 0) {
                self.line(&[corner(n), corner(n | 1 << k)], colour);
            }
        }
    }

    /// Ticks into the fluid, open faces, and every wall's name at its middle.
    fn walls(&mut self, scene: &Scene, flow: &Flow<D>) {
        let elements = &flow.world.walls.elements;
        let open = |k: usize| elements.open.get(k).is_some_and(|open| *open);
        let every = elements.centre.len().div_ceil(TICKS).max(1);
        for (k, centre) in elements.centre.iter().enumerate() {
            if open(k) && D == 2 {
                let points = &flow.world.walls.points.position;
                self.line(&elements.corners[k].map(|c| points[c as usize]), OPEN);
            }
            if k % every == 0 {
                let colour = if open(k) { OPEN } else { NORMAL };
                self.line(&[*centre, centre + self.tick * elements.normal[k]], colour);
            }
        }
        for (number, name) in scene.wall.keys().enumerate() {
            let own = (0..elements.centre.len()).filter(|k| elements.wall[*k] as usize == number);
            let own: Vec<usize> = own.collect();
            if let Some(middle) = own.get(own.len() / 2) {
                let what = if open(*middle) { " (open)" } else { "" };
                let at = elements.centre[*middle] + self.tick * elements.normal[*middle];
                self.text(&at, &format!("wall {name}{what}"));
            }
        }
    }

    /// Every body's name in its middle.
    fn bodies(&mut self, scene: &Scene, parts: &Assembled<D>) -> Result<()> {
        let places = parts.flow.world.free.get(fields::POSITION)?;
        for (number, name) in scene.body.keys().enumerate() {
            let of = places.iter().zip(&parts.body_of);
            let own = || of.clone().filter(|(_, b)| **b as usize == number);
            let count = own().count();
            if count > 0 {
                let middle = own().map(|(x, _)| x).sum::<Vect<D>>() / count as f64;
                self.text(&middle, &format!("body {name}"));
            }
        }
        Ok(())
    }

    fn outlets(&mut self, scene: &Scene) {
        for (name, outlet) in &scene.outlet {
            let (mut low, mut high) = (self.low, self.high);
            if let Some([lo, hi]) = &outlet.bounds {
                (low, high) = (Vect::from_column_slice(lo), Vect::from_column_slice(hi));
            } else if let Some(plane) = outlet.beyond {
                let axis = outlet.axis.map_or(0, |axis| axis as usize).min(D - 1);
                (low[axis], high[axis]) = (plane, plane);
            }
            self.frame(&low, &high, OPEN);
            self.text(&high, &format!("outlet {name}"));
        }
    }

    /// Parts of a probe that have a place: a point, a line, a box, a gauge that stands upright.
    fn probe(&mut self, name: &str, table: &Table) {
        let list = |key: &str| table.get(key).and_then(lengths);
        let point = |x: Vec<f64>| (x.len() == D).then(|| Vect::<D>::from_column_slice(&x));
        let place = |key: &str| list(key).and_then(point);
        let is = |kind: &str| table.get("kind").and_then(Value::as_str) == Some(kind);
        if let Some(at) = place("at").filter(|_| !is("reflection")) {
            self.cross(&at, 1.2, PROBE);
            self.text(&at, name);
        } else if let Some(at) = list("at") {
            // Gauges beside each other, or one over a place of the ground.
            let feet: Vec<Vec<f64>> = match is("reflection") {
                true => at.iter().map(|x| vec![*x]).collect(),
                false => vec![at],
            };
            for foot in feet.iter().filter(|foot| foot.len() < D) {
                let (mut low, mut high) = (0.5 * (self.low + self.high), self.high);
                low[D - 1] = self.low[D - 1];
                high = Vect::from_fn(|k, _| if k + 1 == D { high[k] } else { low[k] });
                for (k, x) in foot.iter().enumerate() {
                    (low[k], high[k]) = (*x, *x);
                }
                self.line(&[low, high], PROBE);
                self.text(&high, name);
            }
        }
        if let Some((from, to)) = place("from").zip(place("to")) {
            self.line(&[from, to], PROBE);
            self.text(&(0.5 * (from + to)), name);
        }
        let corners = |key: &str| {
            let [low, high] = table.get(key)?.as_array()?.as_slice() else {
                return None;
            };
            Some((point(lengths(low)?)?, point(lengths(high)?)?))
        };
        if let Some((low, high)) = corners("box").or_else(|| corners("within")) {
            self.frame(&low, &high, PROBE);
            self.text(&high, name);
        }
    }
}

/// Lengths in m, with or without a unit.
fn lengths(value: &Value) -> Option<Vec<f64>> {
    let one = |value: &Value| match value {
        Value::Float(x) => Some(*x),
        Value::Integer(n) => Some(*n as f64),
        Value::String(text) => parse_quantity(text, "m").ok(),
        _ => None,
    };
    value.as_array()?.iter().map(one).collect()
}
