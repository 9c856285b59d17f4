//! Axes that are gone along from harmless to absurd, each with its own scene.

use sph_core::{SceneProblem, comma_list, suggestion};

use crate::reading::axis::label;
use crate::reading::combine::{MOST, combinations, safe};
use crate::reading::reader::{Inputs, Reader};
use crate::reading::{axis, file};
use crate::{
    Bounds, Choice, Combine, Frontier, Ladder, QUANTITIES, Refused, Rung, SceneText, StudyAxis,
    StudyFile, Variant,
};

/// Names of the axes to which the labels of such a study's variants belong.
const COLUMNS: [&str; 3] = ["axis", "combination", "value"];

pub fn columns() -> Vec<StudyAxis> {
    COLUMNS.map(|name| column(name, Vec::new())).to_vec()
}

fn column(name: &str, choices: Vec<Choice>) -> StudyAxis {
    let name = name.to_string();
    StudyAxis { name, choices }
}

/// Every axis, and its variants in the order in which they run.
///
/// # Errors
/// All mistakes of the axes, else all of their scenes.
pub fn read(inputs: &Inputs<'_>) -> Result<(Vec<Ladder>, Vec<Variant>), Refused> {
    let (file, source) = (&inputs.file, &inputs.source);
    let mut problems = study_problems(file);
    let mut ladders = Vec::new();
    for (k, given) in file.axis.iter().enumerate() {
        match one(file, given, &format!("axis[{k}]"), inputs.find) {
            Ok(ladder) => ladders.push(ladder),
            Err(found) => problems.extend(found),
        }
    }
    if !problems.is_empty() {
        return Err(Refused::in_study(source, &problems));
    }
    let mut variants = Vec::new();
    let mut mistakes = Vec::new();
    for (k, (_, scene, axes)) in ladders.iter().enumerate() {
        let common = axis::sets(&file.set, "set").and_then(|mut sets| {
            sets.extend(axis::sets(&file.axis[k].set, &format!("axis[{k}].set"))?);
            Ok(sets)
        });
        let common = common.map_err(|p| Refused::in_study(source, &[p]))?;
        let all = combinations(axes, Combine::Product, &[]);
        let all = all.map_err(|problems| Refused::in_study(source, &problems))?;
        if variants.len() + all.len() > MOST {
            let message = format!("with this axis there are more than {MOST} variants");
            return Err(Refused::at(source, &format!("axis[{k}]"), message));
        }
        let errors = &file.axis[k].error;
        let reader = Reader {
            inputs,
            scene,
            axes,
            common,
            refinement: None,
            errors: errors.paths(&format!("axis[{k}].error")),
        };
        match reader.all(&all) {
            Err(refused) => mistakes.extend(refused.mistakes),
            Ok(read) => variants.extend(read.into_iter().zip(&all).map(|(variant, c)| {
                let rung = Rung {
                    ladder: k,
                    combination: c.choices[1],
                    value: c.choices[2],
                };
                let rung = Some(rung);
                Variant { rung, ..variant }
            })),
        }
    }
    match mistakes.is_empty() {
        true => Ok((ladders.into_iter().map(|l| l.0).collect(), variants)),
        false => Err(Refused { mistakes }),
    }
}

fn study_problems(file: &StudyFile) -> Vec<SceneProblem> {
    let mut problems = Vec::new();
    let mut problem = |path: String, message: &str| problems.push(SceneProblem::new(path, message));
    if !file.vary.is_empty() {
        problem("vary".into(), "a study has either `vary` or `axis`");
    }
    if file.refinement.is_some() {
        problem("refinement".into(), "a study with `axis` has no refinement");
    }
    if !file.error.paths("error").is_empty() {
        problem("error".into(), "every `axis` names its own errors");
    }
    let names = file.axis.iter().map(|a| safe(&a.name).to_lowercase());
    let names: Vec<String> = names.collect();
    for (k, name) in names.iter().enumerate() {
        if names[..k].contains(name) {
            let why = "there is another axis of that name";
            problem(format!("axis[{k}].name"), why);
        }
    }
    let known = || file.axis.iter().map(|a| a.name.as_str());
    for (k, combination) in file.combination.iter().enumerate() {
        for (n, wanted) in combination.axes.iter().enumerate() {
            if !known().any(|name| name == wanted) {
                let near = suggestion(wanted, known());
                let message = format!("there is no axis called `{wanted}`{near}");
                problem(format!("combination[{k}].axes[{n}]"), &message);
            }
        }
    }
    problems
}

