//! Lines, markers and bands over two axes, alone or side by side, as PNG or SVG.
//!
//! Meant for probes against reference data and for work–precision plots, not for publication: everything is automatic.

use std::path::Path;

use sph_core::bounds;

use crate::drawing::axes::{Axes, PlotAxis, left_room, shown};
use crate::drawing::canvas::Canvas;
use crate::drawing::draw_target::{Anchor, DrawTarget, Lettering, Rect};
use crate::drawing::mark::{Mark, Series, Style, draw_legend};
use crate::drawing::svg::Svg;
use crate::drawing::ticks::widened;
use crate::error::{IoError, Result};

/// Pixels of a plot.
const SIZE: [u32; 2] = [1200, 800];
/// Font size in pixels.
const LETTERS: f64 = 22.0;

/// A plot of some series.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// use sph_io::{Plot, Series};
/// let plot = Plot {
///     title: "Convergence".into(),
///     x_label: "spacing [m]".into(),
///     y_label: "error [1]".into(),
///     log_x: true,
///     log_y: true,
///     series: vec![Series::line("second order", vec![[0.01, 1e-4], [0.1, 1e-2]])],
/// };
/// plot.save(folder.path().join("convergence.png"))?;
/// plot.save(folder.path().join("convergence.svg"))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// Above the frame.
    pub title: String,
    /// Quantity and unit along the horizontal axis.
    pub x_label: String,
    /// Quantity and unit along the vertical axis.
    pub y_label: String,
    /// Logarithmic horizontal axis; points with x ≤ 0 are left out.
    pub log_x: bool,
    /// Logarithmic vertical axis; points with y ≤ 0 are left out.
    pub log_y: bool,
    /// Each in its own colour; drawn in this order, bands before all others.
    pub series: Vec<Series>,
}

impl Plot {
    /// Writes the plot as vectors, texts as texts, if the name ends in `.svg`, else as a PNG of 1200 by 800 pixels.
    ///
    /// # Errors
    /// If the series do not fit together, or the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        self.check(path)?;
        save(path, SIZE, |on| self.draw(on, &Rect::sized(SIZE)))
    }

    /// The document that [`save`](Self::save) writes as vectors, to stand in a page.
    ///
    /// # Errors
    /// If the series do not fit together.
    pub fn to_svg(&self) -> Result<String> {
        self.check(Path::new("plot.svg"))?;
        let mut svg = Svg::new(SIZE[0], SIZE[1]);
        self.draw(&mut svg, &Rect::sized(SIZE));
        Ok(svg.finish())
    }

    fn check(&self, path: &Path) -> Result<()> {
        for series in &self.series {
            let (name, points) = (&series.name, series.points.len());
            if let Style::Band(upper) = &series.style
                && upper.len() != points
            {
                let upper = upper.len();
                let said = format!("band `{name}` has {upper} upper ordinates at {points} points");
                return Err(IoError::input(path, said));
            }
        }
        Ok(())
    }

    fn draw(&self, on: &mut dyn DrawTarget, place: &Rect) {
        let axes = self.axes(place);
        let numbered = self.series.iter().enumerate();
        let marks = numbered.map(|(number, series)| Mark { series, number });
        let marks: Vec<Mark> = marks.collect();
        axes.draw_grid(on);
        // Bands first, whatever their place in the list: they hide lines.
        let (behind, others): (Vec<&Mark>, Vec<&Mark>) = marks.iter().partition(|m| m.is_behind());
        for mark in behind.into_iter().chain(others) {
            mark.draw(on, &axes);
        }
        axes.draw(on);
        draw_legend(on, &marks, &axes);
        let middle = (axes.frame.left + axes.frame.right) / 2.0;
        let lettering = Lettering::new(1.15 * LETTERS, Anchor::Middle);
        let title = [middle, place.top + 1.6 * LETTERS];
        on.text(title, &self.title, lettering);
    }

    fn axes(&self, place: &Rect) -> Axes {
        let x = self.axis(0, self.log_x, &self.x_label);
        let y = self.axis(1, self.log_y, &self.y_label);
        let top = if self.title.is_empty() { 1.2 } else { 2.6 } * LETTERS;
        let room = y.ticks(8).factor.map_or(0.0, |_| 0.9);
        let top = place.top + top + room * LETTERS;
        let bottom = place.bottom - 3.6 * LETTERS;
        let left = place.left + left_room(&y, bottom - top, LETTERS);
        Axes {
            frame: Rect::between([left, top], [place.right - 1.6 * LETTERS, bottom]),
            x,
            y,
            size: LETTERS,
            grid: true,
        }
    }

    /// The axis that holds all points that can be shown, with a margin.
    fn axis(&self, direction: usize, log: bool, label: &str) -> PlotAxis {
        let logs = [self.log_x, self.log_y];
        let shown = |p: &[f64; 2]| (0..2).all(|i| shown(p[i], logs[i]));
        let values = self.series.iter().flat_map(Series::spots).filter(shown);
        let scaled = |v: f64| if log { v.log10() } else { v };
        let [[lo], [hi]] = bounds(values.map(|p| [scaled(p[direction])]));
        let [lo, hi] = if lo > hi { [0.0, 1.0] } else { widened(lo, hi) };
        let margin = 0.04 * (hi - lo);
        let [lo, hi] = [lo - margin, hi + margin];
        let back = |v: f64| if log { 10_f64.powf(v) } else { v };
        PlotAxis {
            lo: back(lo),
            hi: back(hi),
            log,
            label: label.into(),
        }
    }
}

/// Draws into a file of so many pixels: vectors if its name ends in `.svg`, else a PNG.
fn save(path: &Path, [width, height]: [u32; 2], draw: impl Fn(&mut dyn DrawTarget)) -> Result<()> {
    if path.extension().is_some_and(|e| e == "svg") {
        let mut svg = Svg::new(width, height);
        draw(&mut svg);
        return svg.save(path);
    }
    let canvas = Canvas::new(width, height);
    let mut canvas = canvas.ok_or_else(|| IoError::input(path, "no memory for the plot"))?;
    draw(&mut canvas);
    canvas.save(path)
}

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
    /// If there are no panels or too many, the series of one do not fit together, or the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        if self.0.is_empty() || self.0.len() > MOST {
            let said = format!("{} panels where 1 to {MOST} fit", self.0.len());
            return Err(IoError::input(path, said));
        }
        self.0.iter().try_for_each(|plot| plot.check(path))?;
        let [width, height] = PANEL;
        save(path, [width * self.0.len() as u32, height], |on| {
            for (number, plot) in (1..).zip(&self.0) {
                let mut place = Rect::sized([number * width, height]);
                place.left = f64::from((number - 1) * width);
                plot.draw(on, &place);
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_stand_side_by_side_and_none_or_too_many_are_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let plot = Plot {
            title: "a law".into(),
            series: vec![Series::line("line", vec![[0.0, 0.0], [1.0, 2.0]])],
            ..Plot::default()
        };
        let path = folder.path().join("two.svg");
        let panels = |count: usize| Panels(vec![plot.clone(); count]);
        panels(2).save(&path).expect("saved");
        let text = std::fs::read_to_string(&path).expect("text");
        assert!(text.contains("viewBox=\"0 0 1800 720\""), "{text}");
        assert_eq!(text.matches(">a law<").count(), 2);
        let png = folder.path().join("two.png");
        panels(1).save(&png).expect("saved");
        assert!(png.exists());
        let refused = folder.path().join("none.png");
        for count in [0, 10] {
            assert!(panels(count).save(&refused).is_err() && !refused.exists());
        }
    }
}
