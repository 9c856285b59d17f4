//! Texts from files, so that a terminal shows them and does not execute them, and texts in XML.
//!
//! Escape sequences move the cursor, set titles and clear text; marks of direction show a text in
//! another order than it has. Either may stand in a title, a key, a value or the name of a file.

use std::borrow::Cow;

/// True if a terminal executes a character instead of showing it; line ends and tabs are left alone.
fn is_control(c: char) -> bool {
    let mark = matches!(c,
        // Marks, embeddings, overrides and isolates of direction (Unicode Standard Annex 9).
        '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
        // Separators of lines and paragraphs, characters without width, tags.
        | '\u{2028}' | '\u{2029}' | '\u{200b}'..='\u{200d}' | '\u{2060}' | '\u{feff}'
        | '\u{e0000}'..='\u{e007f}');
    mark || (c.is_control() && !matches!(c, '\n' | '\t'))
}

/// The text with a stand-in for every such character, of as many bytes, so that places in it stay right.
pub fn clean(text: &str) -> Cow<'_, str> {
    match text.contains(is_control) {
        false => text.into(),
        true => text.chars().flat_map(shown).collect(),
    }
}

/// A text of JSON with such characters as escapes: it is read back as it was.
pub fn escaped(json: &str) -> Cow<'_, str> {
    if !json.contains(is_control) {
        return json.into();
    }
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        match is_control(c) {
            true => (c.encode_utf16(&mut [0; 2]).iter())
                .for_each(|unit| text.push_str(&format!("\\u{unit:04x}"))),
            false => text.push(c),
        }
    }
    text.into()
}

fn shown(c: char) -> impl Iterator<Item = char> {
    let (stand_in, times) = match (is_control(c), c.len_utf8()) {
        (false, _) => (c, 1),
        (true, 1) => ('?', 1),
        (true, 2) => ('\u{bf}', 1),
        (true, 3) => ('\u{fffd}', 1),
        (true, bytes) => ('?', bytes),
    };
    std::iter::repeat_n(stand_in, times)
}

/// `text` as it may stand inside a quoted attribute or an element.
///
/// Control characters that XML 1.0 forbids become `?`.
pub fn escape(text: &str) -> Cow<'_, str> {
    let odd = |c: char| matches!(c, '&' | '<' | '>' | '"' | '\'') || c.is_control();
    if !text.contains(odd) {
        return text.into();
    }
    let text = text
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    let text = text.replace('"', "&quot;").replace('\'', "&apos;");
    text.replace(|c: char| c.is_control(), "?").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_to_obey_and_no_place_moves() {
        let hostile = "a\u{1b}[2J\u{7}\rb\u{9b}1m\u{202e}c\u{2066}\u{e0041}d\u{7f}\n\te";
        let shown = clean(hostile);
        assert!(!shown.contains(is_control), "{shown:?}");
        assert_eq!(shown.len(), hostile.len());
        for letter in ['a', 'b', 'c', 'd', 'e', '\n', '\t'] {
            assert_eq!(shown.find(letter), hostile.find(letter));
        }
        let json = serde_json::json!([hostile]).to_string();
        let quiet = escaped(&json);
        assert!(!quiet.contains(is_control), "{quiet:?}");
        let back: Vec<String> = serde_json::from_str(&quiet).unwrap();
        assert_eq!(back, [hostile]);
        let plain = "η̃ = 1 Pa·s — ½ ≤ √2, 水";
        assert!(matches!(clean(plain), Cow::Borrowed(same) if same == plain));
    }

    #[test]
    fn a_reader_of_xml_undoes_it() {
        let odd = r#"a < b & "c" > 'd' &lt;"#;
        let text = format!("<a b=\"{0}\">{0}</a>", escape(odd));
        let read = roxmltree::Document::parse(&text).unwrap();
        let node = read.root_element();
        assert_eq!((node.attribute("b"), node.text()), (Some(odd), Some(odd)));
        assert_eq!(escape("a\u{1}b"), "a?b");
    }
}
