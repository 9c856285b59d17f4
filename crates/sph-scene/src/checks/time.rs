//! Times and intervals: inside the run, in order.

use scene_text::Problems;

use crate::Scene;

/// Most outputs of fields in a run.
const OUTPUTS: f64 = 1e6;
/// Most rows of the series in a run.
const ROWS: f64 = 1e9;

/// Checks the times of outputs and references, and the bounds of densities.
pub(crate) fn check(scene: &Scene, found: &mut Problems) {
    let end = scene.run.end;
    let output = &scene.output;
    if let (Some(_), Some(_)) = (output.every, &output.times) {
        let message = "outputs are `every` so often or at `times`, not both";
        found.add("output.times", message);
    }
    let times = output.times.as_deref().unwrap_or(&[]);
    for (k, t) in times.iter().enumerate() {
        let path = format!("output.times[{k}]");
        if !(0.0..=end).contains(t) {
            let message = format!("{t} s is outside the run, which lasts from 0 to {end} s");
            found.add(path, message);
        } else if k > 0 && times[k - 1] >= *t {
            let message = format!("times must rise, {t} s follows {} s", times[k - 1]);
            found.add(path, message);
        }
    }
    let often = [
        ("output.every", output.every, OUTPUTS),
        ("output.series_every", output.series_every, ROWS),
        ("run.checkpoint_every", scene.run.checkpoint_every, OUTPUTS),
    ];
    for (path, every, most) in often {
        if every.is_some_and(|e| end / e > most) {
            let message = format!("that is more than {most} times in a run of {end} s");
            found.add(path, message);
        }
    }
    let colours = output.picture_range.iter();
    let falling = colours.flat_map(|colours| colours.falling("output.picture_range"));
    found.0.extend(falling);
    let [low, high] = scene.numerics.density_bounds;
    if !(low < 1.0 && 1.0 < high) {
        let message = format!("the bounds must lie on either side of 1, found {low} and {high}");
        found.add("numerics.density_bounds", message);
    }
    for (name, reference) in &scene.reference {
        for (key, pair) in [("window", reference.window), ("exclude", reference.exclude)] {
            if let Some([low, high]) = pair.filter(|[low, high]| low >= high) {
                let message =
                    format!("the first must be less than the second, found {low} and {high}");
                found.add(format!("reference.{name}.{key}"), message);
            }
        }
        if let Some([start, _]) = reference.window.filter(|w| w[0] > end) {
            let message = format!("it begins at {start} s, after the run's end at {end} s");
            found.add(format!("reference.{name}.window"), message);
        }
    }
}
