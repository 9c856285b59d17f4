//! Names beside their colours.

use crate::drawing::canvas::Canvas;
use crate::drawing::colour::{Colour, SERIES};
use crate::drawing::draw_target::{Anchor, DrawTarget, Lettering, Pen, Rect};
use crate::drawing::text;

/// A list of names, one below the other, to the right of the frame.
pub(crate) struct ClassBar<'a> {
    pub(crate) names: &'a [String],
    pub(crate) size: f64,
}

impl ClassBar<'_> {
    /// Pixels that the list takes to the right of the frame.
    pub(crate) fn room(&self) -> f64 {
        let names = self.names.iter().map(String::as_str);
        text::widest(names, self.size) + 3.2 * self.size
    }

    pub(crate) fn draw(&self, on: &mut Canvas, frame: &Rect) {
        let size = self.size;
        for (k, name) in self.names.iter().enumerate() {
            let top = frame.top + 1.6 * k as f64 * size;
            let block = Rect {
                left: frame.right + 0.8 * size,
                right: frame.right + 1.8 * size,
                top,
                bottom: top + size,
            };
            on.block(block, SERIES[k % SERIES.len()]);
            let [a, b, c, d] = block.corners();
            on.line(&[a, b, c, d, a], Pen::solid(Colour::INK, size / 16.0));
            let start = Lettering::new(size, Anchor::Start);
            on.text(
                [block.right + 0.4 * size, block.bottom - 0.14 * size],
                name,
                start,
            );
        }
    }
}
