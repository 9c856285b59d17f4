//! The particles of a picture: discs, or in space one surface, seen from the front, the left and above.
//!
//! Of a surface every particle is a sphere of 1.5 times its diameter. Depths of the nearest spheres are made smooth over
//! about a diameter, and light from the upper left shades what their slopes are.

use crate::drawing::axes::{Axes, View, project};
use crate::drawing::canvas::Canvas;
use crate::drawing::colour::{Colour, SERIES};
use crate::drawing::draw_target::{Fill, Spot};
use crate::drawing::picture::Picture;

/// Diameter of the spheres over that of the particles.
const SWOLLEN: f64 = 1.5;
/// Number of times that depths are averaged.
const PASSES: usize = 3;
/// Direction to the light: to the right, upwards, away from the eye.
const LIGHT: [f64; 3] = [-0.35, 0.75, -0.56];
/// Brightness of surfaces turned away from the light.
const DARK: f64 = 0.45;

impl Picture<'_> {
    pub(crate) fn draw_particles(&self, canvas: &mut Canvas, axes: &Axes, [lo, hi]: [f64; 2]) {
        if self.view == View::Above {
            return self.draw_surface(canvas, axes, [lo, hi]);
        }
        let scale = axes.frame.width() / (axes.x.hi - axes.x.lo);
        let radius = |i: usize| match self.diameters.get(i) {
            // Spheres of their own size are drawn as they are.
            Some(diameter) => 0.5 * diameter * scale,
            None => drawn_radius(0.5 * self.diameter * scale),
        };
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        if self.view == View::Front {
            order.sort_by(|&a, &b| self.points[b][1].total_cmp(&self.points[a][1]));
        }
        for i in order {
            let [x, y] = self.flat(self.points[i]);
            let colour = self.colour_of(self.values[i], [lo, hi]);
            if x.is_finite() && y.is_finite() {
                let (spot, radius) = (axes.spot(x, y), radius(i));
                let fill = Fill::solid(colour);
                // A rim separates spheres of one colour.
                let share = if self.diameters.is_empty() { 0.0 } else { 0.1 };
                let rim = share * radius;
                if rim > 0.0 {
                    let dark = Fill::solid(colour.darker());
                    canvas.clipped_disc(spot, radius, dark, &axes.frame);
                }
                canvas.clipped_disc(spot, radius - rim, fill, &axes.frame);
            }
        }
    }

    fn draw_surface(&self, canvas: &mut Canvas, axes: &Axes, range: [f64; 2]) {
        let mut relief = Relief::within(axes);
        for (i, point) in self.points.iter().enumerate() {
            let diameter = self.diameters.get(i).copied().unwrap_or(self.diameter);
            let ([x, y], depth) = project(*point);
            relief.particle(axes.spot(x, y), (depth, diameter), self.values[i]);
        }
        relief.draw(canvas, self.diameter, |value| self.colour_of(value, range));
    }

    /// The colour of a value between the ends of a range.
    pub(crate) fn colour_of(&self, value: f64, [lo, hi]: [f64; 2]) -> Colour {
        match (value.is_finite(), self.classes) {
            (false, _) => Colour::MISSING,
            (true, []) => self.colours.at((value - lo) / (hi - lo)),
            (true, _) => SERIES[value as usize % SERIES.len()],
        }
    }
}

/// The radius in pixels at which a disc of true radius `r` pixels is drawn:
/// touching along the diagonals of a lattice if small, true if large.
fn drawn_radius(r: f64) -> f64 {
    let small = ((6.0 - r) / 3.0).clamp(0.0, 1.0);
    r * (1.0 + small * (std::f64::consts::SQRT_2 - 1.0))
}

/// Distance (m) of the nearest surface behind each pixel of a frame, infinite if there is none, and its value.
struct Relief {
    width: usize,
    height: usize,
    depth: Vec<f64>,
    value: Vec<f64>,
    corner: Spot,
    /// Pixels per metre.
    scale: f64,
}

impl Relief {
    /// Nothing yet, within the frame of some axes.
    fn within(axes: &Axes) -> Self {
        let frame = &axes.frame;
        let (width, height) = (frame.width() as usize, frame.height() as usize);
        Self {
            width,
            height,
            depth: vec![f64::INFINITY; width * height],
            value: vec![0.0; width * height],
            corner: [frame.left, frame.top],
            scale: frame.width() / (axes.x.hi - axes.x.lo),
        }
    }

