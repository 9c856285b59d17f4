//! A particle field as a PNG picture.
//!
//! Particles are discs of their own diameter, coloured by a field, between walls drawn as dark lines, with axes in
//! metres and a colour bar. Discs of a few pixels are drawn up to √2 times larger, so that a full lattice shows its
//! field and not the gaps between the discs. Spheres in 3D are seen along +y: the drawing is the x–z plane, and of
//! particles behind each other the one with the least y is on top; a fluid in 3D is seen from above and shows its
//! surface.

use std::path::Path;

use sph_core::bounds;

use crate::drawing::axes::{Axes, PlotAxis, View, draw_compass, left_room, project};
use crate::drawing::canvas::{Canvas, SIDES};
use crate::drawing::colour::{Colour, ColourMap};
use crate::drawing::colour_bar::ColourBar;
use crate::drawing::draw_target::{Anchor, DrawTarget, Fill, Lettering, Pen, Rect, Spot};
use crate::drawing::extent;
use crate::drawing::text;
use crate::drawing::ticks::{time_stamp, widened};
use crate::error::{IoError, Result};

/// A particle field and how it is to be drawn.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// use sph_io::Picture;
/// let points = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0]];
/// let picture = Picture {
///     title: "Two particles",
///     label: "pressure [Pa]",
///     diameter: 0.1,
///     ..Picture::new(&points, &[0.0, 10.0])
/// };
/// picture.save(folder.path().join("two.png"))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Picture<'a> {
    /// Above the picture, to the left.
    pub title: &'a str,
    /// Simulated time in seconds, above the picture, to the right.
    pub time: Option<f64>,
    /// Beside the colour bar: name and unit of the field.
    pub label: &'a str,
    /// Positions in metres. Particles with a non-finite one are left out.
    pub points: &'a [[f64; 3]],
    /// The field, one value per particle; non-finite ones are drawn in magenta.
    pub values: &'a [f64],
    /// Diameter of the discs in metres: the particle spacing.
    pub diameter: f64,
    /// Diameters of the particles in metres where they differ, one per particle; else empty.
    pub diameters: &'a [f64],
    /// Wall segments by their ends in metres.
    pub walls: &'a [[[f64; 3]; 2]],
    /// Lines over the particles, by their points in metres: streamlines, tracks.
    pub lines: &'a [Vec<[f64; 3]>],
    /// Coloured lines over all of these.
    pub strokes: &'a [(Vec<[f64; 3]>, Colour)],
    /// Texts and the places in metres of their left ends.
    pub labels: &'a [([f64; 3], String)],
    /// Names where the values are 0, 1, …: they stand beside their colours in place of the colour bar.
    pub classes: &'a [String],
    /// Plane of the drawing.
    pub view: View,
    /// Section of the plane, as `[[left, right], [bottom, top]]` in metres; if absent, the walls and the particles that
    /// are not far outside them.
    pub window: Option<[[f64; 2]; 2]>,
    /// A place in metres that is ringed, if any.
    pub ring: Option<[f64; 3]>,
    /// Values at the ends of the colour bar; if absent, the least and the largest.
    pub range: Option<[f64; 2]>,
    /// Colours of the field.
    pub colours: ColourMap,
    /// Width in pixels, from 200 to 8192; the height follows.
    pub width: u32,
}

impl<'a> Picture<'a> {
    /// A picture of a field with everything else at its default: no texts and
    /// walls, automatic window and range, 1200 pixels wide.
    pub fn new(points: &'a [[f64; 3]], values: &'a [f64]) -> Self {
        Self {
            points,
            values,
            width: 1200,
            ..Self::default()
        }
    }

