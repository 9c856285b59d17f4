//! Green, yellow or red: how a run along an axis went.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sph_core::number;

use crate::{Bounds, Health, Record, Status};

/// Soundness of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Colour {
    /// Everything is within the bounds of green.
    Green,
    /// Something is beyond them, or a step had to be tried again.
    Yellow,
    /// It failed, lost particles through walls, took too long, or is beyond the bounds of yellow.
    Red,
}

impl Colour {
    pub fn name(self) -> &'static str {
        match self {
            Colour::Green => "green",
            Colour::Yellow => "yellow",
            Colour::Red => "red",
        }
    }
}

/// A colour and the reason for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    pub colour: Colour,
    /// Reasons for less than green; empty if there are none.
    pub why: String,
}

type HealthNumber = fn(&Health) -> Option<f64>;

/// Quantities of every run for a verdict, besides the scene's references.
pub const QUANTITIES: [(&str, HealthNumber); 7] = [
    // Most that the energy was above its first value, over the largest energy of any kind.
    ("energy-rise", |h| h.energy_rise),
    // Size of the energy's change from start to end, over the same.
    ("energy-drift", |h| h.energy_drift.map(f64::abs)),
    // Change of the momentum over Σ m|u|.
    ("momentum-drift", |h| h.momentum_drift.map(f64::abs)),
    // Largest distance of a density from its reference, over it.
    ("density", Health::density_deviation),
    // Largest density over its reference, less one.
    ("compression", |h| Some(h.density_range?[1] - 1.0)),
    // Largest speed over the speed of sound.
    ("mach", |h| h.mach),
    // What the mean distance to the nearest particle lacks of a spacing, over it.
    ("pairing", |h| Some(1.0 - h.nearest?[1])),
];

/// The numbers a run can be judged by, those of its references included.
fn quantities(record: &Record) -> BTreeMap<&str, f64> {
    let errors = record.errors.iter();
    let errors = errors.map(|(name, error)| (name.as_str(), error.value));
    let known = errors
        .chain(QUANTITIES.map(|(name, of)| (name, of(&record.health))))
        .filter_map(|(name, value)| Some((name, value?)));
    known.collect()
}

/// The verdict on a run that has come to an end.
pub fn verdict(record: &Record, bounds: &Bounds) -> Option<Verdict> {
    let told = |colour, why| Some(Verdict { colour, why });
    let red = |why: String| told(Colour::Red, why);
    match record.status {
        Status::Done => {}
        Status::Failed | Status::OverLimit => {
            return red(record.reason.clone().unwrap_or_default());
        }
        Status::Skipped | Status::Interrupted | Status::Pending => return None,
    }
    let escaped = record.health.escaped;
    if escaped > 0 {
        return red(format!("{escaped} particles are behind a wall"));
    }
    let found = quantities(record);
    let (mut worst, mut reason) = match record.size.steps_rolled_back {
        0 => (Colour::Green, String::new()),
        n => (Colour::Yellow, format!("{n} steps were tried again")),
    };
    for (name, [green, yellow]) in bounds {
        let Some(value) = found.get(name.as_str()) else {
            continue;
        };
        let (colour, bound) = match *value {
            x if x <= *green => continue,
            x if x <= *yellow => (Colour::Yellow, green),
            // Nothing compares with NaN.
            _ => (Colour::Red, yellow),
        };
        if colour > worst {
            let [value, bound] = [value, bound].map(|x| number::plain(*x));
            (worst, reason) = (colour, format!("{name} {value} > {bound}"));
        }
    }
    told(worst, reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Error, RunSize};

    fn record(error: f64, rolled_back: u64, escaped: usize) -> Record {
        let error = Error {
            value: Some(error),
            ..Error::default()
        };
        Record {
            status: Status::Done,
            errors: [("e".to_string(), error)].into(),
            size: RunSize {
                steps_rolled_back: rolled_back,
                ..RunSize::default()
            },
            health: Health {
                escaped,
                density_range: Some([0.7, 1.1]),
                ..Health::default()
            },
            ..Record::default()
        }
    }

    #[test]
    fn the_worst_quantity_gives_the_colour_and_the_reason() {
        let bounds = |e: [f64; 2], density: [f64; 2]| -> Bounds {
            [("e".to_string(), e), ("density".to_string(), density)].into()
        };
        let fine = bounds([0.1, 0.2], [0.5, 1.0]);
        let tight = bounds([0.1, 0.2], [0.1, 0.2]);
        let [again, behind] = ["2 steps were tried again", "1 particles are behind a wall"];
        for (record, bounds, colour, why) in [
            (record(0.05, 0, 0), &fine, Colour::Green, ""),
            (record(0.15, 0, 0), &fine, Colour::Yellow, "e 0.15 > 0.1"),
            (record(f64::NAN, 0, 0), &fine, Colour::Red, "e NaN > 0.2"),
            (record(0.05, 2, 0), &fine, Colour::Yellow, again),
            (record(0.05, 0, 1), &fine, Colour::Red, behind),
            (record(0.15, 0, 0), &tight, Colour::Red, "density 0.3 > 0.2"),
        ] {
            let found = verdict(&record, bounds).unwrap();
            assert_eq!((found.colour, found.why.as_str()), (colour, why));
        }
    }

    #[test]
    fn unfinished_runs_are_red_and_missing_runs_have_no_colour() {
        let ended = |status| Record {
            status,
            reason: Some("…".into()),
            ..Record::default()
        };
        let none = Bounds::new();
        let colour = |status| verdict(&ended(status), &none).map(|v| v.colour);
        assert_eq!(colour(Status::Failed), Some(Colour::Red));
        assert_eq!(colour(Status::OverLimit), Some(Colour::Red));
        assert_eq!(colour(Status::Skipped), None);
        assert_eq!(colour(Status::Pending), None);
    }
}
