//! A frame with ticks: the part that pictures and plots have in common.

use crate::drawing::colour::Colour;
use crate::drawing::draw_target::{Anchor, DrawTarget, Lettering, Pen, Rect, Spot};
use crate::drawing::text;
use crate::drawing::ticks::{self, Ticks};

#[derive(Clone, Debug)]
pub(crate) struct PlotAxis {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) log: bool,
    pub(crate) label: String,
}

impl PlotAxis {
    /// Position of `value` between the ends, from 0 to 1.
    pub(crate) fn place(&self, value: f64) -> f64 {
        if self.log {
            (value / self.lo).ln() / (self.hi / self.lo).ln()
        } else {
            (value - self.lo) / (self.hi - self.lo)
        }
    }

    pub(crate) fn ticks(&self, wanted: usize) -> Ticks {
        let ticks = if self.log {
            ticks::logarithmic
        } else {
            ticks::linear
        };
        ticks(self.lo, self.hi, wanted)
    }
}

/// Two axes around a rectangle.
#[derive(Clone, Debug)]
pub(crate) struct Axes {
    pub(crate) frame: Rect,
    pub(crate) x: PlotAxis,
    pub(crate) y: PlotAxis,
    /// Font size of the tick labels in pixels; all lengths go with it.
    pub(crate) size: f64,
    pub(crate) grid: bool,
}

impl Axes {
    /// The spot of the point (`x`, `y`) in axis units.
    pub(crate) fn spot(&self, x: f64, y: f64) -> Spot {
        let f = &self.frame;
        let right = f.left + self.x.place(x) * f.width();
        [right, f.bottom - self.y.place(y) * f.height()]
    }

    /// The middle of the column of pixels at `x`.
    fn column(&self, x: f64) -> f64 {
        crisp(self.spot(x, self.y.lo)[0])
    }

    /// The middle of the row of pixels at `y`.
    fn row(&self, y: f64) -> f64 {
        crisp(self.spot(self.x.lo, y)[1])
    }

    fn x_ticks(&self) -> Ticks {
        let wanted = ticks_within(self.frame.width() / (6.5 * self.size));
        self.x.ticks(wanted)
    }

    fn y_ticks(&self) -> Ticks {
        y_ticks(&self.y, self.frame.height(), self.size)
    }

    /// Grid lines, to be drawn below the content.
    pub(crate) fn draw_grid(&self, on: &mut dyn DrawTarget) {
        if !self.grid {
            return;
        }
        let pen = Pen::solid(Colour::FAINT, self.size / 18.0);
        let f = self.frame;
        for at in self.x_ticks().major.iter().map(|(x, _)| self.column(*x)) {
            on.line(&[[at, f.top], [at, f.bottom]], pen);
        }
        for at in self.y_ticks().major.iter().map(|(y, _)| self.row(*y)) {
            on.line(&[[f.left, at], [f.right, at]], pen);
        }
    }

    /// Frame, ticks and labels, to be drawn above the content.
    pub(crate) fn draw(&self, on: &mut dyn DrawTarget) {
        let (f, size) = (self.frame, self.size);
        let pen = Pen::solid(Colour::INK, size / 16.0);
        let [a, b, c, d] = f.corners().map(|[x, y]| [crisp(x), crisp(y)]);
        on.line(&[a, b, c, d, a], pen);
        let [long, short] = [size * 0.35, size * 0.2];
        let middle = Lettering::new(size, Anchor::Middle);
        let end = Lettering::new(size, Anchor::End);

        let ticks = self.x_ticks();
        for (x, label) in &ticks.major {
            let at = self.column(*x);
            on.line(&[[at, f.bottom], [at, f.bottom + long]], pen);
            on.text([at, f.bottom + 1.5 * size], label, middle);
        }
        for at in ticks.minor.iter().map(|x| self.column(*x)) {
            on.line(&[[at, f.bottom], [at, f.bottom + short]], pen);
        }
        let below = f.bottom + 2.85 * size;
        let centre = [(f.left + f.right) / 2.0, below];
        on.text(centre, &self.x.label, middle);
        if let Some(factor) = &ticks.factor {
            on.text([f.right, below], factor, end);
        }

        let ticks = self.y_ticks();
        for (y, label) in &ticks.major {
            let at = self.row(*y);
            on.line(&[[f.left - long, at], [f.left, at]], pen);
            on.text([f.left - 0.55 * size, at + 0.36 * size], label, end);
        }
        for at in ticks.minor.iter().map(|y| self.row(*y)) {
            on.line(&[[f.left - short, at], [f.left, at]], pen);
        }
        let left = f.left - label_room(&ticks, size) + 1.2 * size;
        let centre = [left, (f.top + f.bottom) / 2.0];
        on.text(centre, &self.y.label, middle.upwards());
        if let Some(factor) = &ticks.factor {
            on.text([f.left, f.top - 0.45 * size], factor, middle);
        }
    }
}

/// Pixels that the tick labels and the label of a vertical axis take.
pub(crate) fn left_room(axis: &PlotAxis, height: f64, size: f64) -> f64 {
    label_room(&y_ticks(axis, height, size), size)
}

fn label_room(ticks: &Ticks, size: f64) -> f64 {
    let labels = ticks.major.iter().map(|(_, label)| label.as_str());
    text::widest(labels, size) + 2.4 * size
}

fn y_ticks(axis: &PlotAxis, height: f64, size: f64) -> Ticks {
    axis.ticks(ticks_within(height / (3.6 * size)))
}

/// A number of ticks for which there is room, but no more than are useful.
fn ticks_within(room: f64) -> usize {
    room.clamp(2.0, 9.0) as usize
}

/// The middle of the pixel that holds `x`, where thin lines stay sharp.
pub(crate) fn crisp(x: f64) -> f64 {
    x.floor() + 0.5
}

/// True if an axis can show `value`.
pub(crate) fn shown(value: f64, log: bool) -> bool {
    // Beyond these bounds a range may overflow.
    value.is_finite() && value.abs() < 1e150 && (!log || value > 1e-150)
}
