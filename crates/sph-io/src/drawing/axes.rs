//! A frame with ticks, the part that pictures and plots have in common, and planes of drawings with the directions of
//! the axes in them.

use crate::drawing::canvas::Canvas;
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
        match self.log {
            true => ticks::logarithmic(self.lo, self.hi, wanted),
            false => ticks::linear(self.lo, self.hi, wanted),
        }
    }
}

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

/// Angle of the x axis on the screen, and of the view above the horizontal: cosine and sine of 25° and 30°.
const TURN: [f64; 2] = [0.906_307_787, 0.422_618_262];
const TILT: [f64; 2] = [0.866_025_404, 0.5];

/// Plane of the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// x to the right, y upwards: 2D.
    #[default]
    Plane,
    /// x to the right, z upwards, seen along +y: 3D.
    Front,
    /// Seen from the front, the left and above, without perspective; the particles as one shaded surface: 3D.
    Above,
}

/// Place on the screen, and distance from it, m.
pub(crate) fn project([x, y, z]: [f64; 3]) -> ([f64; 2], f64) {
    let ([ct, st], [ce, se]) = (TURN, TILT);
    let away = -st * x + ct * y;
    ([ct * x + st * y, se * away + ce * z], ce * away - se * z)
}

/// The directions of the axes and a length, in the lower left corner.
pub(crate) fn draw_compass(on: &mut Canvas, axes: &Axes) {
    let (frame, size) = (&axes.frame, axes.size);
    let pen = Pen::solid(Colour::INK, size / 10.0);
    let origin = [frame.left - 1.6 * size, frame.bottom - 1.0 * size];
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let middle = Lettering::new(0.9 * size, Anchor::Middle);
    for (name, unit) in ["x", "y", "z"].into_iter().zip(units) {
        let [right, up] = project(unit).0;
        let at = |r: f64| [origin[0] + r * size * right, origin[1] - r * size * up];
        on.line(&[origin, at(2.2)], pen);
        let [x, y] = at(2.9);
        on.text([x, y + 0.3 * size], name, middle);
    }
    // A round length of about a fifth of the width.
    let scale = frame.width() / (axes.x.hi - axes.x.lo);
    let wide = 0.2 * frame.width() / scale;
    let unit = 10f64.powi(wide.log10().floor() as i32);
    let mut lengths = [5.0, 2.0, 1.0].into_iter().map(|f| f * unit);
    let length = lengths.find(|l| *l <= wide).unwrap_or(unit);
    let y = frame.bottom + 1.4 * size;
    let left = frame.left + 3.0 * size;
    let ends = [left, left + length * scale];
    on.line(&[[ends[0], y], [ends[1], y]], pen);
    for x in ends {
        on.line(&[[x, y - 0.3 * size], [x, y + 0.3 * size]], pen);
    }
    // Along the screen: lengths across the view are true.
    let text = format!("{length} m");
    on.text([0.5 * (ends[0] + ends[1]), y + 1.3 * size], &text, middle);
}
