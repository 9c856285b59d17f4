//! Changes between two studies.

use std::path::Path;

use serde::Serialize;
use sph_core::number;

use crate::Results;

/// The difference of two studies, variant by variant.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Other differences: studies, machines, versions, threads.
    pub notes: Vec<String>,
    pub variants: Vec<Change>,
    pub only_in_first: Vec<String>,
    pub only_in_second: Vec<String>,
    /// Geometric mean of the ratios of wall seconds, second over first.
    pub wall_ratio: Option<f64>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Change {
    pub name: String,
    pub status: [String; 2],
    /// Name of an error with its values and their ratio.
    pub errors: Vec<(String, Pair)>,
    pub wall_seconds: Pair,
    pub steps: Pair,
}

/// Two numbers and the second over the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Pair {
    pub first: Option<f64>,
    pub second: Option<f64>,
    pub ratio: Option<f64>,
}

impl Pair {
    fn new(first: Option<f64>, second: Option<f64>) -> Self {
        let ratio = first.zip(second).map(|(a, b)| b / a);
        Pair {
            first,
            second,
            ratio: ratio.filter(|r| r.is_finite()),
        }
    }

    fn text(&self) -> String {
        let one = |x: Option<f64>| x.map_or("–".to_string(), number::plain);
        if self.first == self.second {
            return one(self.first);
        }
        let ratio = self.ratio.map_or(String::new(), |r| format!("  ×{r:.3}"));
        format!("{} → {}{ratio}", one(self.first), one(self.second))
    }
}

/// Longest `study.json`, bytes.
const LONGEST: u64 = 512 << 20;

impl Results {
    /// Reads a `study.json`.
    ///
    /// # Errors
    /// In words, if the file cannot be read or is none.
    pub fn load(path: &Path) -> Result<Self, String> {
        let shown = path.display();
        sph_io::readable(path, LONGEST).map_err(|e| e.to_string())?;
        let text = std::fs::read_to_string(path);
        let text = text.map_err(|e| format!("cannot read `{shown}`: {e}"))?;
        serde_json::from_str(&text).map_err(|e| format!("`{shown}` is no study.json: {e}"))
    }
}

/// Compares two studies by the names of their variants.
pub fn compare(first: &Results, second: &Results) -> Comparison {
    let change = |a: &crate::VariantResult| {
        let b = second.variant(&a.name)?;
        let error = |name: &String| (name.clone(), Pair::new(a.error(name), b.error(name)));
        Some(Change {
            name: a.name.clone(),
            status: [a.status, b.status].map(|s| s.name().to_string()),
            errors: first.errors.iter().map(error).collect(),
            wall_seconds: Pair::new(a.wall_seconds.min, b.wall_seconds.min),
            steps: Pair::new(Some(a.size.steps as f64), Some(b.size.steps as f64)),
        })
    };
    let variants: Vec<Change> = first.variants.iter().filter_map(change).collect();
    let missing = |from: &Results, other: &Results| {
        let names = from.variants.iter().map(|v| v.name.clone());
        names.filter(|n| other.variant(n).is_none()).collect()
    };
    let ratios = variants.iter().filter_map(|v| v.wall_seconds.ratio);
    let logs: Vec<f64> = ratios.map(f64::ln).filter(|l| l.is_finite()).collect();
    let mean = logs.iter().sum::<f64>() / logs.len() as f64;
    Comparison {
        notes: notes(first, second),
        only_in_first: missing(first, second),
        only_in_second: missing(second, first),
        wall_ratio: (!logs.is_empty()).then(|| mean.exp()),
        variants,
    }
}

fn notes(first: &Results, second: &Results) -> Vec<String> {
    let facts = |r: &Results| {
        let (origin, machine) = (&r.origin, "machine, so that times cannot be compared");
        let manner = if r.serial {
            "one by one"
        } else {
            "side by side"
        };
        [
            ("study", r.study.clone()),
            ("scene", r.scene.clone()),
            ("version", origin.version.clone()),
            ("commit", origin.commit.clone().unwrap_or("unknown".into())),
            ("built with", origin.built_with.clone()),
            (machine, origin.machine.to_string()),
            ("threads", r.threads()),
            ("variants ran", manner.into()),
        ]
    };
    let both = facts(first).into_iter().zip(facts(second));
    let differing = both.filter(|(a, b)| a != b);
    let notes = differing.map(|((what, a), (_, b))| format!("{what}: {a} → {b}"));
    notes.collect()
}

impl Comparison {
    /// One row per variant, the first one being the heads of the columns.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let mut heads = vec!["variant".to_string()];
        let errors = self.variants.first().map_or(&[][..], |v| &v.errors[..]);
        heads.extend(errors.iter().map(|(name, _)| name.clone()));
        heads.extend(["wall seconds", "steps", "status"].map(String::from));
        let mut rows = vec![heads];
        for v in &self.variants {
            let mut row = vec![v.name.clone()];
            row.extend(v.errors.iter().map(|(_, pair)| pair.text()));
            row.push(v.wall_seconds.text());
            row.push(v.steps.text());
            row.push(match v.status[0] == v.status[1] {
                true => v.status[0].clone(),
                false => v.status.join(" → "),
            });
            rows.push(row);
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_have_ratios_where_there_are_two_numbers() {
        let pair = Pair::new(Some(2.0), Some(1.0));
        assert_eq!((pair.ratio, &*pair.text()), (Some(0.5), "2 → 1  ×0.500"));
        assert_eq!(Pair::new(Some(2.0), Some(2.0)).text(), "2");
        assert_eq!(Pair::new(None, Some(2.0)).text(), "– → 2");
        assert_eq!(Pair::new(Some(0.0), Some(2.0)).ratio, None);
    }
}