/// A ladder with its scene; the ladder itself, the combinations and the values as axes.
fn one(
    file: &StudyFile,
    given: &file::Ladder,
    at: &str,
    find: &dyn Fn(&str) -> Result<SceneText, String>,
) -> Result<(Ladder, SceneText, [StudyAxis; 3]), Vec<SceneProblem>> {
    let problem =
        |key: &str, message: String| vec![SceneProblem::new(format!("{at}{key}"), message)];
    let values = axis::one(Some(&given.name), &given.places, at);
    let mut values = values.map_err(|problem| vec![problem])?;
    for choice in &mut values.choices {
        // Labels alone name folders.
        choice.slug.clone_from(&choice.label);
    }
    let labels: Vec<String> = values.choices.iter().map(|c| c.label.clone()).collect();
    let must = given.must.as_ref().map(|must| {
        let must = label(must);
        labels.iter().position(|l| *l == must).ok_or_else(|| {
            let known = labels.join(", ");
            let why = format!("the axis has no `{must}` (it has: {known})");
            problem(".must", why)
        })
    });
    let must = must.transpose()?;
    let named = given.scene.as_ref().or(file.scene.as_ref());
    let missing = || problem("", "neither the axis nor the study has a scene".into());
    let scene = find(named.ok_or_else(missing)?).map_err(|why| problem(".scene", why))?;
    let errors = given.error.paths(&format!("{at}.error"));
    let errors: Vec<String> = errors.into_iter().map(|e| e.0).collect();
    let (judge, path) = match given.judge.is_empty() {
        true => (&file.judge, "judge".to_string()),
        false => (&given.judge, format!("{at}.judge")),
    };
    check(judge, &errors, &path)?;
    let [own, combination, value] = COLUMNS;
    let axes = [
        column(own, vec![Choice::named(&given.name)]),
        column(combination, plugins(file, given)?),
        column(value, values.choices),
    ];
    let frontier = Frontier {
        axis: given.name.clone(),
        title: given.title.clone(),
        scene: scene.name.clone(),
        errors,
        judge: judge.clone(),
        must: must.map(|k| labels[k].clone()),
        values: labels,
        ..Frontier::default()
    };
    let ladder = Ladder {
        frontier,
        must,
        to_the_end: given.to_the_end,
    };
    Ok((ladder, scene, axes))
}

/// The combinations of plugins that are for an axis; one without a name if there are none.
fn plugins(file: &StudyFile, given: &file::Ladder) -> Result<Vec<Choice>, Vec<SceneProblem>> {
    let all = file.combination.iter().enumerate();
    let fitting = all.filter(|(_, c)| c.axes.is_empty() || c.axes.contains(&given.name));
    let choice = |(k, c): (usize, &file::Combination)| {
        Ok(Choice {
            sets: axis::sets(&c.set, &format!("combination[{k}].set"))?,
            ..Choice::named(&c.name)
        })
    };
    let choices: Result<Vec<Choice>, SceneProblem> = fitting.map(choice).collect();
    let mut choices = choices.map_err(|p| vec![p])?;
    if choices.is_empty() {
        choices.push(Choice::default());
    }
    Ok(choices)
}

/// Refuses bounds of quantities that no run of the axis has, and bounds in the wrong order.
fn check(judge: &Bounds, errors: &[String], path: &str) -> Result<(), Vec<SceneProblem>> {
    let errors = errors.iter().map(String::as_str);
    let known = || errors.clone().chain(QUANTITIES.iter().map(|q| q.0));
    let mut problems = Vec::new();
    for (name, [green, yellow]) in judge {
        let at = format!("{path}.{name}");
        if !known().any(|k| k == name) {
            let near = suggestion(name, known());
            let list = comma_list(known());
            let message = format!("nothing is called `{name}`{near} (there are: {list})");
            problems.push(SceneProblem::new(&at, message));
        }
        if !(*green >= 0.0 && yellow >= green) {
            let message =
                "bounds are the largest green and the largest yellow value, in this order";
            problems.push(SceneProblem::new(at, message));
        }
    }
    match problems.is_empty() {
        true => Ok(()),
        false => Err(problems),
    }
}
