//! Values at the ends of the colours of pictures.

use sph_core::fields;
use sph_io::ColourRanges;
use sph_scene::{PictureRange, Scene};

/// Ranges that a scene gives, and that follow from it.
pub(crate) struct Colours {
    given: Option<PictureRange>,
    /// Pressure of the fluid at rest, Pa; 0 where there is none.
    pressure: f64,
    /// The largest `velocity_scale`, m/s; 0 where none is given.
    speed: f64,
}

impl Colours {
    pub fn from_scene(scene: &Scene, pressure: f64) -> Self {
        let scales = scene.phase.values().filter_map(|p| p.velocity_scale);
        Colours {
            given: scene.output.picture_range.clone(),
            pressure,
            speed: scales.fold(0.0, f64::max),
        }
    }

    /// The range for the next picture of a field, and a remark if it is wider than pictures have `seen`.
    pub fn range(
        &self,
        field: &str,
        values: &[f64],
        seen: &mut ColourRanges,
    ) -> (Option<[f64; 2]>, Option<String>) {
        let given = self.given.as_ref().and_then(|all| all.ends(field));
        let scale = match field {
            _ if field == fields::PRESSURE.name => self.pressure,
            _ if field == fields::VELOCITY.name => self.speed,
            _ => 0.0,
        };
        let scaled = (scale > 0.0).then_some([0.0, scale]);
        if let Some(range) = given.or(scaled) {
            return (Some(range), None);
        }
        let Some((range, wider)) = seen.next(field, values) else {
            return (None, None);
        };
        let [low, high] = range.map(sph_core::number::plain);
        let told = wider.then(|| {
            format!("note: colours of `{field}` go from {low} to {high} from here on; `output.picture_range` fixes them")
        });
        (Some(range), told)
    }
}
