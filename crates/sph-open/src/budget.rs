//! Mass that has passed, for the summary.

use std::ops::Range;

use serde_json::{Value as Json, json};

use crate::faces::Faces;

/// Time over which a port keeps an error of its mass, over the time in which a row passes.
///
/// The flux of the law and that of the particles differ by the smoothing of the mean before the face; the difference is
/// let go instead of gathering at the port.
const ROWS: f64 = 5.0;

/// Largest difference between the passed and the requested volume without a warning, over the latter.
const BORNE: f64 = 0.005;

impl<const D: usize> Faces<D> {
    /// Ports grow by the inflow and fade by the outflow in `dt` seconds.
    ///
    /// Through an element that has fluid before a part of it, this part passes. A port is to hold what the row before it
    /// [lacks](crate::faces::as_share); what it has beyond that goes with what passes, and all of it where the fluid has gone.
    pub fn pass(&mut self, dt: f64) {
        let phases = self.whole.len();
        for k in 0..self.elements.len() {
            let place = self.places[k];
            let normal = self.through(k).dot(&place.normal);
            let face = self.face_of[k];
            let filled = self.inside[k].filled;
            let wetted = place.measure
                * match self.outside[k].share {
                    Some(share) if normal > 0.0 || share >= 1.0 => share,
                    Some(share) => share.min(filled),
                    None => filled,
                };
            let faded = (normal.abs() * dt / (ROWS * self.spacing)).min(1.0);
            let lacking = self.lacking[k] * place.measure * self.spacing;
            let dry = !self.inside[k].wet && self.faces[face].law.lets_out();
            let mut volume = 0.0;
            if normal > 0.0 {
                let q = self.phase(k);
                let mass = self.density(k, q) * normal * wetted * dt;
                volume = mass / self.at_rest(q);
                self.memory.mass[k * phases + q] += mass;
                self.memory.totals[face * phases + q].entered.add(mass);
            } else if normal < 0.0 || dry {
                for q in 0..phases {
                    let (part, density) = (self.looked[k].mix[q], self.density(k, q));
                    let port = &mut self.memory.mass[k * phases + q];
                    let error = *port - density * lacking * part;
                    let mass = match normal < 0.0 {
                        true => density * -normal * wetted * dt * part + error * faded,
                        false => *port,
                    };
                    *port -= mass;
                    volume -= mass / self.at_rest(q);
                    self.memory.totals[face * phases + q].left.add(mass);
                }
            }
            self.memory.volumes[face].passed.add(volume);
        }
    }

    /// Reference density of a phase, kg/m³.
    fn at_rest(&self, phase: usize) -> f64 {
        self.laws[phase].reference().density
    }

    /// Counts the volumes that the laws request in `dt` seconds up to a `time`, and notes when faces are dry first.
    pub fn ask(&mut self, time: f64, dt: f64) {
        for f in 0..self.faces.len() {
            let dry = self.is_dry(self.faces[f].elements.clone());
            let volumes = &mut self.memory.volumes[f];
            volumes.asked.add(self.asked[f].unwrap_or(0.0) * dt);
            if dry && volumes.dry.is_none() {
                volumes.dry = Some(time);
            }
        }
    }

    fn is_dry(&self, mut own: Range<usize>) -> bool {
        own.all(|k| !self.inside[k].wet)
    }

    /// By face and phase: mass that entered, left and is held, kg; and the error entered − left − (born − died) − held,
    /// which is rounding. By face where its law requests a volume: this and the passed volume, m³ at the reference
    /// density.
    pub fn budget(&self, phases: &[String]) -> Json {
        let count = self.whole.len();
        let mut all = serde_json::Map::new();
        let mut whole = [0.0; 2];
        for (f, face) in self.faces.iter().enumerate() {
            for (q, phase) in phases.iter().enumerate() {
                let totals = &self.memory.totals[f * count + q];
                let (entered, left) = (totals.entered.value(), totals.left.value());
                let (born, died) = (totals.born.value(), totals.died.value());
                if entered == 0.0 && left == 0.0 && born == 0.0 && died == 0.0 {
                    continue;
                }
                let held = self.held(face, q);
                let missing = entered - left - (born - died) - held;
                whole[0] += missing;
                whole[1] += entered + left.abs();
                all.insert(
                    format!("{}.{phase}", face.name),
                    json!({
                        "entered": entered, "left": left, "held": held, "born": born, "died": died,
                    }),
                );
            }
            let asked = self.asked.get(f).is_some_and(Option::is_some);
            if let Some(volumes) = self.memory.volumes.get(f).filter(|_| asked) {
                let [asked, passed] = volumes.volumes();
                let volumes = json!({ "asked_volume": asked, "passed_volume": passed });
                all.insert(face.name.clone(), volumes);
            }
        }
        let unbalanced = match whole[1] > 0.0 {
            true => whole[0].abs() / whole[1],
            false => 0.0,
        };
        all.insert("unbalanced".into(), json!(unbalanced));
        Json::Object(all)
    }

    /// Faces that have let pass another volume than they request, and those that request none and are dry at the end.
    pub fn differences(&self) -> Vec<String> {
        let faces = 0..self.faces.len();
        faces.filter_map(|f| self.difference(f)).collect()
    }

    fn difference(&self, f: usize) -> Option<String> {
        // Without an evaluation of the faces there are none.
        let (name, volumes) = (&self.faces[f].name, self.memory.volumes.get(f)?);
        let first = volumes.dry.map(|time| format!("first at {time:.3} s"));
        if self.asked.get(f)?.is_none() {
            let first = first.filter(|_| self.is_dry(self.faces[f].elements.clone()))?;
            return Some(format!(
                "`{name}` is dry, {first}: nothing passes where no fluid is before a face"
            ));
        }
        let [asked, passed] = volumes.volumes();
        let more = passed / asked - 1.0;
        if more.is_nan() || more.abs() <= BORNE {
            return None;
        }
        let unit = ["m²", "m³"][D - 2];
        let than = if more > 0.0 { "more" } else { "less" };
        let why = match first {
            Some(first) => format!("no fluid was before it, {first}"),
            None => "the particles before it went otherwise".into(),
        };
        let [passed, asked, share] = [passed, asked, 100.0 * more].map(f64::abs);
        Some(format!(
            "`{name}` has let pass {passed:.4} {unit} for the {asked:.4} {unit} that it asks for, {share:.1} % {than}: {why}"
        ))
    }
}
