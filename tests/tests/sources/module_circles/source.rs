//! What the text of a module says of names.

use std::collections::{BTreeMap, BTreeSet};

/// Names from the root of a crate to a module or an item; the root is empty.
pub type Names = Vec<String>;

/// What the text of a module says of names.
#[derive(Default)]
pub struct Module {
    /// What `use` brings into it, under the name it has here.
    pub imports: BTreeMap<String, Names>,
    /// Of what it takes everything.
    pub globs: Vec<Names>,
    /// All paths of its code, those of `use` among them.
    pub paths: BTreeSet<Names>,
    /// What it defines itself.
    pub items: BTreeSet<String>,
    /// Modules that are only there for tests.
    pub for_tests: BTreeSet<String>,
}

/// The words and signs of a source, without comments, texts and lifetimes.
fn tokens(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(length) = literal(rest) {
            length
        } else if word(first) {
            let length = rest.find(|c| !word(c)).unwrap_or(rest.len());
            found.push(rest[..length].to_string());
            length
        } else if rest.starts_with("::") {
            found.push("::".to_string());
            2
        } else {
            if !first.is_whitespace() {
                found.push(first.to_string());
            }
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    found
}

/// How long the text, the character or the lifetime is that a source begins with.
fn literal(source: &str) -> Option<usize> {
    let raw = source.trim_start_matches('b').strip_prefix('r');
    if let Some(raw) = raw {
        let marks = raw.len() - raw.trim_start_matches('#').len();
        if let Some(text) = raw[marks..].strip_prefix('"') {
            let end = format!("\"{}", &raw[..marks]);
            let length = text.find(&end).map_or(text.len(), |at| at + end.len());
            return Some(source.len() - text.len() + length);
        }
    }
    let quote = source.chars().next().filter(|c| "\"'".contains(*c))?;
    let mut inside = source.char_indices().skip(1);
    if quote == '\'' && !source.starts_with("'\\") && source.chars().nth(2) != Some('\'') {
        return Some(1);
    }
    while let Some((at, c)) = inside.next() {
        match c {
            '\\' => drop(inside.next()),
            _ if c == quote => return Some(at + 1),
            _ => {}
        }
    }
    Some(source.len())
}

/// Where the item ends that begins at a token.
fn end_of_item(tokens: &[String], start: usize) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate().skip(start) {
        match token.as_str() {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            _ => {}
        }
        let attribute = token == "]" && tokens[start] == "#";
        if depth == 0 && attribute {
            return end_of_item(tokens, at + 1);
        }
        if depth == 0 && (token == ";" || token == "}") {
            return at + 1;
        }
    }
    tokens.len()
}

/// Takes a tree of a `use` apart: whole paths, each with the name that it gets.
fn use_tree(tokens: &[String], at: &mut usize, mut path: Names, found: &mut Vec<(Names, String)>) {
    while let Some(token) = tokens.get(*at) {
        *at += 1;
        match token.as_str() {
            "::" => continue,
            "{" => {
                while tokens.get(*at).is_some_and(|t| t != "}") {
                    use_tree(tokens, at, path.clone(), found);
                    *at += usize::from(tokens.get(*at).is_some_and(|t| t == ","));
                }
                *at += 1;
                return;
            }
            "self" if !path.is_empty() => {}
            name => path.push(name.to_string()),
        }
        match tokens.get(*at).map(String::as_str) {
            Some("::") => {}
            Some("as") => {
                found.push((path, tokens[*at + 1].clone()));
                *at += 2;
                return;
            }
            _ => {
                let name = path.last().cloned().unwrap_or_default();
                found.push((path, name));
                return;
            }
        }
    }
}

/// What items begin with.
const ITEMS: [&str; 8] = [
    "fn", "struct", "enum", "trait", "const", "static", "type", "union",
];

/// Reads what a source says; its tests are left out.
pub fn module(text: &str) -> Module {
    let tokens = tokens(text);
    let mut module = Module::default();
    let mut at = 0;
    let is = |at: usize, token: &str| tokens.get(at).is_some_and(|t| t == token);
    while at < tokens.len() {
        let before = at.checked_sub(1).map_or("", |at| &tokens[at]);
        let token = tokens[at].as_str();
        let next = tokens.get(at + 1).cloned().unwrap_or_default();
        let ahead = tokens[at..].iter().take(7);
        if ahead.eq(["#", "[", "cfg", "(", "test", ")", "]"]) {
            let end = end_of_item(&tokens, at);
            if let Some(name) = tokens[at..end].iter().position(|t| t == "mod") {
                module.for_tests.insert(tokens[at + name + 1].clone());
            }
            at = end;
            continue;
        }
        if token == "use" && next != "<" {
            at += 1;
            let mut found = Vec::new();
            use_tree(&tokens, &mut at, Names::new(), &mut found);
            for (mut path, name) in found {
                if name == "*" {
                    path.pop();
                    module.globs.push(path.clone());
                } else {
                    module.imports.insert(name, path.clone());
                }
                module.paths.insert(path);
            }
            continue;
        }
        if ITEMS.contains(&token) {
            module.items.insert(next);
        } else if is(at + 1, "::") && !["::", "$"].contains(&before) {
            let mut path = vec![token.to_string()];
            while is(at + 1, "::") && tokens.get(at + 2).is_some_and(|t| t != "<") {
                path.push(tokens[at + 2].clone());
                at += 2;
            }
            module.paths.insert(path);
        }
        at += 1;
    }
    module
}
