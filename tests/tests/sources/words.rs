//! Words that names, pages, comments and messages do without: `words.toml` has them, with what to write.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::docs::documents;
use crate::sources_of_crates;

type Advice = BTreeMap<String, String>;

#[derive(Deserialize)]
struct Words {
    names: Advice,
    files: Advice,
    texts: Advice,
    pages: Advice,
    starts: Advice,
    rustdoc: Advice,
}

fn words() -> Words {
    toml::from_str(include_str!("words.toml")).expect("the words")
}

/// The name that a line of code declares: of a type, a trait or a function.
fn declared(line: &str) -> Option<&str> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let kinds = ["struct", "enum", "trait", "type", "fn", "mod"];
    let at = words.iter().position(|w| kinds.contains(w))?;
    let before = |w: &&str| {
        w.starts_with("pub") || w.ends_with(')') || ["const", "async", "unsafe"].contains(w)
    };
    words[..at].iter().all(before).then_some(())?;
    words
        .get(at + 1)?
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .next()
}

/// Names of a source that are refused, each with its line and its advice.
fn names(text: &str, refused: &Advice) -> Vec<String> {
    let lines = text.lines().enumerate();
    let found = lines.filter_map(|(k, line)| {
        let name = declared(line)?;
        let advice = refused.get(name)?;
        Some(format!("{}: the name `{name}`; write {advice}", k + 1))
    });
    found.collect()
}

/// A line without what stands between backticks.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect::<Vec<_>>().join(" ")
}

/// Comments and texts in quotes of a line of code.
fn spoken(line: &str) -> String {
    match line.trim_start().strip_prefix("//") {
        Some(comment) => without_code(comment),
        None => {
            let quoted: Vec<_> = line.split('"').skip(1).step_by(2).collect();
            quoted.join(" ")
        }
    }
}

/// The lines of a page outside of code, each as it is looked through.
fn prose(text: &str) -> Vec<String> {
    let mut code = false;
    let outside = text.lines().map(|line| {
        let fence = line.trim_start().starts_with("```");
        code ^= fence;
        if code || fence {
            String::new()
        } else {
            without_code(line)
        }
    });
    outside.collect()
}

/// Turns of phrase in lines, also across the end of a line, each with its line and its advice.
fn turns<'w>(
    lines: &[String],
    refused: impl Iterator<Item = (&'w String, &'w String)>,
) -> Vec<String> {
    let mut all: Vec<(usize, String)> = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let words = line
            .split(|c: char| !c.is_alphanumeric())
            .filter(|w| !w.is_empty());
        all.extend(words.map(|w| (k + 1, w.to_lowercase())));
    }
    let mut found = Vec::new();
    for (turn, advice) in refused {
        let turn: Vec<&str> = turn.split(' ').collect();
        for place in all.windows(turn.len()) {
            if place.iter().map(|(_, word)| word).eq(turn.iter()) {
                let line = place[0].0;
                found.push(format!("{line}: \"{}\"; write {advice}", turn.join(" ")));
            }
        }
    }
    found
}

/// Headings and rows of a page that begin with a refused word, each with its line and its advice.
fn starts(lines: &[String], refused: &Advice) -> Vec<String> {
    let numbered = lines.iter().enumerate();
    let found = numbered.filter_map(|(k, line)| {
        let title = line.strip_prefix('#').or(line.strip_prefix('|'))?;
        let first = title.trim_start_matches('#').split_whitespace().next()?;
        let same = |word: &&String| word.to_lowercase() == first.to_lowercase();
        let advice = &refused[refused.keys().find(same)?];
        let line = k + 1;
        Some(format!("{line}: begins with \"{first}\"; write {advice}"))
    });
    found.collect()
}

