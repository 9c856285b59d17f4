//! The gallery and the README have the numbers that the runs print.

use std::path::Path;

use sph_tests::list_items;

use crate::shipped::whole;

/// Scenes that take seconds, and their errors in the order of the table.
const ROWS: [(&str, &[&str]); 9] = [
    ("hydrostatic-tank", &["pressure", "pressure-l2", "rest"]),
    ("couette-2d", &["profile"]),
    (
        "taylor-green-2d",
        &["velocity-l1", "velocity-linf", "decay"],
    ),
    ("patch-of-fluid", &["energy"]),
    (
        "elliptical-drop",
        &["semi-axis-x", "semi-axis-y", "velocity", "pressure"],
    ),
    ("bingham-poiseuille-bn0p1", &["profile", "ideal"]),
    ("submarine-avalanche", &["speed"]),
    ("poiseuille-creep", &["profile"]),
    ("viscosity-jump", &["stress-above", "stress-below"]),
];

/// The number at the end of a text, as it is written.
fn last_number(text: &str) -> &str {
    let text = text.trim_end();
    let before = text.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
    &text[before.len()..]
}

/// The numbers before per cent signs.
fn percentages(text: &str) -> Vec<&str> {
    let pieces: Vec<&str> = text.split('%').collect();
    let before = &pieces[..pieces.len() - 1];
    before.iter().map(|piece| last_number(piece)).collect()
}

/// The item of a scene that tells its error, not that of where to start.
fn item<'t>(items: &'t [String], scene: &str) -> Option<&'t String> {
    let begin = format!("[`{scene}`]");
    let mut items = items.iter().filter(|item| item.starts_with(&begin));
    items.find(|item| item.contains(" Error: "))
}

/// What a scene's item tells as its errors.
fn stated<'t>(items: &'t [String], scene: &str) -> Option<&'t str> {
    let (_, errors) = item(items, scene)?.split_once(" Error: ")?;
    errors.split_once(" Time: ").map(|(errors, _)| errors)
}

#[test]
fn the_gallery_and_the_readme_have_what_short_runs_print() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = |name: &str| std::fs::read_to_string(root.join(name)).expect("a page");
    let (all, readme) = (list_items(&page("docs/gallery.md")), page("README.md"));
    let mut wrong = Vec::new();
    for (scene, errors) in ROWS {
        let run = whole(scene);
        let shown = percentages(stated(&all, scene).expect("every scene is on the page"));
        assert!(shown.len() >= errors.len(), "{scene}: {shown:?}");
        for (shown, error) in shown.iter().zip(errors) {
            let decimals = shown.split_once('.').map_or(0, |(_, digits)| digits.len());
            let value = run.summary.errors[*error].value;
            let value = 100.0 * value.expect("something was compared");
            let printed = format!("{value:.decimals$}");
            if printed != *shown {
                wrong.push(format!(
                    "{scene}: {error} is {value} %, the page has {shown} %"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    // The README's rows are some of them.
    let mut rows = 0;
    for row in readme.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let [name, shows, against, error, time] = cells[..] else {
            continue;
        };
        rows += 1;
        let name = name.trim_matches('`');
        let held = ROWS.iter().any(|(scene, _)| name == *scene);
        assert!(held, "{name} is in the README, and no run holds its error");
        let item = item(&all, name).unwrap_or_else(|| panic!("{name} is not on the page"));
        let words =
            format!(": {shows}. Measured against: {against}. Error: {error}. Time: {time}.");
        assert!(item.contains(&words), "README: {row}\nthe page: {item}");
    }
    assert_eq!(rows, 6, "scenes in the README");
}
