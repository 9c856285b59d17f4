//! Advice where one bound or one stage costs most of a run.

use std::collections::BTreeMap;

use sph_solver::step::LISTS_NAME;

use crate::results::summary::Summary;

/// Share of the steps, or of the time, above which something is worth a word.
const MOST: f64 = 0.5;
/// Fewest steps for shares to count.
const FEW_STEPS: u64 = 20;
/// Wall seconds of a stage below which it is not worth a word.
const SHORT: f64 = 10.0;
/// Least factor that is worth a change.
const WORTH: f64 = 1.2;
/// Least factor of room that a speed of sound must leave: below it sound is a choice of its scene, for accuracy.
const ROOMY: f64 = 4.0;
/// Largest Mach number of a flow whose density hardly moves.
const LIQUID: f64 = 0.1;
/// The bound of sound, by the name that [`sound_limit`](sph_contribution::sound_limit) gives it.
const SOUND: &str = "sound";

/// Factor by which the speeds of sound may fall, below 1 if they should rise: ten times the largest speed is enough, and
/// densities may move by 1 %, as u²/c² and p/ρc² do. `density` is the least and the largest over that at rest.
pub fn room_of_sound(mach: f64, density: [f64; 2]) -> f64 {
    let moved = density.map(|ratio| (ratio - 1.0).abs());
    (LIQUID / mach).min((LIQUID.powi(2) / moved[0].max(moved[1])).sqrt())
}

/// Settings to try, with their possible gains, by the costs in a summary; `remedies` are those of bounds whose plugin
/// has one, all speeds of sound may fall by the factor `sound` ([`room_of_sound`]), and the stages of `solves` have a
/// solver.
pub fn advice(
    costs: &Summary,
    remedies: &BTreeMap<String, String>,
    sound: f64,
    solves: &[String],
) -> Vec<String> {
    let limiter = limiter(costs, remedies, sound).into_iter();
    limiter.chain(stage(costs, solves)).collect()
}

/// Mean of every bound, s: steps over the sum of 1/Δt, so that bounds that hold seldom count little.
pub fn mean_limits(inverse_sums: &BTreeMap<String, f64>, steps: u64) -> BTreeMap<String, f64> {
    let mean = |sum: &f64| steps as f64 / sum;
    let all = inverse_sums
        .iter()
        .map(|(name, sum)| (name.clone(), mean(sum)));
    all.filter(|(_, dt)| dt.is_finite()).collect()
}

/// The bound that takes most steps, and the one that would be next.
fn limiter(s: &Summary, remedies: &BTreeMap<String, String>, sound: f64) -> Option<String> {
    let (name, share) = s.dt_limiters.iter().find(|(_, share)| **share > MOST)?;
    let own = *s.dt_limits.get(name)?;
    let others = s.dt_limits.iter().filter(|(n, _)| *n != name);
    let next = others.min_by(|a, b| a.1.total_cmp(b.1));
    let next = next.map(|(name, dt)| (name, dt / own));
    let room = (name == SOUND).then_some(sound);
    let vain = next.is_some_and(|(_, f)| f < WORTH) || room.is_some_and(|f| f < ROOMY);
    if s.steps < FEW_STEPS || vain {
        return None;
    }
    let then = match next.map(|(next, factor)| (next, significant(factor))) {
        Some((next, times)) => format!("the next bound, `{next}`, is {times} times as long"),
        None => "no other bound is in force".to_string(),
    };
    let room = room.filter(|f| f.is_finite());
    let room = room.map(|f| format!(": here for a factor of {}", significant(f)));
    let room = room.unwrap_or_default();
    let what = match remedies.get(name) {
        Some(remedy) => format!("{remedy}{room}; {then}"),
        None => format!("{then}; a coarser `numerics.spacing` lengthens it"),
    };
    let share = (100.0 * share).round();
    Some(format!("`{name}` limits {share} % of the steps: {what}"))
}

/// A stage beside the sweeps, which are the work itself, that takes most of the time.
fn stage(s: &Summary, solves: &[String]) -> Option<String> {
    let stages = &s.wall_seconds_by_stage;
    let all: f64 = stages.values().sum();
    let (name, seconds) = stages.iter().find(|(_, t)| **t > MOST * all)?;
    if seconds.min(s.wall_seconds) < SHORT {
        return None;
    }
    let share = 100.0 * (seconds / all);
    let what = match name.as_str() {
        "output" => "a longer `output.every` and `output.series_every`, or `output.vtk = false`",
        LISTS_NAME => "a larger `numerics.skin`, so that lists last longer",
        _ if solves.contains(name) => "a looser tolerance of its solver, or another solver",
        _ => return None,
    };
    Some(format!(
        "`{name}` takes {share:.0} % of the time: try {what}"
    ))
}

