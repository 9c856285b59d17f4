//! Functions and files of a length that can be taken in.

/// Most lines of a function, from `fn` to its closing brace.
const LONGEST_FUNCTION: usize = 80;
/// Most lines of a file, its tests among them.
const LONGEST_FILE: usize = 400;

/// Functions of a source by name, with the line they begin in and how many they take.
fn functions(text: &str) -> Vec<(String, usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let words: Vec<&str> = code.split_whitespace().collect();
        let before = |w: &&str| w.starts_with("pub") || ["in", "const", "async"].contains(w);
        let Some(at) = words.iter().position(|w| *w == "fn") else {
            continue;
        };
        let rest = words.get(at + 1);
        if !words[..at].iter().all(|w| before(w) || w.ends_with(')')) || rest.is_none() {
            continue;
        }
        let indent = &line[..line.len() - code.len()];
        let one_line = |l: &&str| l.ends_with(';') || (l.ends_with('}') && l.contains('{'));
        let end = lines[start..].iter().position(|l| {
            let same = l.strip_prefix(indent).filter(|l| !l.starts_with(' '));
            same.is_some_and(|l| l.starts_with('}') || one_line(&l))
        });
        let name = rest.unwrap_or(&"").split(['(', '<']).next().unwrap_or("");
        found.push((name.to_string(), start + 1, end.unwrap_or(lines.len()) + 1));
    }
    found
}

#[test]
fn no_function_and_no_file_is_long() {
    let (mut count, mut found) = (0, Vec::new());
    for (path, text) in crate::sources_of_crates() {
        let file = path.display();
        if text.lines().count() > LONGEST_FILE {
            found.push(format!("{file}: {} lines", text.lines().count()));
        }
        for (name, line, length) in functions(&text) {
            count += 1;
            if length > LONGEST_FUNCTION {
                found.push(format!("{file}:{line}: {name} takes {length} lines"));
            }
        }
    }
    assert!(count > 3000, "only {count} functions were read");
    found.sort();
    assert!(found.is_empty(), "too long:\n{}", found.join("\n"));
}

#[test]
fn a_function_ends_with_the_brace_below_its_beginning() {
    let text = "/// fn no\npub(crate) fn one(\n    a: f64,\n) -> f64 {\n    fn two() {}\n    if a {\n    }\n}\n\
                trait T {\n    fn three(&self);\n    fn four<A>(a: A)\n    where\n        A: B,\n    {\n    }\n}\n";
    let named = |(name, line, length): (&str, usize, usize)| (name.to_string(), line, length);
    let first = [("one", 2, 7), ("two", 5, 1)].map(named);
    let last = [("three", 10, 1), ("four", 11, 5)].map(named);
    assert_eq!(functions(text), [first, last].concat());
}