/// Doc comments of a source that begin with a refused word, each with its line and its advice.
fn openings(text: &str, refused: &Advice) -> Vec<String> {
    let documents = |line: &&str| ["///", "//!"].iter().any(|m| line.starts_with(m));
    let mut before = None;
    let mut found = Vec::new();
    for (k, line) in text.lines().map(str::trim_start).enumerate() {
        let comment = Some(line).filter(documents);
        let first = comment.and_then(|c| c[3..].split_whitespace().next());
        let known = first.and_then(|word| refused.get_key_value(word));
        if let (None, Some((word, advice))) = (before, known) {
            found.push(format!("{}: begins with \"{word}\"; write {advice}", k + 1));
        }
        before = comment;
    }
    found
}

#[test]
fn names_are_words_of_the_field() {
    let words = words();
    let (mut count, mut found) = (0, Vec::new());
    for (path, text) in sources_of_crates() {
        count += 1;
        let stem = path.file_stem().and_then(|s| s.to_str());
        let file = path.display();
        if let Some(advice) = words.files.get(stem.unwrap_or_default()) {
            found.push(format!("{file}: the name of the file; write {advice}"));
        }
        let mut all = names(&text, &words.names);
        all.extend(openings(&text, &words.rustdoc));
        found.extend(all.iter().map(|f| format!("{file}:{f}")));
    }
    assert!(count > 500, "{count} sources");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn comments_and_messages_name_things_and_no_persons() {
    let refused = words().texts;
    let mut found = Vec::new();
    for (path, text) in sources_of_crates() {
        let lines: Vec<String> = text.lines().map(spoken).collect();
        let all = turns(&lines, refused.iter()).into_iter();
        found.extend(all.map(|f| format!("{}:{f}", path.display())));
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn pages_state_what_is_so() {
    let words = words();
    let (mut count, mut found) = (0, Vec::new());
    for (page, text) in documents() {
        // Release notes are about changes.
        if page.ends_with("CHANGELOG.md") {
            continue;
        }
        let lines = prose(&text);
        count += lines.len();
        let refused = words.texts.iter().chain(&words.pages);
        let all = turns(&lines, refused)
            .into_iter()
            .chain(starts(&lines, &words.starts));
        found.extend(all.map(|f| format!("{}:{f}", page.display())));
    }
    assert!(count > 4_000, "{count} lines");
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn refused_words_are_found_at_their_lines() {
    let words = words();
    let code = "pub(crate) struct Felt<'a> {\n    felt: u8,\n}\nimpl Felt {\n    pub const fn of(x: u8) -> u8 {\n        x\n    }\n}\n";
    let lines = |mut found: Vec<String>| {
        let cut = |f: &mut String| f.truncate(f.find(';').unwrap_or(f.len()));
        found.iter_mut().for_each(cut);
        found
    };
    let expected = ["1: the name `Felt`", "5: the name `of`"];
    assert_eq!(lines(names(code, &words.names)), expected);
    let page = "# What is here\n\nA column that `nobody` reads, or that no\nterm reads: Nobody\nasks.\n\n```text\nnobody\n```\n\
                It was\nonce empty.\n";
    let found = lines(turns(&prose(page), words.texts.iter()));
    assert_eq!(found, ["4: \"nobody\"", "10: \"was once\""]);
    let found = lines(starts(&prose(page), &words.starts));
    assert_eq!(found, ["1: begins with \"What\""]);
    let code = "//! How it works.\n\nstruct A {\n    /// A length, and\n    /// Where it is.\n    a: f64,\n    \
                /// Whether it is.\n    ///\n    /// What is more, it may not be.\n    b: bool, // What it is.\n}\n";
    let expected = ["1: begins with \"How\"", "7: begins with \"Whether\""];
    assert_eq!(lines(openings(code, &words.rustdoc)), expected);
    let code = "    let x = \"told by nobody\"; // nobody";
    assert_eq!(spoken(code), "told by nobody");
    assert_eq!(spoken("    /// Nobody, by `nobody`."), "/ Nobody, by  .");
}
