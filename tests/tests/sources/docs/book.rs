//! The pages as a book: anchors, lengths of lines, and what a page must not grow to.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::docs::documents;
use crate::root;

/// Longest line of a page: prose, code, rows of tables. What a row cannot hold becomes an item of a list.
const LONGEST: usize = 120;

/// The lines outside of code, with their numbers.
fn prose(text: &str) -> Vec<(usize, &str)> {
    let mut code = false;
    let lines = text.lines().enumerate();
    let outside = lines.filter(|(_, line)| {
        let fence = line.trim_start().starts_with("```");
        code ^= fence;
        !code && !fence
    });
    outside.map(|(k, line)| (k + 1, line)).collect()
}

/// A heading as the end of a link: letters, digits, hyphens and underscores in lower case, spaces as hyphens.
fn anchor(heading: &str) -> String {
    let plain = heading.trim().to_lowercase();
    let kept = plain.chars().filter_map(|c| match c {
        c if c.is_whitespace() => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        _ => None,
    });
    kept.collect()
}

#[test]
fn links_into_pages_lead_to_a_heading() {
    let mut headings: BTreeMap<PathBuf, Vec<String>> = BTreeMap::new();
    for (page, text) in documents() {
        let titles = prose(&text).into_iter().filter(|(_, l)| l.starts_with('#'));
        let anchors = titles.map(|(_, l)| anchor(l.trim_start_matches('#')));
        let page = page.canonicalize().expect("a page");
        headings.insert(page, anchors.collect());
    }
    let mut checked = 0;
    for (page, text) in documents() {
        let folder = page.parent().expect("a folder");
        for target in text.split("](").skip(1).filter_map(|t| t.split(')').next()) {
            let Some((file, fragment)) = target.split_once('#') else {
                continue;
            };
            if file.contains("://") {
                continue;
            }
            let other = match file {
                "" => page.clone(),
                file => folder.join(file),
            };
            let Some(known) = other.canonicalize().ok().and_then(|o| headings.get(&o)) else {
                continue;
            };
            let found = known.iter().any(|a| a == fragment);
            assert!(found, "{page:?} links to {target}, which has {known:?}");
            checked += 1;
        }
    }
    assert!(checked > 100, "{checked} links");
}

#[test]
fn no_line_is_too_long() {
    let mut long = Vec::new();
    for (page, text) in documents() {
        for (number, line) in text.lines().enumerate() {
            let letters = line.chars().count();
            if letters > LONGEST {
                let number = number + 1;
                long.push(format!("{}:{number}: {letters} characters", page.display()));
            }
        }
    }
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn the_readme_is_read_in_minutes() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("a page");
    let lines = readme.lines().count();
    assert!(lines <= 120, "{lines} lines");
}
