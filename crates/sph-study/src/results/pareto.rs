//! Variants that no other beats in both time and error.

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
