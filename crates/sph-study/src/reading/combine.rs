//! From axes to variants: crossing, pairing, leaving out, naming.

use std::collections::{BTreeMap, BTreeSet};

use sph_core::{SceneProblem, comma_list, suggestion};
use toml::Value;

use crate::reading::axis::label;
use crate::{Combine, StudyAxis};

/// Most variants of a study.
pub(crate) const MOST: usize = 10_000;
/// Longest name of a variant's folder.
const LONGEST: usize = 120;

/// A variant: the number of the choice taken on every axis, and its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Combination {
    pub name: String,
    pub choices: Vec<usize>,
}

/// All variants, the last axis running fastest.
///
/// # Errors
/// Axes that cannot be paired, conditions that name nothing, too many variants.
pub fn combinations(
    axes: &[StudyAxis],
    combine: Combine,
    skip: &[BTreeMap<String, Value>],
) -> Result<Vec<Combination>, Vec<SceneProblem>> {
    let all = match combine {
        Combine::Product => product(axes),
        Combine::Zip => zipped(axes),
    };
    let all = all.map_err(|p| vec![p])?;
    let skipped = conditions(axes, skip)?;
    let left_out = |choices: &Vec<usize>| {
        let holds = |(k, labels): &(usize, Vec<usize>)| labels.contains(&choices[*k]);
        skipped.iter().any(|condition| condition.iter().all(holds))
    };
    let kept: Vec<_> = all.into_iter().filter(|c| !left_out(c)).collect();
    match kept.is_empty() {
        true => Err(vec![SceneProblem::new("skip", "no variant is left")]),
        false => Ok(named(axes, kept)),
    }
}

fn product(axes: &[StudyAxis]) -> Result<Vec<Vec<usize>>, SceneProblem> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for axis in axes {
        if all.len().saturating_mul(axis.choices.len()) > MOST {
            let message = format!("these are more than {MOST} variants");
            return Err(SceneProblem::new("vary", message));
        }
        let with = |c: &Vec<usize>| {
            let longer = |k| c.iter().copied().chain([k]).collect();
            (0..axis.choices.len()).map(longer).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(with).collect();
    }
    Ok(all)
}

fn zipped(axes: &[StudyAxis]) -> Result<Vec<Vec<usize>>, SceneProblem> {
    let count = axes.first().map_or(1, |a| a.choices.len());
    if let Some(k) = axes.iter().position(|a| a.choices.len() != count) {
        let (first, other, long) = (&axes[0].name, &axes[k].name, axes[k].choices.len());
        let why = "axes that go side by side are equally long";
        let message = format!("{why}: `{first}` has {count}, `{other}` has {long}");
        return Err(SceneProblem::new(format!("vary[{k}]"), message));
    }
    Ok((0..count).map(|k| vec![k; axes.len()]).collect())
}

/// Number of an axis with those of its choices, all of which must hold.
type AxisChoices = Vec<(usize, Vec<usize>)>;

fn conditions(
    axes: &[StudyAxis],
    skip: &[BTreeMap<String, Value>],
) -> Result<Vec<AxisChoices>, Vec<SceneProblem>> {
    let mut problems = Vec::new();
    let mut all = Vec::new();
    for (n, given) in skip.iter().enumerate() {
        let at = format!("skip[{n}]");
        if given.is_empty() {
            let why = "an empty condition skips everything";
            problems.push(SceneProblem::new(&at, why));
        }
        let mut condition = AxisChoices::new();
        for (name, labels) in given {
            match choices(axes, name, labels) {
                Ok(found) => condition.push(found),
                Err(why) => problems.push(SceneProblem::new(format!("{at}.{name}"), why)),
            }
        }
        all.push(condition);
    }
    match problems.is_empty() {
        true => Ok(all),
        false => Err(problems),
    }
}

fn choices(axes: &[StudyAxis], name: &str, labels: &Value) -> Result<(usize, Vec<usize>), String> {
    let names = || axes.iter().map(|a| a.name.as_str());
    let axis = axes.iter().position(|a| a.name == name).ok_or_else(|| {
        let (near, known) = (suggestion(name, names()), comma_list(names()));
        format!("there is no axis called `{name}`{near} (there are: {known})")
    })?;
    let labels: Vec<String> = match labels {
        Value::Array(several) => several.iter().map(label).collect(),
        one => vec![label(one)],
    };
    let known = || axes[axis].choices.iter().map(|c| c.label.as_str());
    let find = |wanted: &String| {
        known().position(|l| l == wanted).ok_or_else(|| {
            let (near, known) = (suggestion(wanted, known()), comma_list(known()));
            format!("the axis has no `{wanted}`{near} (it has: {known})")
        })
    };
    let found: Result<Vec<usize>, String> = labels.iter().map(find).collect();
    Ok((axis, found?))
}

