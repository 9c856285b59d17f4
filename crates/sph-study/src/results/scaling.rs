//! Cost of a step, or a solve, against the number of particles.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sph_core::{comma_list, number};

use crate::results::variant_result::slope;
use crate::{Cost, Results, Scaling, VariantResult};

/// A name with its particles and seconds, by size.
type CostSeries = (String, Vec<[f64; 2]>);

/// Costs of all series, and the fastest at each size.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Scale {
    /// Unit of the cost.
    pub cost: Cost,
    /// One per series of the study that has run.
    pub series: Vec<SeriesCost>,
    /// Stretches of sizes with one fastest, in the order of size within each group.
    pub fastest: Vec<FastestRange>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SeriesCost {
    pub name: String,
    /// Particles and seconds, by size.
    pub points: Vec<[f64; 2]>,
    /// p of the least-squares fit seconds ∝ particlesᵖ, of two points and more.
    pub exponent: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FastestRange {
    /// Labels on the axes that do not compete.
    pub among: String,
    pub name: String,
    /// Particles from and to which; between two sizes where their costs, as power laws, are the same.
    pub particles: [f64; 2],
}

impl Scale {
    /// Of the results of a study, some `others` of whose axes neither compete nor refine.
    pub(crate) fn new(scaling: &Scaling, results: &Results, others: &[&str]) -> Self {
        let mut costs = Vec::new();
        let mut groups: BTreeMap<String, Vec<CostSeries>> = BTreeMap::new();
        for one in &results.series {
            let all = one.variants.iter().filter_map(|name| results.variant(name));
            let all: Vec<&VariantResult> = all.collect();
            let cost = |v: &&VariantResult| Some([v.size.particles as f64, v.cost(scaling.cost)?]);
            let points = all.iter().filter_map(cost);
            let mut points: Vec<[f64; 2]> = points.filter(|p| p.iter().all(|x| *x > 0.0)).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            costs.push(SeriesCost::from_points(&one.name, points.clone()));
            if let (Some(between), Some(first)) = (&scaling.between, all.first()) {
                let among = comma_list(others.iter().map(|axis| &first.values[*axis]));
                let group = groups.entry(among).or_default();
                group.push((first.values[between].clone(), points));
            }
        }
        let fastest = groups.iter();
        let fastest = fastest.flat_map(|(among, all)| fastest_ranges(among, all));
        Scale {
            cost: scaling.cost,
            series: costs,
            fastest: fastest.collect(),
        }
    }

    /// Exponents and reigns as a person reads them.
    pub fn lines(&self) -> Vec<String> {
        let cost = self.cost.name();
        let exponents = self.series.iter().filter_map(|s| {
            let p = s.exponent?;
            Some(format!("{cost} of {}: exponent {p:.2}", s.name))
        });
        let count = |n: f64| number::count(n.round());
        let reigns = self.fastest.iter().map(|r| {
            let [from, to] = r.particles.map(count);
            let among = match r.among.as_str() {
                "" => String::new(),
                among => format!(" ({among})"),
            };
            format!("fastest from {from} to {to} particles{among}: {}", r.name)
        });
        exponents.chain(reigns).collect()
    }
}

impl SeriesCost {
    fn from_points(name: &str, points: Vec<[f64; 2]>) -> Self {
        let logs: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::ln)).collect();
        let exponent = (logs.len() > 1).then(|| slope(&logs));
        SeriesCost {
            name: name.to_string(),
            points,
            exponent: exponent.filter(|p| p.is_finite()),
        }
    }
}

/// The fastest of some competitors, from the least to the largest size.
fn fastest_ranges(among: &str, all: &[CostSeries]) -> Vec<FastestRange> {
    let mut sizes: Vec<f64> = all.iter().flat_map(|(_, p)| p).map(|p| p[0]).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.dedup();
    let cost = |k: usize, n: f64| all[k].1.iter().find(|p| p[0] == n).map(|p| p[1]);
    let best = |n: f64| {
        let there = (0..all.len()).filter_map(|k| Some((k, cost(k, n)?)));
        there.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    };
    let mut found: Vec<(usize, FastestRange)> = Vec::new();
    let mut before = f64::NAN;
    for n in sizes {
        let Some(k) = best(n) else { continue };
        match found.last_mut() {
            Some((last, reign)) if *last == k => reign.particles[1] = n,
            other => {
                let mut from = n;
                if let Some((last, reign)) = other {
                    from = takeover([before, n], |m| Some([cost(*last, m)?, cost(k, m)?]));
                    reign.particles[1] = from;
                }
                let range = FastestRange {
                    among: among.to_string(),
                    name: all[k].0.clone(),
                    particles: [from, n],
                };
                found.push((k, range));
            }
        }
        before = n;
    }
    found.into_iter().map(|(_, reign)| reign).collect()
}

/// Size at which two power laws through their costs at two sizes meet; halfway where one has none.
fn takeover(sizes: [f64; 2], costs: impl Fn(f64) -> Option<[f64; 2]>) -> f64 {
    let [low, high] = sizes.map(f64::ln);
    let lead = |n: f64| costs(n).map(|[a, b]| (a / b).ln());
    let share = match (lead(sizes[0]), lead(sizes[1])) {
        (Some(a), Some(b)) if a != b => (a / (a - b)).clamp(0.0, 1.0),
        _ => 0.5,
    };
    (low + share * (high - low)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_laws_have_their_exponents_and_meet_where_they_are_the_same() {
        let sizes = [1e2, 1e3, 1e4, 1e5];
        let law = |a: f64, p: f64| -> Vec<[f64; 2]> {
            sizes.iter().map(|n| [*n, a * f64::powf(*n, p)]).collect()
        };
        // 1e-6 n = 1e-8 n^1.5 at n = 10⁴; 2e-6 n is never the fastest.
        let linear = law(1e-6, 1.0);
        let steep = law(1e-8 / 3f64.sqrt(), 1.5);
        assert!((SeriesCost::from_points("", steep.clone()).exponent.unwrap() - 1.5).abs() < 1e-12);
        let all = [
            ("linear".to_string(), linear),
            ("steep".to_string(), steep),
            ("slow".to_string(), law(2e-6, 1.0)),
        ];
        let found = fastest_ranges("2D", &all);
        let names: Vec<&str> = found.iter().map(|r| r.name.as_str()).collect();
        assert_eq!(names, ["steep", "linear"]);
        let meets = found[0].particles[1];
        assert!((meets / 3e4 - 1.0).abs() < 1e-9, "{meets}");
        assert_eq!(found[1].particles, [meets, 1e5]);
    }

    #[test]
    fn the_next_entry_is_fastest_where_one_has_no_more_sizes() {
        let all = [
            ("direct".to_string(), vec![[1e2, 1.0], [1e4, 50.0]]),
            (
                "iterative".to_string(),
                vec![[1e2, 2.0], [1e4, 90.0], [1e6, 9e3]],
            ),
        ];
        let found = fastest_ranges("", &all);
        assert_eq!(found[0].name, "direct");
        assert!((found[0].particles[1] / 1e5 - 1.0).abs() < 1e-9);
        assert_eq!(found[1].particles[1], 1e6);
    }
}
