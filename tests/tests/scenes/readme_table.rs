//! The tables of shipped scenes have the numbers that the runs print.

use std::path::Path;

use sph_tests::list_items;

use crate::shipped::whole;

/// Scenes that take seconds, and their errors in the order of the table. The stress on the other wall of the last one is
/// nearer.
const ROWS: [(&str, &[&str]); 7] = [
    ("hydrostatic-tank", &["pressure", "pressure-l2", "rest"]),
    ("couette-2d", &["profile"]),
    (
        "taylor-green-2d",
        &["velocity-l1", "velocity-linf", "decay"],
    ),
    ("bingham-poiseuille-bn0p1", &["profile", "ideal"]),
    ("submarine-avalanche", &["speed"]),
    ("poiseuille-creep", &["profile"]),
    ("viscosity-jump", &["stress-above"]),
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

/// What a scene's item tells as its errors.
fn told<'t>(items: &'t [String], scene: &str) -> Option<&'t str> {
    let begin = format!("[`{scene}`]");
    let item = items.iter().find(|item| item.starts_with(&begin))?;
    item.split_once(" Error: ").map(|(_, errors)| errors)
}

#[test]
fn the_tables_of_scenes_have_what_short_runs_print() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = |name: &str| std::fs::read_to_string(root.join(name)).expect("a page");
    let (all, readme) = (list_items(&page("docs/scenes.md")), page("README.md"));
    let mut wrong = Vec::new();
    for (scene, errors) in ROWS {
        let run = whole(scene);
        let shown = percentages(told(&all, scene).expect("every scene is on the page"));
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
    // The README's rows are some of the page's items.
    let mut rows = 0;
    for row in readme.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let [name, shows, against, error] = cells[..] else {
            continue;
        };
        rows += 1;
        let item = all.iter().find(|i| i.starts_with(&format!("[{name}]")));
        let item = item.unwrap_or_else(|| panic!("{name} is not on the page"));
        let words = format!(": {shows}. Measured against: {against}. Error: {error}.");
        assert!(item.ends_with(&words), "README: {row}\nthe page: {item}");
    }
    assert_eq!(rows, 6, "scenes in the README");
}