    /// Draws the visible surface of particles of a diameter, in colours of their values.
    fn draw(&mut self, on: &mut Canvas, diameter: f64, colour: impl Fn(f64) -> Colour) {
        let reach = (0.5 * diameter * self.scale).round().clamp(1.0, 12.0) as usize;
        for _ in 0..PASSES {
            self.smooth(reach, 2.0 * diameter);
        }
        let corner = self.corner.map(|x| x.round() as usize);
        for j in 0..self.height {
            for i in 0..self.width {
                let k = j * self.width + i;
                if self.depth[k].is_finite() {
                    let brightness = self.brightness([i, j], diameter);
                    let Colour(parts) = colour(self.value[k]);
                    let lit = parts.map(|part| (f64::from(part) * brightness).min(255.0) as u8);
                    on.blend([corner[0] + i, corner[1] + j], Colour(lit), 1.0);
                }
            }
        }
    }

    /// The sphere of a particle of a diameter (m) at a spot.
    fn particle(&mut self, spot: Spot, (depth, diameter): (f64, f64), value: f64) {
        let [x, y] = [0, 1].map(|k| spot[k] - self.corner[k]);
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let radius = (0.5 * SWOLLEN * diameter * self.scale).max(0.75);
        let span = |at: f64, side: usize| {
            let end = side as f64;
            (at - radius).clamp(0.0, end) as usize..(at + radius + 1.0).clamp(0.0, end) as usize
        };
        for j in span(y, self.height) {
            for i in span(x, self.width) {
                let [dx, dy] = [i as f64 + 0.5 - x, j as f64 + 0.5 - y];
                let rest = radius * radius - dx * dx - dy * dy;
                let near = depth - rest.max(0.0).sqrt() / self.scale;
                let k = j * self.width + i;
                if rest >= 0.0 && near < self.depth[k] {
                    self.depth[k] = near;
                    self.value[k] = value;
                }
            }
        }
    }

    /// Averages depths and values over `reach` pixels to all sides, of those that are further away by at most `step` m.
    fn smooth(&mut self, reach: usize, step: f64) {
        for [right, down] in [[1, 0], [0, 1]] {
            let (depth, value) = (self.depth.clone(), self.value.clone());
            for j in 0..self.height {
                for i in 0..self.width {
                    let k = j * self.width + i;
                    if !depth[k].is_finite() {
                        continue;
                    }
                    let (at, side) = [(i, self.width), (j, self.height)][down];
                    let stride = right + down * self.width;
                    let from = k - at.min(reach) * stride;
                    let count = at.min(reach) + 1 + (side - 1 - at).min(reach);
                    let mut sum = [0.0; 3];
                    for n in 0..count {
                        let m = from + n * stride;
                        if (depth[m] - depth[k]).abs() < step && value[m].is_finite() {
                            sum = [sum[0] + 1.0, sum[1] + depth[m], sum[2] + value[m]];
                        }
                    }
                    if sum[0] > 0.0 {
                        self.depth[k] = sum[1] / sum[0];
                        self.value[k] = sum[2] / sum[0];
                    }
                }
            }
        }
    }

    /// Brightness of the surface at a pixel, from its slope; ridges before something far stay as they are.
    fn brightness(&self, [i, j]: [usize; 2], diameter: f64) -> f64 {
        let depth = |i: usize, j: usize| self.depth[j * self.width + i];
        let here = depth(i, j);
        let slope = |a: f64, b: f64| {
            let one = |d: f64| (d.abs() < diameter).then_some(d * self.scale);
            match (one(here - a), one(b - here)) {
                (Some(a), Some(b)) => 0.5 * (a + b),
                (a, b) => a.or(b).unwrap_or(0.0),
            }
        };
        let (last_i, last_j) = (self.width - 1, self.height - 1);
        let across = slope(depth(i.saturating_sub(1), j), depth((i + 1).min(last_i), j));
        let down = slope(depth(i, j.saturating_sub(1)), depth(i, (j + 1).min(last_j)));
        // The distance grows to the right by `across` and upwards by −`down`: so points the normal to the eye.
        let normal = [across, -down, -1.0];
        let size = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cosine: f64 = normal.iter().zip(LIGHT).map(|(n, l)| n * l).sum::<f64>() / size;
        DARK + (1.15 - DARK) * cosine.max(0.0)
    }
}
