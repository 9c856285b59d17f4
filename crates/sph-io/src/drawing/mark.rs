//! A series of a plot: its points, the marks and lines by which they are drawn, and the legend.

use crate::drawing::axes::{Axes, shown};
use crate::drawing::colour::{Colour, SERIES};
use crate::drawing::draw_target::{Anchor, DrawTarget, Fill, Lettering, Pen, Rect, Spot};
use crate::drawing::text;

/// One set of points of a [`Plot`](crate::Plot).
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; empty for none.
    pub name: String,
    /// Abscissa and ordinate. A line is broken at points that are not finite.
    pub points: Vec<[f64; 2]>,
    /// Marks of the points.
    pub style: Style,
}

/// Style of a [`Series`].
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Style {
    /// A line through the points.
    #[default]
    Line,
    /// A dashed line through the points.
    Dashes,
    /// A marker at every point.
    Markers,
    /// Both line and markers.
    LineAndMarkers,
    /// Grey line and dots behind all others, not in the legend: the background of the others.
    Background,
    /// A broad pale line behind the others: which points stand out.
    Highlight,
    /// A shaded area between the points and as many upper ordinates.
    Band(
        /// The upper edge at the abscissae of the points.
        Vec<f64>,
    ),
}

impl Series {
    /// A line.
    pub fn line(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::styled(name, points, Style::Line)
    }

    /// Markers, for measurements and reference data.
    pub fn markers(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::styled(name, points, Style::Markers)
    }

    /// A band between the points and the ordinates `upper`.
    pub fn band(name: impl Into<String>, points: Vec<[f64; 2]>, upper: Vec<f64>) -> Self {
        Self::styled(name, points, Style::Band(upper))
    }

    /// Any style.
    pub fn styled(name: impl Into<String>, points: Vec<[f64; 2]>, style: Style) -> Self {
        Self {
            name: name.into(),
            points,
            style,
        }
    }

    /// All points that must fit into the frame.
    pub(crate) fn spots(&self) -> impl Iterator<Item = [f64; 2]> {
        let upper: &[f64] = match &self.style {
            Style::Band(upper) => upper,
            _ => &[],
        };
        let above = self.points.iter().zip(upper).map(|(p, &y)| [p[0], y]);
        self.points.iter().copied().chain(above)
    }
}

/// Points beyond which lines are thinned to the visible ones.
const MANY: usize = 4000;

pub(crate) struct Mark<'a> {
    pub(crate) series: &'a Series,
    /// Its place in the list of all series.
    pub(crate) number: usize,
}