fn named(axes: &[StudyAxis], all: Vec<Vec<usize>>) -> Vec<Combination> {
    let mut taken = BTreeSet::new();
    let one = |choices: Vec<usize>| {
        let parts = axes.iter().zip(&choices);
        let parts = parts.map(|(a, k)| safe(&a.choices[*k].slug));
        let parts: Vec<String> = parts.filter(|p| !p.is_empty()).collect();
        let mut plain: String = parts.join("_").chars().take(LONGEST).collect();
        if plain.is_empty() {
            plain.push_str("scene");
        }
        let numbered = (2..).map(|number| format!("{plain}-{number}"));
        let mut names = std::iter::once(plain.clone()).chain(numbered);
        // Some file systems ignore case.
        let name = names.find(|name| taken.insert(name.to_lowercase()));
        let name = name.unwrap_or_default();
        Combination { name, choices }
    };
    all.into_iter().map(one).collect()
}

/// A text as it can stand in the name of a folder anywhere.
pub fn safe(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            c if c.is_ascii_alphanumeric() || "+=.".contains(c) => out.push(c),
            _ if out.ends_with('-') => {}
            _ => out.push('-'),
        }
    }
    out.trim_matches(['-', '.']).to_string()
}

/// True if a name fits a pattern with `*` and `?`.
///
/// The text after a `*` is tried at its first place; where the rest does not fit, the last `*` alone takes one letter
/// more. That is enough, and its time is at most the product of both lengths.
pub fn fits(pattern: &str, name: &str) -> bool {
    let [pattern, name] = [pattern, name].map(|text| text.chars().collect::<Vec<char>>());
    let (mut p, mut n) = (0, 0);
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(c) if *c == '?' || *c == name[n] => (p, n) = (p + 1, n + 1),
            _ => match star {
                Some((at, taken)) => {
                    (p, n) = (at + 1, taken + 1);
                    star = Some((at, taken + 1));
                }
                None => return false,
            },
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::axis::Choice;

    fn axis(name: &str, labels: &[&str]) -> StudyAxis {
        StudyAxis {
            name: name.into(),
            choices: labels.iter().map(|label| Choice::named(label)).collect(),
        }
    }

    fn names(combine: Combine, skip: &str) -> Result<Vec<String>, String> {
        #[derive(serde::Deserialize)]
        struct Skip {
            skip: Vec<BTreeMap<String, Value>>,
        }
        let Skip { skip } = toml::from_str(&format!("skip = {skip}")).unwrap();
        let axes = [axis("colour", &["red", "Blue"]), axis("n", &["1", "2"])];
        let all = combinations(&axes, combine, &skip).map_err(|p| p[0].to_string())?;
        Ok(all.into_iter().map(|c| c.name).collect())
    }

    #[test]
    fn axes_are_crossed_paired_and_thinned() {
        let all = ["red_1", "red_2", "Blue_1", "Blue_2"];
        assert_eq!(names(Combine::Product, "[]").unwrap(), all);
        assert_eq!(names(Combine::Zip, "[]").unwrap(), ["red_1", "Blue_2"]);
        let skip = "[{ colour = 'red', n = [2] }, { n = 1 }]";
        assert_eq!(names(Combine::Product, skip).unwrap(), ["Blue_2"]);
    }

    #[test]
    fn a_condition_that_names_nothing_is_told() {
        for (skip, message) in [
            ("[{ color = 'red' }]", "did you mean `colour`"),
            ("[{ colour = 'blu' }]", "did you mean `Blue`"),
            ("[{}]", "skips everything"),
            ("[{ n = [1, 2] }]", "no variant is left"),
        ] {
            let told = names(Combine::Product, skip).unwrap_err();
            assert!(told.contains(message), "{skip}: {told}");
        }
    }

    #[test]
    fn names_are_safe_and_distinct() {
        assert_eq!(safe("../a b/ρ: 25²"), "a-b-25");
        let axes = [axis("x", &["a/b", "A b", "*"])];
        let all = combinations(&axes, Combine::Product, &[]).unwrap();
        let names: Vec<_> = all.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["a-b", "A-b-2", "scene"]);
        assert!(fits("mor*_?5", "morris_25") && !fits("mor*_?5", "morris_125x"));
        assert!(fits("*25*", "a_225_x") && fits("", "") && fits("**", "") && !fits("", "a"));
        // Ways to spread the letters over the stars are without number.
        let pattern = "*a".repeat(40).replace("*a*a*a*a", "*a*a*a*b");
        assert!(!fits(&pattern, &"a".repeat(120)));
    }
}
