//! Texts in XML that VTK's formats and pages have.

use std::borrow::Cow;

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
    fn a_reader_of_xml_undoes_it() {
        let odd = r#"a < b & "c" > 'd' &lt;"#;
        let text = format!("<a b=\"{0}\">{0}</a>", escape(odd));
        let read = roxmltree::Document::parse(&text).unwrap();
        let node = read.root_element();
        assert_eq!((node.attribute("b"), node.text()), (Some(odd), Some(odd)));
        assert_eq!(escape("a\u{1}b"), "a?b");
    }
}