impl Mark<'_> {
    fn colour(&self) -> Colour {
        match self.series.style {
            Style::Background => Colour::PALE,
            Style::Highlight => Colour::HIGHLIGHT,
            _ => SERIES[self.number % SERIES.len()],
        }
    }

    pub(crate) fn is_behind(&self) -> bool {
        let style = &self.series.style;
        matches!(style, Style::Band(_) | Style::Background | Style::Highlight)
    }

    /// True if it has a place in the legend.
    pub(crate) fn is_named(&self) -> bool {
        !self.series.name.is_empty() && self.series.style != Style::Background
    }

    /// The unbroken stretches of the series on the surface.
    pub(crate) fn stretches(&self, axes: &Axes) -> Vec<Vec<Spot>> {
        let visible = |p: &[f64; 2]| shown(p[0], axes.x.log) && shown(p[1], axes.y.log);
        let pieces = self.series.points.split(|p| !visible(p));
        let spots = pieces.map(|s| s.iter().map(|p| axes.spot(p[0], p[1])).collect());
        spots.filter(|s: &Vec<Spot>| !s.is_empty()).collect()
    }

    pub(crate) fn draw(&self, on: &mut dyn DrawTarget, axes: &Axes) {
        if let Style::Band(upper) = &self.series.style {
            self.draw_band(on, axes, upper);
            return;
        }
        for stretch in self.stretches(axes) {
            self.draw_marked(on, &thinned(&stretch), &stretch, axes.size);
        }
    }

    /// The sample in a legend between the spots `from` and `to`.
    pub(crate) fn draw_sample(&self, on: &mut dyn DrawTarget, [from, to]: [Spot; 2], size: f64) {
        let style = &self.series.style;
        if let Style::Band(_) = style {
            let half = 0.35 * size;
            let [(a, b), (c, d)] = [(from[0], from[1] - half), (to[0], to[1] + half)];
            return on.area(&[[a, b], [c, b], [c, d], [a, d]], self.band_fill());
        }
        let middle = [(from[0] + to[0]) / 2.0, from[1]];
        self.draw_marked(on, &[from, to], &[middle], size);
    }

    /// A line and marks, as far as the style has them.
    fn draw_marked(&self, on: &mut dyn DrawTarget, line: &[Spot], marks: &[Spot], size: f64) {
        let style = &self.series.style;
        if *style != Style::Markers {
            on.line(line, self.pen(size));
        }
        for &spot in marks {
            match style {
                Style::Markers | Style::LineAndMarkers => self.draw_marker(on, spot, size),
                Style::Background => on.disc(spot, 0.14 * size, Fill::solid(self.colour())),
                _ => {}
            }
        }
    }

    fn draw_band(&self, on: &mut dyn DrawTarget, axes: &Axes, upper: &[f64]) {
        let edges = self.series.points.iter().zip(upper);
        let edges: Vec<([f64; 2], f64)> = edges.map(|(&p, &y)| (p, y)).collect();
        let visible = |(p, y): &([f64; 2], f64)| {
            shown(p[0], axes.x.log) && shown(p[1], axes.y.log) && shown(*y, axes.y.log)
        };
        for piece in edges.split(|e| !visible(e)) {
            let lower: Vec<Spot> = piece.iter().map(|(p, _)| axes.spot(p[0], p[1])).collect();
            let upper: Vec<Spot> = piece.iter().map(|(p, y)| axes.spot(p[0], *y)).collect();
            let mut outline = thinned(&lower);
            outline.extend(thinned(&upper).iter().rev());
            if outline.len() > 2 {
                on.area(&outline, self.band_fill());
            }
        }
    }

    /// Circle, square, diamond and triangle in turn.
    fn draw_marker(&self, on: &mut dyn DrawTarget, [x, y]: Spot, size: f64) {
        let r = 0.27 * size;
        let fill = Fill::solid(self.colour());
        // Corners, over the radius.
        let corners: &[Spot] = match self.number % 4 {
            0 => return on.disc([x, y], r, fill),
            1 => &[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]],
            2 => &[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]],
            _ => &[[0.0, -1.3], [1.15, 0.75], [-1.15, 0.75]],
        };
        let place = |[right, down]: &Spot| [x + right * r, y + down * r];
        on.area(&corners.iter().map(place).collect::<Vec<Spot>>(), fill);
    }

    fn pen(&self, size: f64) -> Pen {
        Pen {
            colour: self.colour(),
            width: match self.series.style {
                Style::Background => size / 18.0,
                Style::Highlight => size / 2.2,
                _ => size / 8.0,
            },
            // Colours that come round again are distinguished by dashes.
            dashed: match self.series.style {
                Style::Dashes => true,
                Style::Background | Style::Highlight => false,
                _ => self.number >= SERIES.len(),
            },
        }
    }

    fn band_fill(&self) -> Fill {
        Fill::new(self.colour(), 0.25)
    }
}

/// A long line reduced to first, lowest, highest and last spot of every run
/// within one column of pixels: it looks the same.
fn thinned(line: &[Spot]) -> Vec<Spot> {
    if line.len() <= MANY {
        return line.to_vec();
    }
    let mut out = Vec::new();
    for run in line.chunk_by(|a, b| a[0].floor() == b[0].floor()) {
        let height = |&i: &usize, &j: &usize| run[i][1].total_cmp(&run[j][1]);
        let lowest = (0..run.len()).min_by(height).unwrap_or(0);
        let highest = (0..run.len()).max_by(height).unwrap_or(0);
        let mut kept = vec![0, lowest, highest, run.len() - 1];
        kept.sort_unstable();
        kept.dedup();
        out.extend(kept.into_iter().map(|k| run[k]));
    }
    out
}

