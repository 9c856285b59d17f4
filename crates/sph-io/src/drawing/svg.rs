//! Vectors: a surface that becomes an SVG file, with texts as texts.

use std::path::Path;

use crate::drawing::colour::Colour;
use crate::drawing::draw_target::{Anchor, DrawTarget, Fill, Lettering, Pen, Spot};
use crate::error::Result;
use crate::files::clean::escape;
use crate::files::disk::write_whole;

pub(crate) struct Svg {
    body: String,
}

impl Svg {
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let body = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" \
             font-family=\"DejaVu Sans, Verdana, sans-serif\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        Self { body }
    }

    pub(crate) fn finish(mut self) -> String {
        self.body.push_str("</svg>\n");
        self.body
    }

    pub(crate) fn save(self, path: &Path) -> Result<()> {
        write_whole(path, self.finish())
    }

    fn push(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }
}

impl DrawTarget for Svg {
    fn line(&mut self, points: &[Spot], pen: Pen) {
        let (list, colour, width) = (list(points), code(pen.colour), pen.width);
        let [long, short] = [4.0 * width, 2.5 * width];
        let dash = match pen.dashed {
            true => format!(" stroke-dasharray=\"{long:.1} {short:.1}\""),
            false => String::new(),
        };
        self.push(&format!(
            "<polyline points=\"{list}\" fill=\"none\" stroke=\"{colour}\" \
             stroke-width=\"{width:.2}\" stroke-linejoin=\"round\"{dash}/>"
        ));
    }

    fn area(&mut self, outline: &[Spot], fill: Fill) {
        let (list, colour, opacity) = (list(outline), code(fill.colour), fill.opacity);
        self.push(&format!(
            "<polygon points=\"{list}\" fill=\"{colour}\" fill-opacity=\"{opacity:.2}\"/>"
        ));
    }

    fn disc(&mut self, [x, y]: Spot, radius: f64, fill: Fill) {
        let (colour, opacity) = (code(fill.colour), fill.opacity);
        self.push(&format!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"{colour}\" \
             fill-opacity=\"{opacity:.2}\"/>"
        ));
    }

    fn text(&mut self, [x, y]: Spot, text: &str, lettering: Lettering) {
        let anchor = match lettering.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = match lettering.upwards {
            true => format!(" transform=\"rotate(-90 {x:.2} {y:.2})\""),
            false => String::new(),
        };
        let (size, colour, text) = (lettering.size, code(Colour::INK), escape(text));
        self.push(&format!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size:.1}\" fill=\"{colour}\" \
             text-anchor=\"{anchor}\"{turn}>{text}</text>"
        ));
    }
}

fn code(Colour([r, g, b]): Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn list(points: &[Spot]) -> String {
    let spots = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}"));
    spots.collect::<Vec<_>>().join(" ")
}
