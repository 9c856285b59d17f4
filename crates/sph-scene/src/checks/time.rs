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
    if output.every.is_some() && output.times.is_some() {
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
    for (path, every, most) in [
        ("output.every", output.every, OUTPUTS),
        ("output.series_every", output.series_every, ROWS),
        ("run.checkpoint_every", scene.run.checkpoint_every, OUTPUTS),
    ] {
        if every.is_some_and(|e| end / e > most) {
            let message = format!("that is more than {most} times in a run of {end} s");
            found.add(path, message);
        }
    }
    if let Some(colours) = &output.picture_range {
        (found.0).extend(colours.falling("output.picture_range"));
    }
    let [low, high] = scene.numerics.density_bounds;
    if !(low < 1.0 && 1.0 < high) {
        let message = format!("the bounds must lie on either side of 1, found {low} and {high}");
        found.add("numerics.density_bounds", message);
    }
    for (name, reference) in &scene.reference {
        for (key, pair) in [("window", reference.window), ("exclude", reference.exclude)] {
            let path = format!("reference.{name}.{key}");
            (found.0).extend(pair.and_then(|pair| scene_text::falling(path, pair)));
        }
        if let Some([start, _]) = reference.window.filter(|w| w[0] > end) {
            let message = format!("it begins at {start} s, after the run's end at {end} s");
            found.add(format!("reference.{name}.window"), message);
        }
    }
}