/// Draws names and samples of the series that have a name, in the corner where they hide least.
pub(crate) fn draw_legend(on: &mut dyn DrawTarget, marks: &[Mark], axes: &Axes) {
    let size = 0.92 * axes.size;
    let named: Vec<&Mark> = marks.iter().filter(|m| m.is_named()).collect();
    if named.is_empty() {
        return;
    }
    let names = named.iter().map(|m| m.series.name.as_str());
    let width = text::widest(names, size) + 4.2 * size;
    let height = (1.45 * named.len() as f64 + 0.5) * size;
    // Grey lines are covered rather than those in the legend.
    let spots = |named: bool| visited(marks.iter().filter(|m| m.is_named() == named), axes);
    let spots = [true, false].map(spots);
    let under = |place: &Rect, k: usize| spots[k].iter().filter(|&&s| place.holds(s)).count();
    let hidden = |place: &Rect| (under(place, 0), under(place, 1));
    let places = corners(&axes.frame, width, height, 0.6 * size);
    let place = places.into_iter().min_by_key(hidden).unwrap_or(axes.frame);
    on.area(&place.corners(), Fill::new(Colour::WHITE, 0.85));
    on.line(&place.outline(), Pen::solid(Colour::FAINT, size / 14.0));
    for (i, mark) in named.iter().enumerate() {
        let y = place.top + (1.45 * i as f64 + 0.97) * size;
        let [from, to] = [0.6, 2.8].map(|right| [place.left + right * size, y]);
        mark.draw_sample(on, [from, to], size);
        let at = [place.left + 3.4 * size, y + 0.36 * size];
        on.text(at, &mark.series.name, Lettering::new(size, Anchor::Start));
    }
}

/// Right top, left top, right bottom, left bottom.
fn corners(frame: &Rect, width: f64, height: f64, gap: f64) -> [Rect; 4] {
    let rights = [frame.right - gap, frame.left + gap + width];
    let bottoms = [frame.top + gap + height, frame.bottom - gap];
    [0, 1, 2, 3].map(|i| {
        let (right, bottom) = (rights[i % 2], bottoms[i / 2]);
        Rect::between([right - width, bottom - height], [right, bottom])
    })
}

/// Spots along all series, close enough together to find those that a box hides.
fn visited<'a>(marks: impl Iterator<Item = &'a Mark<'a>>, axes: &Axes) -> Vec<Spot> {
    let step = axes.size;
    let mut spots = Vec::new();
    for mark in marks {
        for stretch in mark.stretches(axes) {
            spots.extend(&stretch);
            if mark.series.style == Style::Markers {
                continue;
            }
            for ends in stretch.windows(2) {
                let d = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
                let parts = (d[0].hypot(d[1]) / step).min(1e3) as usize;
                let at = |i: usize| i as f64 / (parts + 1) as f64;
                let between = (1..=parts).map(at);
                spots.extend(between.map(|t| [ends[0][0] + t * d[0], ends[0][1] + t * d[1]]));
            }
        }
    }
    spots
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_ends_and_extremes() {
        let wave = |i: usize| [i as f64 / 100.0, (i as f64 / 7.0).sin()];
        let line: Vec<Spot> = (0..100_000).map(wave).collect();
        let thin = thinned(&line);
        assert!(thin.len() <= 4 * 1000);
        assert_eq!((thin[0], thin.last()), (line[0], line.last()));
        let top = |l: &[Spot]| l.iter().map(|s| s[1]).fold(0.0, f64::max);
        assert_eq!(top(&thin), top(&line));
    }
}
