//! Place of the key of a dotted path in a TOML text.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A place in the text, and whether it is that of the whole path or of a parent.
pub(crate) struct Place {
    pub span: Range<usize>,
    pub exact: bool,
}

/// The place of `phase.water.density` or `wall.tank.polyline[0][1]`, or of its nearest parent.
///
/// A key with a value gives the span of both; a table gives the span of its name.
pub(crate) fn locate(table: &DeTable<'_>, path: &str) -> Place {
    let mut span = 0..0;
    let mut rest = path;
    let mut inside = TextNode::Table(table);
    while !rest.is_empty() {
        let step = match inside {
            TextNode::Table(table) => named(table, rest),
            TextNode::List(items) => indexed(items, rest),
            TextNode::Leaf => None,
        };
        let Some((there, value, remaining)) = step else {
            let exact = false;
            return Place { span, exact };
        };
        span = there;
        rest = remaining.strip_prefix('.').unwrap_or(remaining);
        inside = match value.get_ref() {
            DeValue::Table(table) => TextNode::Table(table),
            DeValue::Array(items) => TextNode::List(items),
            _ => TextNode::Leaf,
        };
    }
    let exact = true;
    Place { span, exact }
}

enum TextNode<'t> {
    Table(&'t DeTable<'t>),
    List(&'t [Spanned<DeValue<'t>>]),
    Leaf,
}

type Step<'t, 'p> = (Range<usize>, &'t Spanned<DeValue<'t>>, &'p str);

/// The longest key that the path starts with: a quoted key may hold a dot.
fn named<'t, 'p>(table: &'t DeTable<'t>, path: &'p str) -> Option<Step<'t, 'p>> {
    let fits = |key: &str| {
        let rest = path.strip_prefix(key)?;
        (rest.is_empty() || rest.starts_with(['.', '['])).then_some(rest)
    };
    let entries = table.iter().filter_map(|(key, value)| {
        let rest = fits(key.get_ref())?;
        Some((key, value, rest))
    });
    let (key, value, rest) = entries.min_by_key(|(_, _, rest)| rest.len())?;
    let (name, text) = (key.span(), value.span());
    let span = match value.get_ref() {
        DeValue::Table(_) => name,
        _ if text.end >= name.end => name.start..text.end,
        _ => name,
    };
    Some((span, value, rest))
}

fn indexed<'t, 'p>(items: &'t [Spanned<DeValue<'t>>], path: &'p str) -> Option<Step<'t, 'p>> {
    let (index, rest) = path.strip_prefix('[')?.split_once(']')?;
    let value = items.get(index.parse::<usize>().ok()?)?;
    Some((value.span(), value, rest))
}
