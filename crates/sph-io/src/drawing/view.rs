//! Planes of drawings: places on the screen, and the directions of the axes.

use crate::drawing::axes::Axes;
use crate::drawing::canvas::Canvas;
use crate::drawing::colour::Colour;
use crate::drawing::draw_target::{Anchor, DrawTarget, Lettering, Pen};

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
