//! The little XML that VTK's formats and pages need: escaping, and attributes of tags.

use std::borrow::Cow;

/// `text` as it may stand inside a quoted attribute or an element.
///
/// Control characters that XML 1.0 forbids become `?`.
pub fn escape(text: &str) -> Cow<'_, str> {
    let odd = |c: char| matches!(c, '&' | '<' | '>' | '"' | '\'') || c.is_control();
    if !text.contains(odd) {
        return text.into();
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c if c.is_control() => out.push('?'),
            c => out.push(c),
        }
    }
    out.into()
}

/// Undoes [`escape`].
pub(crate) fn unescape(text: &str) -> String {
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&apos;", "'")
        .replace("&amp;", "&")
}

/// The attributes of `tag`, which is the text between `<Name` and `>`.
///
/// `None` if it is not a list of `name="value"`.
pub(crate) fn attributes(tag: &str) -> Option<Vec<(&str, String)>> {
    let mut rest = tag.trim().trim_end_matches('/').trim_end();
    let mut found = Vec::new();
    while !rest.is_empty() {
        let (name, after) = rest.split_once('=')?;
        let quote = after.trim_start().chars().next()?;
        if quote != '"' && quote != '\'' {
            return None;
        }
        let (value, after) = after.trim_start()[1..].split_once(quote)?;
        found.push((name.trim(), unescape(value)));
        rest = after.trim_start();
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaping_is_undone() {
        let odd = r#"a < b & "c" > 'd' &lt;"#;
        assert_eq!(unescape(&escape(odd)), odd);
        assert_eq!(escape("a\u{1}b"), "a?b");
    }

    #[test]
    fn attributes_are_read() {
        let found = attributes(r#" part="0" file='a &amp; b.vtu' /"#).unwrap();
        assert_eq!(found, [("part", "0".into()), ("file", "a & b.vtu".into())]);
        assert!(attributes("part=0").is_none());
        assert!(attributes("part=\"0").is_none());
    }
}
