//! What has passed, for the summary.

use serde_json::{Value as Json, json};

use crate::faces::Faces;

impl<const D: usize> Faces<D> {
    /// By face and phase: mass that entered, left and is held, kg; and what is missing of entered − left − (born − died) −
    /// held, which is rounding.
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
                let masses = face
                    .elements
                    .clone()
                    .map(|k| self.memory.mass[k * count + q]);
                let held: f64 = masses.sum();
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
        }
        let unbalanced = if whole[1] > 0.0 {
            whole[0].abs() / whole[1]
        } else {
            0.0
        };
        all.insert("unbalanced".into(), json!(unbalanced));
        Json::Object(all)
    }
}