/// Two significant digits: an estimate has no more.
fn significant(x: f64) -> String {
    match x {
        x if x < 10.0 => format!("{x:.1}"),
        x => {
            let unit = 10f64.powf(x.log10().floor() - 1.0);
            format!("{:.0}", (x / unit).round() * unit)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(pairs: &[(&str, f64)]) -> BTreeMap<String, f64> {
        pairs.iter().map(|(n, x)| (n.to_string(), *x)).collect()
    }

    type Pairs = [(&'static str, f64)];

    fn messages(shares: &Pairs, limits: &Pairs, stages: &Pairs) -> Vec<String> {
        with_room(1.5, shares, limits, stages)
    }

    fn with_room(sound: f64, shares: &Pairs, limits: &Pairs, stages: &Pairs) -> Vec<String> {
        let remedies = [("viscosity", "solve for it"), ("sound", "lower it")];
        let remedies = remedies.map(|(n, what)| (n.to_string(), what.to_string()));
        let costs = Summary {
            steps: 1000,
            wall_seconds: 100.0,
            dt_limiters: table(shares),
            dt_limits: table(limits),
            wall_seconds_by_stage: table(stages),
            ..Summary::default()
        };
        advice(
            &costs,
            &remedies.into(),
            sound,
            &["implicit viscosity".into()],
        )
    }

    #[test]
    fn sound_may_fall_as_far_as_speeds_and_densities_allow_and_no_further() {
        let room = room_of_sound(0.02, [0.9984, 1.0004]);
        assert!((room - 2.5).abs() < 1e-9, "{room}: the density");
        assert!((room_of_sound(0.05, [1.0, 1.0001]) - 2.0).abs() < 1e-9);
        // There is no advice to lower it below ten times the largest speed.
        assert!(room_of_sound(0.1, [1.0; 2]) < ROOMY);
        let limits = [("sound", 1.0), ("force", 9.0)];
        let told = |sound| with_room(sound, &[("sound", 1.0)], &limits, &[]);
        assert!(told(3.9).is_empty());
        let told = told(7.0);
        assert!(told[0].contains("lower it: here for a factor of 7.0; the next bound, `force`"));
    }

    #[test]
    fn a_viscous_run_is_told_what_its_plugin_says_and_what_it_may_bring() {
        let limits = [("viscosity", 1e-5), ("sound", 2.34e-4), ("force", 1.0)];
        let told = messages(&[("viscosity", 0.9), ("sound", 0.1)], &limits, &[]);
        assert_eq!(told.len(), 1);
        assert!(told[0].contains("solve for it") && told[0].contains("`sound`, is 23 times"));
    }

    #[test]
    fn a_bound_without_a_remedy_is_told_of_the_spacing_and_a_solver_of_its_tolerance() {
        let limits = [("elastic wave", 1e-5), ("sound", 1e-4)];
        let told_of = messages(&[("elastic wave", 1.0)], &limits, &[]);
        assert!(told_of[0].contains("spacing") && told_of[0].contains("10 times"));
        let solves = [("implicit viscosity", 90.0), ("interactions (a)", 1.0)];
        let told_of = messages(&[], &[], &solves);
        assert!(told_of[0].contains("tolerance"), "{told_of:?}");
    }

    #[test]
    fn nothing_is_said_where_nothing_is_to_be_gained() {
        let limits = [("viscosity", 1e-5), ("sound", 1.1e-5)];
        assert!(messages(&[("viscosity", 0.9)], &limits, &[]).is_empty());
        assert!(messages(&[("sound", 0.5)], &[("sound", 1.0)], &[]).is_empty());
        let sweep = [("interactions (a)", 9.0), ("output", 1.0)];
        assert!(messages(&[], &[], &sweep).is_empty());
        let brief = [("interactions (a)", 1.0), ("output", 3.0)];
        assert!(messages(&[], &[], &brief).is_empty(), "seconds");
        let told = messages(&[], &[], &[("interactions (a)", 10.0), ("output", 30.0)]);
        assert!(told[0].contains("75 %"), "{told:?}");
    }

    #[test]
    fn a_bound_that_does_not_hold_has_no_mean() {
        let means = mean_limits(&table(&[("sound", 200.0), ("force", 0.0)]), 100);
        assert_eq!(means, table(&[("sound", 0.5)]));
    }
}
