//! The trait of targets of a drawing.
//!
//! Coordinates are in pixels from the top left corner.

use crate::drawing::colour::Colour;

/// A point on the surface.
pub(crate) type Spot = [f64; 2];

#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    pub(crate) colour: Colour,
    /// Width in pixels.
    pub(crate) width: f64,
    pub(crate) dashed: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Fill {
    pub(crate) colour: Colour,
    /// From 0 to 1.
    pub(crate) opacity: f64,
}

/// Part of a text that stands at its spot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Lettering {
    /// Font size in pixels.
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    /// Reading upwards instead of to the right.
    pub(crate) upwards: bool,
}

/// Pixels or a vector file.
pub(crate) trait DrawTarget {
    fn line(&mut self, points: &[Spot], pen: Pen);
    fn area(&mut self, outline: &[Spot], fill: Fill);
    fn disc(&mut self, centre: Spot, radius: f64, fill: Fill);
    /// A text with its baseline through `at`.
    fn text(&mut self, at: Spot, text: &str, lettering: Lettering);
}

impl Pen {
    pub(crate) fn solid(colour: Colour, width: f64) -> Self {
        let dashed = false;
        Self {
            colour,
            width,
            dashed,
        }
    }
}

impl Fill {
    pub(crate) fn solid(colour: Colour) -> Self {
        Self::new(colour, 1.0)
    }

    pub(crate) fn new(colour: Colour, opacity: f64) -> Self {
        Self { colour, opacity }
    }
}

impl Lettering {
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self {
            size,
            anchor,
            upwards: false,
        }
    }

    pub(crate) fn upwards(self) -> Self {
        let upwards = true;
        Self { upwards, ..self }
    }
}

/// A rectangle on the surface, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) right: f64,
    pub(crate) bottom: f64,
}

impl Rect {
    /// One from its upper left to its lower right corner.
    pub(crate) fn between([left, top]: Spot, [right, bottom]: Spot) -> Self {
        Self {
            left,
            top,
            right,
            bottom,
        }
    }

    /// One from the corner on.
    pub(crate) fn sized(sides: [u32; 2]) -> Self {
        Self::between([0.0; 2], sides.map(f64::from))
    }

    pub(crate) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(crate) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(crate) fn corners(&self) -> [Spot; 4] {
        let ([left, right], [top, bottom]) = ([self.left, self.right], [self.top, self.bottom]);
        [[left, top], [right, top], [right, bottom], [left, bottom]]
    }

    /// The corners, the first of them again at the end.
    pub(crate) fn outline(&self) -> [Spot; 5] {
        let [a, b, c, d] = self.corners();
        [a, b, c, d, a]
    }

    pub(crate) fn holds(&self, [x, y]: Spot) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    /// The part of the line `a`–`b` inside (Liang and Barsky), if any.
    pub(crate) fn clipped(&self, a: Spot, b: Spot) -> Option<[Spot; 2]> {
        let d = [b[0] - a[0], b[1] - a[1]];
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        let sides = [
            (-d[0], a[0] - self.left),
            (d[0], self.right - a[0]),
            (-d[1], a[1] - self.top),
            (d[1], self.bottom - a[1]),
        ];
        for (speed, room) in sides {
            match speed {
                0.0 if room < 0.0 => return None,
                0.0 => {}
                _ if speed < 0.0 => from = from.max(room / speed),
                _ => to = to.min(room / speed),
            }
        }
        let at = |t: f64| [a[0] + t * d[0], a[1] + t * d[1]];
        (from <= to).then(|| [at(from), at(to)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_clipped_to_the_rectangle() {
        let rect = Rect::sized([2, 1]);
        let through = rect.clipped([-1.0, 0.5], [3.0, 0.5]);
        assert_eq!(through, Some([[0.0, 0.5], [2.0, 0.5]]));
        assert_eq!(rect.clipped([-1.0, 2.0], [3.0, 2.0]), None);
        assert_eq!(rect.clipped([3.0, 0.5], [4.0, 0.5]), None);
    }
}
