//! The embedded font: widths of texts and their pixels.
//!
//! A subset of DejaVu Sans (ASCII, Latin-1, Greek, sub- and superscripts, some
//! mathematical signs); its licence lies beside it in `assets`.

use std::sync::OnceLock;

use ab_glyph::{Font, FontRef, Glyph, ScaleFont, point};

static DATA: &[u8] = include_bytes!("../../assets/DejaVuSans-subset.ttf");

fn font() -> Option<&'static FontRef<'static>> {
    static FONT: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    FONT.get_or_init(|| FontRef::try_from_slice(DATA).ok())
        .as_ref()
}

/// Width in pixels of `text` at `size` pixels per em.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let Some(font) = font() else { return 0.0 };
    let scaled = font.as_scaled(per_em(font, size));
    let advance = |c| f64::from(scaled.h_advance(scaled.glyph_id(c)));
    text.chars().map(advance).sum()
}

/// Width in pixels of the widest of some texts.
pub(crate) fn widest<'t>(texts: impl Iterator<Item = &'t str>, size: f64) -> f64 {
    texts.map(|text| width(text, size)).fold(0.0, f64::max)
}

/// As much of the beginning of `text` as `room` pixels hold at `size`, with dots for the rest.
pub(crate) fn fitted(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_string();
    }
    let fits = |kept: &str| width(&format!("{kept}..."), size) <= room;
    let ends = text.char_indices().map(|(at, _)| text[..at].trim_end());
    let kept = ends.rev().find(|kept| fits(kept)).unwrap_or_default();
    format!("{kept}...")
}

/// Calls `paint` with the offset to the right and down from the start of the
/// baseline, and the coverage from 0 to 1, of every pixel that `text` touches.
pub(crate) fn pixels(text: &str, size: f64, mut paint: impl FnMut(i32, i32, f32)) {
    let Some(font) = font() else { return };
    let scale = per_em(font, size);
    let scaled = font.as_scaled(scale);
    let mut pen = 0.0;
    for c in text.chars() {
        let id = scaled.glyph_id(c);
        let glyph: Glyph = id.with_scale_and_position(scale, point(pen, 0.0));
        pen += scaled.h_advance(id);
        if let Some(outline) = font.outline_glyph(glyph) {
            let corner = outline.px_bounds().min;
            let (x, y) = (corner.x as i32, corner.y as i32);
            outline.draw(|i, j, cover| paint(x + i as i32, y + j as i32, cover.min(1.0)));
        }
    }
}

/// The library's scale, a line height, for a size in pixels per em.
fn per_em(font: &FontRef, size: f64) -> f32 {
    let em = font.units_per_em().unwrap_or(2048.0);
    size as f32 * font.height_unscaled() / em
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_what_units_and_titles_need() {
        let font = font().expect("the embedded font is sound");
        for c in "azAZ09~[]×·−√°²³⁰⁻⁹₀γρΔμ∇∂≤≈∞éü–…".chars() {
            assert_ne!(font.glyph_id(c).0, 0, "{c}");
        }
    }

    #[test]
    fn a_long_text_is_cut_to_its_room() {
        let title = "A title that is far too long for the room above a picture";
        assert_eq!(fitted(title, 10.0, 1e4), title);
        let cut = fitted(title, 10.0, 100.0);
        assert!(width(&cut, 10.0) <= 100.0 && cut.len() > 8, "{cut}");
        assert!(cut.ends_with("...") && title.starts_with(cut.trim_end_matches('.')));
        assert_eq!(fitted(title, 10.0, 0.0), "...");
    }

    #[test]
    fn widths_scale_with_the_size() {
        let [small, large] = [10.0, 20.0].map(|size| width("pressure [Pa]", size));
        let alike = small > 50.0 && (large - 2.0 * small).abs() < 0.1;
        assert!(alike, "{small} {large}");
    }
}
