//! Results of variants: series that differ in their refinement only, orders of convergence, frontiers, and the best.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{
    Bounds, Colour, Cost, Error, Frontier, Health, Ladder, Origin, Record, RunSize, SolveCost,
    Status, Study, Variant, Verdict, verdict,
};

/// Results of a variant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct VariantResult {
    pub(crate) name: String,
    pub(crate) values: BTreeMap<String, String>,
    pub(crate) refinement: Option<f64>,
    /// The way it ended.
    pub status: Status,
    /// The error, if it did not end well.
    pub(crate) reason: Option<String>,
    /// Green, yellow or red, of a run along an axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) verdict: Option<Verdict>,
    #[serde(default)]
    pub(crate) health: Health,
    pub(crate) errors: BTreeMap<String, Error>,
    /// Observed order between this and the next coarser variant, of the first judged error.
    pub(crate) order: Option<f64>,
    pub(crate) wall_seconds: WallSeconds,
    #[serde(flatten)]
    pub(crate) size: RunSize,
    pub(crate) dt_limiter: Option<String>,
    pub(crate) dt_limiters: BTreeMap<String, f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) solves: Option<SolveCost>,
    /// Wall-clock seconds per stage, of the fastest repetition.
    pub(crate) wall_seconds_by_stage: BTreeMap<String, f64>,
    #[serde(flatten)]
    pub(crate) origin: Origin,
    pub(crate) fingerprint: String,
}

/// Wall-clock times of the repetitions, s.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct WallSeconds {
    /// The least: the time of the variant without disturbance.
    pub min: Option<f64>,
    /// Largest over least, less one.
    pub spread: Option<f64>,
    /// All of them.
    pub all: Vec<f64>,
    /// Of the repetition that did not come to its end.
    #[serde(default)]
    pub spent: f64,
}

/// Variants that differ in their refinement only, from coarse to fine.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SeriesResult {
    /// Labels on the other axes.
    pub name: String,
    pub variants: Vec<String>,
    /// Orders of every judged error.
    pub orders: BTreeMap<String, Orders>,
}

impl VariantResult {
    pub(crate) fn new(v: &Variant, run: &Record, judge: Option<&Bounds>, axes: &[String]) -> Self {
        VariantResult {
            name: v.name.clone(),
            values: axes.iter().cloned().zip(v.labels.iter().cloned()).collect(),
            refinement: v.refinement,
            status: run.status,
            reason: run.reason.clone(),
            verdict: judge.and_then(|bounds| verdict(run, bounds)),
            health: run.health.clone(),
            errors: match run.status {
                Status::Done => run.errors.clone(),
                _ => BTreeMap::new(),
            },
            order: None,
            wall_seconds: WallSeconds {
                min: run.least_seconds(),
                spread: run.spread(),
                all: run.wall_seconds.clone(),
                spent: run.spent,
            },
            size: run.size.clone(),
            dt_limiter: run.limiter().map(String::from),
            dt_limiters: run.dt_limiters.clone(),
            solves: run.solves.clone(),
            wall_seconds_by_stage: run.wall_seconds_by_stage.clone(),
            origin: run.origin.clone(),
            fingerprint: v.fingerprint.clone(),
        }
    }

    /// Seconds of a step or a solve.
    pub fn cost(&self, cost: Cost) -> Option<f64> {
        cost.seconds(self.wall_seconds.min, self.size.steps, self.solves.as_ref())
    }

    /// An error, if the variant is finished and has it.
    pub fn error(&self, name: &str) -> Option<f64> {
        self.errors.get(name)?.value
    }
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
        let [[least], [most]] = sph_core::bounds(self.places().into_iter().map(|x| [x]));
        least > 0.0 && most / least > 30.0
    }
}

/// Orders of one series of variants that differ in their refinement only.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Orders {
    /// Between each and the next finer one.
    pub between: Vec<f64>,
    /// Slope of the least-squares line through the three finest.
    pub finest_three: Option<f64>,
}

impl Orders {
    /// Orders of points of refinement and error, both positive, from coarse to fine.
    pub fn from_points(points: &[[f64; 2]]) -> Self {
        let logs: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::ln)).collect();
        let order = |p: &[[f64; 2]]| (p[1][1] - p[0][1]) / (p[1][0] - p[0][0]);
        Orders {
            between: logs.windows(2).map(order).collect(),
            finest_three: logs.len().checked_sub(3).map(|k| &logs[k..]).map(slope),
        }
    }

    /// The order that is shown first: the fitted one, or that of two points.
    pub fn main(&self) -> Option<f64> {
        self.finest_three.or(self.between.last().copied())
    }
}

/// Slope of the least-squares line.
pub(crate) fn slope(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let (xx, xy) = points.iter().fold((0.0, 0.0), |(xx, xy), p| {
        let d = p[0] - x;
        (xx + d * d, xy + d * (p[1] - y))
    });
    xy / xx
}

/// Names of the points of time and error that no other point beats, fastest first.
pub fn pareto(mut points: Vec<(String, [f64; 2])>) -> Vec<String> {
    points.retain(|(_, p)| p.iter().all(|x| x.is_finite()));
    points.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut best = f64::INFINITY;
    let mut kept = Vec::new();
    for (name, [_, error]) in points {
        if error < best {
            best = error;
            kept.push(name);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_exponent_as_order() {
        let points = [0.4, 0.2, 0.1, 0.05].map(|h: f64| [h, 3.0 * h.powf(1.7)]);
        let orders = Orders::from_points(&points);
        assert_eq!(orders.between.len(), 3);
        let mut all = orders.between.iter().chain(&orders.finest_three);
        assert!(all.all(|o| (o - 1.7).abs() < 1e-12), "{orders:?}");
    }

    #[test]
    fn the_fit_takes_the_three_finest_and_needs_them() {
        let orders = Orders::from_points(&[[8.0, 1.0], [4.0, 16.0], [2.0, 4.0], [1.0, 1.0]]);
        assert!((orders.main().unwrap() - 2.0).abs() < 1e-12);
        let two = Orders::from_points(&[[0.2, 4.0], [0.1, 2.0]]);
        assert_eq!(two.finest_three, None);
        assert!((two.main().unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(Orders::from_points(&[]), Orders::default());
    }

    #[test]
    fn slower_and_less_accurate_variants_are_left_out() {
        let points = [
            ("slow", [3.0, 0.1]),
            ("worse", [2.0, 0.5]),
            ("fast", [1.0, 0.4]),
            ("nothing", [0.5, f64::NAN]),
            ("twin", [1.0, 0.4]),
        ];
        let points = points.map(|(n, p)| (n.to_string(), p)).to_vec();
        assert_eq!(pareto(points), ["fast", "slow"]);
    }
}
