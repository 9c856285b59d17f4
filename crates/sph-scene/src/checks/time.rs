//! Times and intervals: inside the run, in order.

use scene_text::Problems;

use crate::{Numerics, Scene};

/// Most outputs of fields in a run.
const OUTPUTS: f64 = 1e6;
/// Most rows of the series in a run.
const ROWS: f64 = 1e9;

/// Checks the times of outputs and references, and the bounds of densities.
pub(crate) fn check(scene: &Scene, found: &mut Problems) {
    let end = scene.run.end;
    let output = &scene.output;
    if let (Some(_), Some(_)) = (output.every, &output.times) {
        found.add(
            "output.times",
            "outputs are `every` so often or at `times`, not both",
        );
    }
    let times = output.times.as_deref().unwrap_or(&[]);
    for (k, t) in times.iter().enumerate() {
        let path = format!("output.times[{k}]");
        if !(0.0..=end).contains(t) {
            found.add(
                path,
                format!("{t} s is outside the run, which lasts from 0 to {end} s"),
            );
        } else if k > 0 && times[k - 1] >= *t {
            found.add(
                path,
                format!("times must rise, {t} s follows {} s", times[k - 1]),
            );
        }
    }
    let often = [
        ("output.every", output.every, OUTPUTS),
        ("output.series_every", output.series_every, ROWS),
        ("run.checkpoint_every", scene.run.checkpoint_every, OUTPUTS),
    ];
    for (path, every, most) in often {
        if every.is_some_and(|e| end / e > most) {
            found.add(
                path,
                format!("that is more than {most} times in a run of {end} s"),
            );
        }
    }
    if let Some(colours) = &output.picture_range {
        for problem in colours.falling("output.picture_range") {
            found.add(problem.path, problem.message);
        }
    }
    density(&scene.numerics, found);
    for (name, reference) in &scene.reference {
        rising(reference.window, &format!("reference.{name}.window"), found);
        rising(
            reference.exclude,
            &format!("reference.{name}.exclude"),
            found,
        );
        if let Some([start, _]) = reference.window.filter(|w| w[0] > end) {
            let message = format!("it begins at {start} s, after the run's end at {end} s");
            found.add(format!("reference.{name}.window"), message);
        }
    }
}

fn density(numerics: &Numerics, found: &mut Problems) {
    let [low, high] = numerics.density_bounds;
    if !(low < 1.0 && 1.0 < high) {
        found.add(
            "numerics.density_bounds",
            format!("the bounds must lie on either side of 1, found {low} and {high}"),
        );
    }
}

fn rising(pair: Option<[f64; 2]>, path: &str, found: &mut Problems) {
    if let Some([low, high]) = pair.filter(|[low, high]| low >= high) {
        found.add(
            path,
            format!("the first must be less than the second, found {low} and {high}"),
        );
    }
}
