//! The particles of a picture as discs.

use crate::drawing::axes::Axes;
use crate::drawing::canvas::Canvas;
use crate::drawing::colour::{Colour, SERIES};
use crate::drawing::draw_target::Fill;
use crate::drawing::picture::{Picture, View};
use crate::drawing::relief::{Relief, project};

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
            let value = self.values[i];
            let colour = self.colour_of(value, [lo, hi]);
            if x.is_finite() && y.is_finite() {
                let (spot, radius) = (axes.spot(x, y), radius(i));
                let fill = Fill::solid(colour);
                // A rim separates spheres of one colour.
                let rim = if self.diameters.is_empty() {
                    0.0
                } else {
                    0.1 * radius
                };
                if rim > 0.0 {
                    let dark = Fill::solid(colour.darker());
                    canvas.clipped_disc(spot, radius, dark, &axes.frame);
                }
                canvas.clipped_disc(spot, radius - rim, fill, &axes.frame);
            }
        }
    }

    /// The particles as one surface, seen from above.
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
