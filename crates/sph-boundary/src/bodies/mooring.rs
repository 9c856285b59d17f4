//! Lines between a body and a place that stays: moorings, their force and stiffness.

use nalgebra::{Matrix6, Vector3, Vector6};
use sph_core::parameters;

use crate::bodies::catenary::Catenary;
use crate::bodies::spatial_vector::{padded, six};
use crate::{Drawing, MoverRefusal, MoverSetting};

/// A line from a fixed place to a place of the body. It pulls with k (l − l₀) + c l̇ ≥ 0, and never pushes.
///
/// With a `weight` it is a chain that hangs in a catenary, always at rest: k is then EA/l₀, and the rest of its length
/// lies on the bed at the height of its fixed end (Irvine 1981; Jonkman 2007).
///
/// ```toml
/// [[wall.buoy.mover.rigid-body.line]]
/// from = [0.2, 0.0]
/// to = [0.5, 0.35]
/// stiffness = "2 kN/m"
/// ```
#[parameters]
pub struct Line {
    /// The place that stays, m.
    #[parameter(unit: "m")]
    pub from: Vec<f64>,
    /// The place of the body, where it is drawn, m.
    #[parameter(unit: "m")]
    pub to: Vec<f64>,
    /// Stiffness k of the whole line, N/m (per metre of depth in two dimensions); EA/l₀ of one with a weight.
    #[parameter(unit: "N/m", above: 0.0)]
    pub stiffness: f64,
    /// Damping c, N s/m (per metre of depth in two dimensions); none with a weight.
    #[parameter(default, unit: "N s/m", min: 0.0)]
    pub damping: f64,
    /// Length l₀ without tension, m; as drawn if left out. One with a weight needs it.
    #[parameter(unit: "m", above: 0.0)]
    pub length: Option<f64>,
    /// Weight in the fluid per length, N/m (and per metre of depth in two dimensions): the line hangs.
    #[parameter(unit: "N/m", above: 0.0)]
    pub weight: Option<f64>,
    /// True if a line with a weight may lie on a bed at the height of its fixed end; yes if left out.
    pub bed: Option<bool>,
}

impl Line {
    pub(crate) fn drawn_length(&self) -> f64 {
        (padded(&self.to) - padded(&self.from)).norm()
    }
}

