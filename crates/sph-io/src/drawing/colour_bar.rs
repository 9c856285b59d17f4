//! The scale beside a picture: of colours and numbers, or of names.

use crate::drawing::axes::crisp;
use crate::drawing::canvas::Canvas;
use crate::drawing::colour::{Colour, ColourMap, SERIES};
use crate::drawing::draw_target::{Anchor, DrawTarget, Fill, Lettering, Pen, Rect};
use crate::drawing::text;
use crate::drawing::ticks::{Ticks, linear};

/// A vertical colour scale with ticks and a label.
pub(crate) struct ColourBar<'a> {
    pub(crate) range: [f64; 2],
    pub(crate) colours: ColourMap,
    pub(crate) label: &'a str,
    /// Names in place of the scale, if there are any.
    pub(crate) classes: &'a [String],
    /// True for values below, and above, the range: pointed ends.
    pub(crate) beyond: [bool; 2],
    pub(crate) size: f64,
}

impl ColourBar<'_> {
    /// Pixels that the bar takes to the right of the frame.
    pub(crate) fn room(&self) -> f64 {
        let size = self.size;
        if !self.classes.is_empty() {
            let names = self.classes.iter().map(String::as_str);
            return text::widest(names, size) + 3.2 * size;
        }
        // With the most ticks it can have; fewer are never wider.
        let label = if self.label.is_empty() { 0.6 } else { 2.2 };
        2.6 * size + self.labels_width(&self.ticks(f64::INFINITY)) + label * size
    }

    pub(crate) fn draw(&self, on: &mut Canvas, frame: &Rect) {
        let size = self.size;
        if !self.classes.is_empty() {
            return self.draw_classes(on, frame);
        }
        let [below, above] = self.beyond.map(|tip| if tip { 0.9 * size } else { 0.0 });
        let [left, right] = [1.0, 2.1].map(|at| crisp(frame.right + at * size) - 0.5);
        let (top, bottom) = (crisp(frame.top) + above, crisp(frame.bottom) - below);
        let bar = Rect::between([left, top], [right, bottom]);
        let rows = bar.height().round() as usize;
        for row in 0..rows {
            let top = bar.top + row as f64;
            let at = 1.0 - (row as f64 + 0.5) / rows as f64;
            let strip = Rect::between([bar.left, top], [bar.right, top + 1.0]);
            on.block(strip, self.colours.at(at));
        }
        self.draw_outline(on, &bar);

        let [lo, hi] = self.range;
        let pen = Pen::solid(Colour::INK, size / 16.0);
        let start = Lettering::new(size, Anchor::Start);
        let ticks = self.ticks(frame.height());
        for (value, label) in &ticks.major {
            let at = crisp(bar.bottom - (value - lo) / (hi - lo) * bar.height());
            on.line(&[[bar.right, at], [bar.right + 0.3 * size, at]], pen);
            on.text([bar.right + 0.5 * size, at + 0.36 * size], label, start);
        }
        if let Some(factor) = &ticks.factor {
            on.text([bar.left, frame.top - 0.5 * size], factor, start);
        }
        let upwards = Lettering::new(size, Anchor::Middle).upwards();
        let right = bar.right + self.labels_width(&ticks) + 1.75 * size;
        let middle = (frame.top + frame.bottom) / 2.0;
        on.text([right, middle], self.label, upwards);
    }

    /// Pointed ends where values lie beyond, and the line around it all.
    fn draw_outline(&self, on: &mut Canvas, bar: &Rect) {
        let tip = 0.9 * self.size;
        let middle = (bar.left + bar.right) / 2.0;
        let [a, b, c, d] = bar.corners();
        // One pixel into the bar, so that no seam shows.
        let upper = [bar.left, bar.top + 1.0];
        let [a1, b1, c1, d1] = Rect::between(upper, [bar.right, bar.bottom - 1.0]).corners();
        let below = [middle, bar.bottom + tip];
        let above = [middle, bar.top - tip];
        let mut outline = vec![a];
        if self.beyond[1] {
            on.area(&[a1, a, above, b, b1], Fill::solid(self.colours.at(1.0)));
            outline.push(above);
        }
        outline.extend([b, c]);
        if self.beyond[0] {
            on.area(&[d1, d, below, c, c1], Fill::solid(self.colours.at(0.0)));
            outline.push(below);
        }
        outline.extend([d, a]);
        on.line(&outline, Pen::solid(Colour::INK, self.size / 16.0));
    }

    fn ticks(&self, height: f64) -> Ticks {
        let [lo, hi] = self.range;
        let wanted = (height / (3.2 * self.size)).clamp(2.0, 7.0);
        linear(lo, hi, wanted as usize)
    }

    fn labels_width(&self, ticks: &Ticks) -> f64 {
        let labels = ticks.major.iter().map(|(_, label)| label.as_str());
        text::widest(labels, self.size)
    }

    /// The names, one below the other.
    fn draw_classes(&self, on: &mut Canvas, frame: &Rect) {
        let size = self.size;
        for (k, name) in self.classes.iter().enumerate() {
            let top = frame.top + 1.6 * k as f64 * size;
            let right = [frame.right + 1.8 * size, top + size];
            let block = Rect::between([frame.right + 0.8 * size, top], right);
            on.block(block, SERIES[k % SERIES.len()]);
            on.line(&block.outline(), Pen::solid(Colour::INK, size / 16.0));
            let at = [block.right + 0.4 * size, block.bottom - 0.14 * size];
            on.text(at, name, Lettering::new(size, Anchor::Start));
        }
    }
}
