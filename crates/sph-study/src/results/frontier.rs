//! The last value of an axis that holds with a combination of plugins.

use serde::{Deserialize, Serialize};

use crate::{Bounds, Colour, Ladder, Study, VariantResult};

/// One axis, gone along with one combination of plugins.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Frontier {
    /// Name of the axis.
    pub axis: String,
    /// Title of the axis.
    pub title: String,
    /// Name of the combination; empty if the axis has none.
    pub combination: String,
    /// Name of the scene.
    pub scene: String,
    /// References in the report; the plot shows the first.
    pub errors: Vec<String>,
    /// Bounds of green and yellow.
    pub judge: Bounds,
    /// Names of the variants, from harmless to absurd.
    pub variants: Vec<String>,
    /// Their values.
    pub values: Vec<String>,
    /// The last value that must survive.
    pub must: Option<String>,
    /// The last green value before anything that is not green.
    pub green_to: Option<String>,
    /// The last value before the first red one.
    pub holds_to: Option<String>,
    /// The first red value, with the reason.
    pub breaks_at: Option<[String; 2]>,
    /// True if nothing is red up to the value that must survive; unknown while runs are missing.
    pub met: Option<bool>,
}

impl Frontier {
    /// One for every axis and combination, in the order of the study.
    pub fn all(study: &Study, results: &[VariantResult]) -> Vec<Self> {
        let one = |chain: Vec<usize>| {
            let rung = study.variants[chain[0]].rung?;
            let found: Vec<&VariantResult> = chain.iter().map(|k| &results[*k]).collect();
            Some(Frontier::from_ladder(&study.ladders[rung.ladder], &found))
        };
        study.chains().into_iter().filter_map(one).collect()
    }

    fn from_ladder(ladder: &Ladder, found: &[&VariantResult]) -> Self {
        let colour = |v: &VariantResult| v.verdict.as_ref().map(|verdict| verdict.colour);
        // The values before the first that is not so.
        let last = |holds: &dyn Fn(Option<Colour>) -> bool| {
            let run = found.iter().take_while(|v| holds(colour(v))).count();
            run.checked_sub(1).map(|k| ladder.labels[k].clone())
        };
        let first_red = found.iter().position(|v| colour(v) == Some(Colour::Red));
        let must = ladder.must.unwrap_or(ladder.labels.len() - 1);
        let met = match first_red {
            Some(k) if k <= must => Some(false),
            _ => {
                let known = found.iter().take(must + 1).all(|v| colour(v).is_some());
                known.then_some(true)
            }
        };
        let of = |name: &str| found.first().and_then(|v| v.values.get(name)).cloned();
        Frontier {
            axis: ladder.name.clone(),
            title: ladder.title.clone(),
            combination: of("combination").unwrap_or_default(),
            scene: ladder.scene.clone(),
            errors: ladder.errors.clone(),
            judge: ladder.judge.clone(),
            variants: found.iter().map(|v| v.name.clone()).collect(),
            values: ladder.labels.clone(),
            must: ladder.must.map(|k| ladder.labels[k].clone()),
            green_to: last(&|c| c == Some(Colour::Green)),
            holds_to: last(&|c| matches!(c, Some(Colour::Green | Colour::Yellow))),
            breaks_at: first_red.map(|k| {
                let why = found[k].verdict.as_ref().map(|v| v.why.clone());
                [ladder.labels[k].clone(), why.unwrap_or_default()]
            }),
            met: ladder.must.and(met),
        }
    }

    /// The values as numbers; their order where they are none.
    pub fn places(&self) -> Vec<f64> {
        let number = |label: &String| label.split_whitespace().next()?.parse::<f64>().ok();
        let numbers: Option<Vec<f64>> = self.values.iter().map(number).collect();
        let finite = numbers.filter(|all| all.iter().all(|x| x.is_finite()));
        finite.unwrap_or_else(|| (0..self.values.len()).map(|k| k as f64).collect())
    }

    /// True if places span so much that they are drawn by their logarithms.
    pub fn is_wide(&self) -> bool {
        let places = self.places();
        let least = places.iter().copied().fold(f64::INFINITY, f64::min);
        let most = places.iter().copied().fold(0.0, f64::max);
        least > 0.0 && most / least > 30.0
    }
}
