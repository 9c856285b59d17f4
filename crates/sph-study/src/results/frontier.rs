//! The last value of an axis that holds with a combination of plugins.

use crate::{Colour, Frontier, Ladder, Study, VariantResult};

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
        let labels = &ladder.frontier.values;
        let colour = |v: &VariantResult| v.verdict.as_ref().map(|verdict| verdict.colour);
        // The values before the first that is not so.
        let last = |holds: &dyn Fn(Option<Colour>) -> bool| {
            let run = found.iter().take_while(|v| holds(colour(v))).count();
            run.checked_sub(1).map(|k| labels[k].clone())
        };
        let first_red = found.iter().position(|v| colour(v) == Some(Colour::Red));
        let must = ladder.must.unwrap_or(labels.len() - 1);
        let met = match first_red {
            Some(k) if k <= must => Some(false),
            _ => {
                let known = found.iter().take(must + 1).all(|v| colour(v).is_some());
                known.then_some(true)
            }
        };
        let of = |name: &str| found.first().and_then(|v| v.values.get(name)).cloned();
        Frontier {
            combination: of("combination").unwrap_or_default(),
            variants: found.iter().map(|v| v.name.clone()).collect(),
            green_to: last(&|c| c == Some(Colour::Green)),
            holds_to: last(&|c| matches!(c, Some(Colour::Green | Colour::Yellow))),
            breaks_at: first_red.map(|k| {
                let why = found[k].verdict.as_ref().map(|v| v.why.clone());
                [labels[k].clone(), why.unwrap_or_default()]
            }),
            met: ladder.must.and(met),
            ..ladder.frontier.clone()
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
