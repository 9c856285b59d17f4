//! The legend of a plot, in the corner where it hides least.

use crate::drawing::axes::Axes;
use crate::drawing::colour::Colour;
use crate::drawing::draw_target::{Anchor, DrawTarget, Fill, Lettering, Pen, Rect, Spot};
use crate::drawing::mark::{Mark, Style};
use crate::drawing::text;

/// Draws names and samples of the series that have a name.
pub(crate) fn draw_legend(on: &mut dyn DrawTarget, marks: &[Mark], axes: &Axes) {
    let size = 0.92 * axes.size;
    let named: Vec<&Mark> = marks.iter().filter(|m| m.is_named()).collect();
    if named.is_empty() {
        return;
    }
    let names = named.iter().map(|m| m.series.name.as_str());
    let width = text::widest(names, size) + 4.2 * size;
    let height = (1.45 * named.len() as f64 + 0.5) * size;
    // Grey lines are covered rather than those in the legend.
    let spots = |named: bool| visited(marks.iter().filter(|m| m.is_named() == named), axes);
    let spots = [true, false].map(spots);
    let under = |place: &Rect, k: usize| spots[k].iter().filter(|&&s| place.holds(s)).count();
    let hidden = |place: &Rect| (under(place, 0), under(place, 1));
    let places = corners(&axes.frame, width, height, 0.6 * size);
    let place = places.into_iter().min_by_key(hidden).unwrap_or(axes.frame);
    on.area(&place.corners(), Fill::new(Colour::WHITE, 0.85));
    on.line(&place.outline(), Pen::solid(Colour::FAINT, size / 14.0));
    for (i, mark) in named.iter().enumerate() {
        let y = place.top + (1.45 * i as f64 + 0.97) * size;
        let [from, to] = [0.6, 2.8].map(|right| [place.left + right * size, y]);
        mark.draw_sample(on, [from, to], size);
        let at = [place.left + 3.4 * size, y + 0.36 * size];
        on.text(at, &mark.series.name, Lettering::new(size, Anchor::Start));
    }
}

/// Right top, left top, right bottom, left bottom.
fn corners(frame: &Rect, width: f64, height: f64, gap: f64) -> [Rect; 4] {
    let rights = [frame.right - gap, frame.left + gap + width];
    let bottoms = [frame.top + gap + height, frame.bottom - gap];
    [0, 1, 2, 3].map(|i| {
        let (right, bottom) = (rights[i % 2], bottoms[i / 2]);
        Rect::between([right - width, bottom - height], [right, bottom])
    })
}

/// Spots along all series, close enough together to find those that a box hides.
fn visited<'a>(marks: impl Iterator<Item = &'a Mark<'a>>, axes: &Axes) -> Vec<Spot> {
    let step = axes.size;
    let mut spots = Vec::new();
    for mark in marks {
        for stretch in mark.stretches(axes) {
            spots.extend(&stretch);
            if mark.series.style == Style::Markers {
                continue;
            }
            for ends in stretch.windows(2) {
                let d = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
                let parts = (d[0].hypot(d[1]) / step).min(1e3) as usize;
                let at = |i: usize| i as f64 / (parts + 1) as f64;
                let between = (1..=parts).map(at);
                spots.extend(between.map(|t| [ends[0][0] + t * d[0], ends[0][1] + t * d[1]]));
            }
        }
    }
    spots
}