/// True if a straight way goes through a wall; its ends may lie on one.
pub(crate) fn crosses(from: Vector3<f64>, to: Vector3<f64>, wall: &Drawing) -> bool {
    let inner = |s: f64| (1e-9..=1.0 - 1e-9).contains(&s);
    match wall {
        Drawing::Line(line) => line.edges().any(|[a, b]| {
            let [a, b] = [a, b].map(|p| Vector3::new(p[0], p[1], 0.0));
            let (way, edge) = (to - from, b - a);
            let across = way.cross(&edge).z;
            let s = (a - from).cross(&edge).z / across;
            let t = (a - from).cross(&way).z / across;
            inner(s) && (0.0..=1.0).contains(&t)
        }),
        Drawing::Surface(surface) => surface.triangles.iter().any(|triangle| {
            let [a, b, c] = triangle.map(|k| Vector3::from(surface.points[k as usize]));
            let normal = (b - a).cross(&(c - a));
            let s = normal.dot(&(a - from)) / normal.dot(&(to - from));
            let x = from + (to - from) * s;
            let left_of =
                |(p, q): (Vector3<f64>, Vector3<f64>)| normal.dot(&(q - p).cross(&(x - p))) >= 0.0;
            inner(s) && [(a, b), (b, c), (c, a)].into_iter().all(left_of)
        }),
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Mooring {
    from: Vector3<f64>,
    /// Its place of the body, where it is drawn.
    pub to: Vector3<f64>,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Stiffness, damping, length without tension.
    Straight(f64, f64, f64),
    /// With the unit vector upwards.
    Hanging(Catenary, Vector3<f64>),
}

/// Action of a line at a place and velocity of its body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pull {
    /// Force on the body and its moment about the centre.
    pub force: Vector6<f64>,
    /// Minus its derivative with respect to the place.
    pub stiffness: Matrix6<f64>,
    /// Minus its derivative with respect to the velocity.
    pub damping: Matrix6<f64>,
    /// Tension at the anchor, N.
    pub anchor: f64,
}

/// Pieces of the curve that is held against walls before the start.
const PIECES: usize = 64;

impl Mooring {
    /// Number `k` of the lines of a body, in its scene.
    ///
    /// # Errors
    /// The key that does not fit: ends of another dimension, no length, too short or slack without weight, through a wall.
    pub fn new<const D: usize>(
        line: &Line,
        k: usize,
        setting: &MoverSetting<'_, D>,
    ) -> Result<Self, MoverRefusal> {
        let refusal =
            |key: &str, why: String| MoverRefusal::at_key(format!("line[{k}].{key}"), why);
        for (key, place) in [("from", &line.from), ("to", &line.to)] {
            if place.len() != D {
                let why = format!("{} numbers, {D} are expected", place.len());
                return Err(refusal(key, why));
            }
        }
        let drawn = line.drawn_length();
        if drawn <= 0.0 {
            let why = "the line has no length: both ends are one place";
            return Err(refusal("to", why.into()));
        }
        let kind = match line.weight {
            Some(weight) => Self::hanging(line, weight, setting),
            None if line.bed.is_some() => Err((
                "bed",
                "a line without `weight` is straight: it needs no bed".into(),
            )),
            None => {
                let free = line.length.unwrap_or(drawn);
                Ok(Kind::Straight(line.stiffness, line.damping, free))
            }
        };
        let kind = kind.map_err(|(key, why)| refusal(key, why))?;
        let [from, to] = [&line.from, &line.to].map(|place| padded(place));
        let mooring = Mooring { from, to, kind };
        let places = mooring.drawn_places();
        for wall in setting.others() {
            if places.windows(2).any(|w| crosses(w[0], w[1], wall)) {
                let why = format!("the line goes through the wall `{}`", wall.name());
                return Err(refusal("to", why));
            }
        }
        Ok(mooring)
    }

    #[cfg(test)]
    pub fn chain(from: Vector3<f64>, to: Vector3<f64>, chain: Catenary, up: Vector3<f64>) -> Self {
        let kind = Kind::Hanging(chain, up);
        Mooring { from, to, kind }
    }

    fn hanging<const D: usize>(
        line: &Line,
        weight: f64,
        setting: &MoverSetting<'_, D>,
    ) -> Result<Kind, (&'static str, String)> {
        let gravity = padded(setting.gravity.as_slice());
        if gravity.norm() <= 0.0 {
            let why =
                "nothing weighs anything here: give `numerics.gravity`, or leave `weight` out";
            return Err(("weight", why.into()));
        }
        if line.damping > 0.0 {
            let why = "a line with a `weight` is always at rest: it has no damping";
            return Err(("damping", why.into()));
        }
        let up = -gravity.normalize();
        let drawn = line.drawn_length();
        let Some(length) = line.length else {
            let why = format!(
                "a line with a `weight` needs its `length`: more than {drawn:.4} m, from end to end"
            );
            return Err(("weight", why));
        };
        if length <= drawn {
            let why = format!("the line is too short to hang: its ends are {drawn:.4} m apart");
            return Err(("length", why));
        }
        let bed = line.bed.unwrap_or(true);
        let rise = (padded(&line.to) - padded(&line.from)).dot(&up);
        if bed && rise < 0.0 {
            let why = "the end at the body is below the bed at the fixed end: give `bed = false` if there is none";
            return Err(("to", why.into()));
        }
        let catenary = Catenary {
            weight,
            axial: line.stiffness * length,
            length,
            bed,
        };
        Ok(Kind::Hanging(catenary, up))
    }

    fn drawn_places(&self) -> Vec<Vector3<f64>> {
        match &self.kind {
            Kind::Straight(..) => vec![self.from, self.to],
            Kind::Hanging(catenary, up) => {
                let (across, [x, z]) = split(self.to - self.from, up);
                let hang = catenary.hang(x, z);
                let shape = catenary.shape(&hang, x, PIECES).into_iter();
                let places = shape.map(|[x, z]| self.from + across * x + up * z);
                let mut places: Vec<_> = places.collect();
                // Rounding must not move the end from a wall on which it lies.
                if let Some(last) = places.last_mut() {
                    *last = self.to;
                }
                places
            }
        }
    }

    /// None while it is slack. `end` is where its place of the body is, `arm` the way there from the centre.
    pub fn pull(
        &self,
        end: Vector3<f64>,
        arm: Vector3<f64>,
        velocity: &Vector6<f64>,
    ) -> Option<Pull> {
        let way = end - self.from;
        let along = |e: Vector3<f64>| six(e, arm.cross(&e));
        match &self.kind {
            Kind::Straight(stiffness, damping, free) => {
                let length = way.norm();
                let stretch = length - free;
                if length <= 0.0 || stretch <= 0.0 {
                    return None;
                }
                let e = along(way / length);
                let tension = stiffness * stretch + damping * e.dot(velocity);
                (tension > 0.0).then(|| Pull {
                    force: -e * tension,
                    stiffness: e * e.transpose() * *stiffness,
                    damping: e * e.transpose() * *damping,
                    anchor: tension,
                })
            }
            Kind::Hanging(catenary, up) => {
                let (across, [x, z]) = split(way, up);
                let hang = catenary.hang(x, z);
                let [e, f, g] = [across, *up, up.cross(&across)].map(along);
                let [[a, b], [_, d]] = hang.stiffness;
                // Beside its plane it is a pendulum: H/x.
                let beside = if x > 0.0 { hang.across / x } else { 0.0 };
                Some(Pull {
                    force: -(e * hang.across + f * hang.up),
                    stiffness: e * e.transpose() * a
                        + (e * f.transpose() + f * e.transpose()) * b
                        + f * f.transpose() * d
                        + g * g.transpose() * beside,
                    damping: Matrix6::zeros(),
                    anchor: hang.across.hypot(catenary.at_anchor(hang.up)),
                })
            }
        }
    }
}

/// The horizontal direction of a way, and how far it leads across and up.
fn split(way: Vector3<f64>, up: &Vector3<f64>) -> (Vector3<f64>, [f64; 2]) {
    let z = way.dot(up);
    let level = way - up * z;
    let x = level.norm();
    let across = if x > 0.0 { level / x } else { level };
    (across, [x, z])
}

#[cfg(test)]
mod tests;
