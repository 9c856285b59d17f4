//! Names of keys: the nearest valid one for a misspelt one, and keys within others.

/// The candidate most like `name`, if any is near enough to be meant.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |s: &str| s.to_lowercase().replace('_', "-");
    let wanted = plain(name);
    candidates
        .into_iter()
        .map(|c| (strsim::damerau_levenshtein(&wanted, &plain(c)), c))
        .filter(|(distance, c)| *distance <= 1 + c.len().max(name.len()) / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, c)| c)
}

/// `, did you mean `x`?` or nothing.
pub fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, candidates).map_or(String::new(), |c| format!(", did you mean `{c}`?"))
}

/// Names or numbers with commas between.
pub fn comma_list<T: ToString>(entries: impl IntoIterator<Item = T>) -> String {
    let entries = entries.into_iter().map(|e| e.to_string());
    entries.collect::<Vec<_>>().join(", ")
}

/// True if a dotted path is that of a key or of something within it.
pub fn is_within(path: &str, key: &str) -> bool {
    let rest = path.strip_prefix(key);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swapped_letter_is_found_and_a_stranger_is_not() {
        let names = ["viscosity", "density", "yield-stress"];
        assert_eq!(nearest("yeild_stress", names), Some("yield-stress"));
        assert_eq!(nearest("visosity", names), Some("viscosity"));
        assert_eq!(nearest("banana", names), None);
    }
}
