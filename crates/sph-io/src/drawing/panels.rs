//! Plots side by side in one picture.

use std::path::Path;

use crate::drawing::draw_target::{DrawTarget, Rect};
use crate::drawing::plot::{Plot, save};
use crate::error::{IoError, Result};

/// Pixels of one panel.
const PANEL: [u32; 2] = [900, 720];
/// Panels that fit into the largest picture.
const MOST: usize = 9;

/// Plots side by side, from left to right: for related curves with other axes.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// use sph_io::{Panels, Plot, Series};
/// let law = |y_label: &str, points| Plot {
///     x_label: "strain rate [1/s]".into(),
///     y_label: y_label.into(),
///     series: vec![Series::line("water", points)],
///     ..Plot::default()
/// };
/// let panels = Panels(vec![
///     law("shear stress [Pa]", vec![[0.0, 0.0], [10.0, 0.01]]),
///     law("viscosity [Pa s]", vec![[0.0, 1e-3], [10.0, 1e-3]]),
/// ]);
/// panels.save(folder.path().join("water.svg"))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panels(pub Vec<Plot>);

impl Panels {
    /// Writes the picture as vectors if the name ends in `.svg`, else as PNG.
    ///
    /// # Errors
    /// If there are no panels or too many, the series of one do not fit together, or the file
    /// cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        if self.0.is_empty() || self.0.len() > MOST {
            let said = format!("{} panels where 1 to {MOST} fit", self.0.len());
            return Err(IoError::input(path, said));
        }
        self.0.iter().try_for_each(|plot| plot.check(path))?;
        let width = PANEL[0] * self.0.len() as u32;
        save(path, [width, PANEL[1]], |on| self.draw(on))
    }

    fn draw(&self, on: &mut dyn DrawTarget) {
        let [width, height] = PANEL.map(f64::from);
        for (k, plot) in self.0.iter().enumerate() {
            let left = width * k as f64;
            let place = Rect {
                left,
                top: 0.0,
                right: left + width,
                bottom: height,
            };
            plot.draw(on, &place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Series;

    #[test]
    fn panels_stand_side_by_side_and_none_or_too_many_are_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let plot = Plot {
            title: "a law".into(),
            series: vec![Series::line("line", vec![[0.0, 0.0], [1.0, 2.0]])],
            ..Plot::default()
        };
        let path = folder.path().join("two.svg");
        Panels(vec![plot.clone(), plot.clone()])
            .save(&path)
            .expect("saved");
        let text = std::fs::read_to_string(&path).expect("text");
        assert!(text.contains("viewBox=\"0 0 1800 720\""), "{text}");
        assert_eq!(text.matches(">a law<").count(), 2);
        let png = folder.path().join("two.png");
        Panels(vec![plot.clone()]).save(&png).expect("saved");
        assert!(png.exists());
        let refused = folder.path().join("none.png");
        for count in [0, 10] {
            let panels = Panels(vec![plot.clone(); count]);
            assert!(panels.save(&refused).is_err() && !refused.exists());
        }
    }
}