    /// Draws the picture and writes it to `path`, all or nothing.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        let drawn = self.draw().map_err(|p| IoError::input(path, p));
        drawn?.save(path)
    }

    fn draw(&self) -> std::result::Result<Canvas, String> {
        self.check()?;
        let range = match self.classes.len() {
            0 => self.range.unwrap_or_else(|| self.automatic_range()),
            count => [0.0, count as f64],
        };
        let width = self.width.clamp(*SIDES.start(), *SIDES.end());
        // At 1200 pixels letters of 20; never too small to read.
        let size = (f64::from(width) / 60.0).max(9.0);
        let any = |outside: &dyn Fn(f64) -> bool| self.values.iter().any(|&v| outside(v));
        let bar = ColourBar {
            range,
            colours: self.colours,
            label: self.label,
            classes: self.classes,
            beyond: [any(&|v| v < range[0]), any(&|v| v > range[1])],
            size,
        };
        let (axes, height) = self.layout(f64::from(width), size, bar.room());
        let mut canvas = Canvas::new(width, height).ok_or("no memory for the picture")?;
        if self.view != View::Plane {
            self.draw_walls(&mut canvas, &axes);
        }
        self.draw_particles(&mut canvas, &axes, range);
        if self.view == View::Plane {
            self.draw_walls(&mut canvas, &axes);
        }
        self.draw_lines(&mut canvas, &axes);
        if let Some(place) = self.ring {
            self.draw_ring(&mut canvas, &axes, place);
        }
        self.draw_strokes(&mut canvas, &axes);
        let frame = &axes.frame;
        match self.view {
            View::Above => draw_compass(&mut canvas, &axes),
            _ => axes.draw(&mut canvas),
        }
        bar.draw(&mut canvas, frame);
        let time = self.time.map(time_stamp).unwrap_or_default();
        let taken = text::width(&time, size) + if time.is_empty() { 0.0 } else { size };
        let title = text::fitted(self.title, 1.15 * size, frame.right - frame.left - taken);
        let start = Lettering::new(1.15 * size, Anchor::Start);
        canvas.text([frame.left, 1.5 * size], &title, start);
        let end = Lettering::new(size, Anchor::End);
        canvas.text([frame.right, 1.5 * size], &time, end);
        Ok(canvas)
    }

    fn check(&self) -> std::result::Result<(), String> {
        let (points, values) = (self.points.len(), self.values.len());
        let sizes = self.diameters.len();
        let sound = |d: &&f64| d.is_finite() && **d >= 0.0;
        let mut diameters = self.diameters.iter().chain([&self.diameter]);
        let bad = diameters.find(|d| !sound(d));
        let rising = |r: &[f64; 2]| r[0] < r[1] && (r[1] - r[0]).is_finite();
        let range = self.range.filter(|r| !rising(r));
        let window = self.window.filter(|w| !w.iter().all(rising));
        let faults = [
            (points != values).then(|| format!("{values} values for {points} particles")),
            bad.map(|bad| format!("a diameter of {bad} m")),
            (sizes != 0 && sizes != points)
                .then(|| format!("{sizes} diameters for {points} particles")),
            range.map(|range| format!("a colour range of {range:?}")),
            window.map(|window| format!("a window of {window:?} m")),
        ];
        faults.into_iter().flatten().next().map_or(Ok(()), Err)
    }

    /// The axes in their place, and the height of the picture in pixels.
    fn layout(&self, width: f64, size: f64, right: f64) -> (Axes, u32) {
        let flat = |p: &[f64; 3]| self.flat(*p);
        let window = self.window.unwrap_or_else(|| {
            let walls = self.walls.as_flattened().iter().map(flat);
            extent::window(self.points.iter().map(flat), walls, self.diameter)
        });
        let [w, h] = window.map(|[lo, hi]| hi - lo);
        let upwards = match self.view {
            View::Plane => "y [m]",
            View::Front | View::Above => "z [m]",
        };
        let axis = |[lo, hi]: [f64; 2], label: &str| PlotAxis {
            lo,
            hi,
            log: false,
            label: label.into(),
        };
        let placed = |left: f64, top: f64| {
            let wide = width - left - right;
            // Very flat and very tall scenes get a frame with room to spare.
            let high = (wide * h / w).clamp(9.0 * size, 1.4 * width).round();
            let scale = (wide / w).min(high / h);
            let fitted = |[lo, hi]: [f64; 2], pixels: f64| {
                let spare = (pixels / scale - (hi - lo)) / 2.0;
                [lo - spare, hi + spare]
            };
            Axes {
                frame: Rect::between([left, top], [left + wide, top + high]),
                x: axis(fitted(window[0], wide), "x [m]"),
                y: axis(fitted(window[1], high), upwards),
                size,
                grid: false,
            }
        };
        // How wide the tick labels are depends on the frame beside them.
        let mut axes = placed(4.0 * size, 0.0);
        for _ in 0..3 {
            let top = axes.y.ticks(5).factor.map_or(2.3, |_| 3.6);
            let left = left_room(&axes.y, axes.frame.height(), size);
            axes = placed(left, top * size);
        }
        let height = (axes.frame.bottom + 3.4 * size).ceil() as u32;
        (axes, height)
    }

    fn draw_walls(&self, canvas: &mut Canvas, axes: &Axes) {
        let pen = Pen::solid(Colour::WALL, axes.size / 7.0);
        for ends in self.walls {
            self.draw_line(canvas, axes, ends, pen);
        }
    }

    fn draw_line(&self, canvas: &mut Canvas, axes: &Axes, line: &[[f64; 3]], pen: Pen) {
        let spots = line.iter().map(|p| self.flat(*p));
        let spots: Vec<_> = spots.map(|[x, y]| axes.spot(x, y)).collect();
        draw_within(canvas, &axes.frame, &spots, pen);
    }

    /// Dark lines with a light edge, which shows on dark ground.
    fn draw_lines(&self, canvas: &mut Canvas, axes: &Axes) {
        for (colour, width) in [(Colour::WHITE, 0.16), (Colour::INK, 0.08)] {
            let pen = Pen::solid(colour, width * axes.size);
            for line in self.lines {
                self.draw_line(canvas, axes, line, pen);
            }
        }
    }

    /// Coloured lines with a light edge, and texts.
    fn draw_strokes(&self, canvas: &mut Canvas, axes: &Axes) {
        for (points, colour) in self.strokes {
            for (colour, width) in [(Colour::WHITE, 0.2), (*colour, 0.11)] {
                self.draw_line(canvas, axes, points, Pen::solid(colour, width * axes.size));
            }
        }
        let size = 0.8 * axes.size;
        for (place, text) in self.labels {
            let [x, y] = self.flat(*place);
            let [x, y] = axes.spot(x, y);
            let wide = text::width(text, size);
            // Texts do not leave the frame.
            let frame = &axes.frame;
            let x = (x + 0.3 * size).min(frame.right - wide).max(frame.left);
            let y = (y - 0.3 * size).clamp(frame.top + size, frame.bottom);
            let paper = Rect::between([x, y - 0.85 * size], [x + wide, y + 0.25 * size]);
            canvas.area(&paper.corners(), Fill::new(Colour::WHITE, 0.7));
            canvas.text([x, y], text, Lettering::new(size, Anchor::Start));
        }
    }

    /// A ring with four strokes towards it, to be found among many particles.
    fn draw_ring(&self, canvas: &mut Canvas, axes: &Axes, place: [f64; 3]) {
        let [x, y] = self.flat(place);
        let centre = axes.spot(x, y);
        if !(centre.iter().all(|c| c.is_finite()) && axes.frame.holds(centre)) {
            return;
        }
        let scale = axes.frame.width() / (axes.x.hi - axes.x.lo);
        let radius = (0.75 * self.diameter * scale).max(0.5 * axes.size);
        let at = |r: f64, turn: f64| {
            let angle = std::f64::consts::TAU * turn;
            [centre[0] + r * angle.cos(), centre[1] + r * angle.sin()]
        };
        let arcs = (0..48).map(|k| [k, k + 1].map(|k| at(radius, f64::from(k) / 48.0)));
        let strokes = (0..4).map(|k| {
            let turn = f64::from(k) / 4.0;
            [at(radius, turn), at(radius + 1.2 * axes.size, turn)]
        });
        let lines: Vec<[Spot; 2]> = arcs.chain(strokes).collect();
        // A light edge shows it on dark ground.
        for (colour, width) in [(Colour::WHITE, 0.3), (Colour::RING, 0.15)] {
            let pen = Pen::solid(colour, width * axes.size);
            for line in &lines {
                draw_within(canvas, &axes.frame, line, pen);
            }
        }
    }

    /// The least and the largest finite value, symmetric for signed colours.
    fn automatic_range(&self) -> [f64; 2] {
        let finite = self.values.iter().filter(|v| v.is_finite());
        let [[mut lo], [mut hi]] = bounds(finite.map(|v| [*v]));
        if lo > hi {
            return [0.0, 1.0];
        }
        // Keeps the extent finite.
        let limit = f64::MAX / 4.0;
        (lo, hi) = (lo.max(-limit), hi.min(limit));
        if self.colours == ColourMap::CoolWarm {
            hi = hi.max(-lo);
            lo = -hi;
        }
        widened(lo, hi)
    }

    pub(crate) fn flat(&self, [x, y, z]: [f64; 3]) -> [f64; 2] {
        match self.view {
            View::Plane => [x, y],
            View::Front => [x, z],
            View::Above => project([x, y, z]).0,
        }
    }
}

/// The parts of a line that lie in the frame.
fn draw_within(canvas: &mut Canvas, frame: &Rect, spots: &[Spot], pen: Pen) {
    for ends in spots.windows(2) {
        if let Some(inside) = frame.clipped(ends[0], ends[1]) {
            canvas.line(&inside, pen);
        }
    }
}
