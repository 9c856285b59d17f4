//! Pixels: a surface that becomes a PNG file.

use std::path::Path;

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

use crate::drawing::colour::Colour;
use crate::drawing::draw_target::{DrawTarget, Fill, Lettering, Pen, Rect, Spot};
use crate::drawing::text;
use crate::error::{IoError, Result};
use crate::files::disk::write_whole;

/// Sides in pixels that a picture may have.
pub(crate) const SIDES: std::ops::RangeInclusive<u32> = 200..=8192;

pub(crate) struct Canvas {
    map: Pixmap,
}

impl Canvas {
    /// A canvas of `width` by `height` pixels, both within [`SIDES`].
    pub(crate) fn new(width: u32, height: u32) -> Option<Self> {
        let side = |s: u32| s.clamp(*SIDES.start(), *SIDES.end());
        let mut map = Pixmap::new(side(width), side(height))?;
        map.fill(Color::WHITE);
        Some(Self { map })
    }

    pub(crate) fn save(&self, path: &Path) -> Result<()> {
        let png = self.map.encode_png();
        let png = png.map_err(|e| IoError::write(path, std::io::Error::other(e)))?;
        write_whole(path, png)
    }

    /// A filled circle, leaving out the part outside of `clip`.
    pub(crate) fn clipped_disc(&mut self, [x, y]: Spot, radius: f64, fill: Fill, clip: &Rect) {
        // A disc smaller than a pixel is a fainter pixel.
        let drawn = radius.max(0.6);
        let opacity = fill.opacity * (radius / drawn).powi(2);
        let reach = drawn + 0.5;
        let span = |at: f64, lo: f64, hi: f64, side: u32| {
            let from = (at - reach).max(lo).floor().clamp(0.0, f64::from(side));
            let to = (at + reach).min(hi).ceil().clamp(0.0, f64::from(side));
            from as usize..to as usize
        };
        let columns = span(x, clip.left, clip.right, self.map.width());
        let solid = (drawn - 0.5).max(0.0).powi(2);
        for j in span(y, clip.top, clip.bottom, self.map.height()) {
            let dy = j as f64 + 0.5 - y;
            for i in columns.clone() {
                let dx = i as f64 + 0.5 - x;
                let square = dx * dx + dy * dy;
                let whole = square <= solid;
                let cover = if whole { 1.0 } else { reach - square.sqrt() };
                if cover > 0.0 {
                    self.blend([i, j], fill.colour, cover.min(1.0) * opacity);
                }
            }
        }
    }

    /// Fills whole pixels.
    pub(crate) fn block(&mut self, rect: Rect, colour: Colour) {
        let span = |from: f64, to: f64, side: u32| {
            let end = f64::from(side);
            from.round().clamp(0.0, end) as usize..to.round().clamp(0.0, end) as usize
        };
        let columns = span(rect.left, rect.right, self.map.width());
        for j in span(rect.top, rect.bottom, self.map.height()) {
            for i in columns.clone() {
                self.blend([i, j], colour, 1.0);
            }
        }
    }

    /// Mixes a colour into a pixel, if it is one of the image.
    pub(crate) fn blend(&mut self, [i, j]: [usize; 2], Colour(colour): Colour, cover: f64) {
        let (width, height) = (self.map.width() as usize, self.map.height() as usize);
        if i >= width || j >= height {
            return;
        }
        let at = 4 * (j * width + i);
        let part = (cover * 256.0) as u32;
        let pixel = &mut self.map.data_mut()[at..at + 3];
        for (old, new) in pixel.iter_mut().zip(colour) {
            let mixed = u32::from(*old) * (256 - part) + u32::from(new) * part;
            *old = (mixed >> 8) as u8;
        }
    }

    pub(crate) fn bounds(&self) -> Rect {
        Rect::sized([self.map.width(), self.map.height()])
    }
}

impl DrawTarget for Canvas {
    fn line(&mut self, points: &[Spot], pen: Pen) {
        let Some(path) = path(points, false) else {
            return;
        };
        let width = pen.width as f32;
        let dash = StrokeDash::new(vec![4.0 * width, 2.5 * width], 0.0);
        let stroke = Stroke {
            width,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            dash: dash.filter(|_| pen.dashed),
            ..Stroke::default()
        };
        let paint = paint(Fill::solid(pen.colour));
        self.map
            .stroke_path(&path, &paint, &stroke, Transform::identity(), None);
    }

    fn area(&mut self, outline: &[Spot], fill: Fill) {
        if let Some(path) = path(outline, true) {
            let rule = FillRule::Winding;
            self.map
                .fill_path(&path, &paint(fill), rule, Transform::identity(), None);
        }
    }

    fn disc(&mut self, centre: Spot, radius: f64, fill: Fill) {
        let bounds = self.bounds();
        self.clipped_disc(centre, radius, fill, &bounds);
    }

    fn text(&mut self, at: Spot, text: &str, lettering: Lettering) {
        let share = 0.5 * f64::from(lettering.anchor as u8);
        let back = share * text::width(text, lettering.size);
        let [x, y] = match lettering.upwards {
            true => [at[0], at[1] + back],
            false => [at[0] - back, at[1]],
        }
        .map(|x| x.round() as i32);
        text::pixels(text, lettering.size, |right, down, cover| {
            let pixel = match lettering.upwards {
                true => [x + down, y - right],
                false => [x + right, y + down],
            };
            // Negative ones become larger than any image.
            self.blend(pixel.map(|k| k as usize), Colour::INK, f64::from(cover));
        });
    }
}

fn path(points: &[Spot], closed: bool) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::new();
    let (first, rest) = points.split_first()?;
    builder.move_to(first[0] as f32, first[1] as f32);
    for p in rest {
        builder.line_to(p[0] as f32, p[1] as f32);
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

fn paint(fill: Fill) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    let [r, g, b] = fill.colour.0;
    let alpha = (fill.opacity.clamp(0.0, 1.0) * 255.0).round() as u8;
    paint.set_color_rgba8(r, g, b, alpha);
    paint
}
