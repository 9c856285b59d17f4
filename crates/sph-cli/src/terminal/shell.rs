//! Commands that a person can copy.

use std::path::PathBuf;

/// A word as a shell reads it back.
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=,:+".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_string(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

/// A command with its options, each of which stands before its value.
pub fn command<'o>(words: &[&str], options: impl IntoIterator<Item = (&'o str, String)>) -> String {
    let words = words.iter().map(|word| quoted(word));
    let options = options.into_iter();
    let options = options.map(|(option, value)| format!("{option} {}", quoted(&value)));
    words.chain(options).collect::<Vec<_>>().join(" ")
}

pub fn overrides<'o>(
    set: &'o [String],
    allowed: &'o [PathBuf],
) -> impl Iterator<Item = (&'o str, String)> {
    let set = set.iter().map(|set| ("--set", set.clone()));
    let allowed = allowed.iter();
    set.chain(allowed.map(|folder| ("--allow-path", folder.display().to_string())))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_survive_a_shell() {
        assert_eq!(quoted("results/a-1.toml"), "results/a-1.toml");
        assert_eq!(quoted("run.end=1 s"), "'run.end=1 s'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }
}
