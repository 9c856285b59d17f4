//! Something wrong with a scene, by its key, and the nearest valid name for a misspelt one.

use thiserror::Error;
use toml::Value;

/// Most problems that are reported: a text that is wrong throughout needs no more of them, and each takes memory.
pub const MOST_PROBLEMS: usize = 200;

/// Something wrong with the text of a scene, addressed by its key.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{path}: {message}")]
pub struct SceneProblem {
    /// Dotted path of the key, `phase.water.density`.
    pub path: String,
    /// The defect, the expected value, the nearest valid name.
    pub message: String,
}

impl SceneProblem {
    /// A problem at a key.
    pub fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        SceneProblem {
            path: path.into(),
            message: message.into(),
        }
    }
}

/// Problems that checks find.
#[derive(Debug, Default)]
pub struct Problems(pub Vec<SceneProblem>);

impl Problems {
    /// A problem at a key.
    pub fn add(&mut self, path: impl Into<String>, message: impl Into<String>) {
        self.0.push(SceneProblem::new(path, message));
    }

    /// Checks that exactly one of the keys of `what` is given; `all` are the valid ones, and `advice` stands where several
    /// are given.
    pub fn one_of(
        &mut self,
        given: &[&str],
        path: &str,
        what: &str,
        [all, advice]: [&str; 2],
    ) -> bool {
        match given {
            [] => self.add(path, format!("a {what} is missing: {all}")),
            [_] => return true,
            [_, .., last] => {
                let all = given.join(", ");
                let message = format!("only one {what} can stand here, found {all}{advice}");
                self.add(format!("{path}.{last}"), message);
            }
        }
        false
    }

    /// Checks that one of two keys alone is given; the second has a name, at which `both` is said.
    pub fn either(
        &mut self,
        given: [bool; 2],
        path: &str,
        neither: &str,
        (second, both): (&str, &str),
    ) {
        match given {
            [false, false] => self.add(path, neither),
            [true, true] => self.add(format!("{path}.{second}"), both),
            _ => {}
        }
    }

    /// Checks that one of some keys at most is given.
    pub fn at_most_one(&mut self, given: &[&str], path: &str) {
        if let [_, .., last] = given {
            let message = format!("only one of `{}` can be given", given.join("`, `"));
            self.add(format!("{path}.{last}"), message);
        }
    }
}

/// The names of the keys that are given.
pub fn given<const N: usize>(keys: [(&'static str, bool); N]) -> Vec<&'static str> {
    let given = keys.into_iter().filter(|(_, given)| *given);
    given.map(|(name, _)| name).collect()
}

/// A value in a message.
pub(crate) fn describe(value: &Value) -> String {
    match value {
        Value::String(s) => format!("the string \"{s}\""),
        Value::Integer(i) => format!("{i}"),
        Value::Float(x) => format!("{x}"),
        Value::Boolean(b) => format!("{b}"),
        Value::Datetime(_) => "a date".into(),
        Value::Array(_) => "a list".into(),
        Value::Table(_) => "a table".into(),
    }
}

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
