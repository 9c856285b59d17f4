//! The table of the README has the numbers that the runs print.

use std::path::Path;

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

/// The last cell of a scene's row.
fn told<'t>(readme: &'t str, scene: &str) -> &'t str {
    let begin = format!("| [`{scene}`]");
    let row = readme.lines().find(|line| line.starts_with(&begin));
    let row = row.unwrap_or_else(|| panic!("no row for {scene}"));
    let cells: Vec<&str> = row.split('|').collect();
    cells[cells.len() - 2]
}

#[test]
fn the_table_of_the_readme_has_what_short_runs_print() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    let readme = std::fs::read_to_string(path).expect("the README");
    let mut wrong = Vec::new();
    for (scene, errors) in ROWS {
        let run = whole(scene);
        let shown = percentages(told(&readme, scene));
        assert!(shown.len() >= errors.len(), "{scene}: {shown:?}");
        for (shown, error) in shown.iter().zip(errors) {
            let decimals = shown.split_once('.').map_or(0, |(_, digits)| digits.len());
            let value = run.summary.errors[*error].value;
            let value = 100.0 * value.expect("something was compared");
            let printed = format!("{value:.decimals$}");
            if printed != *shown {
                wrong.push(format!(
                    "{scene}: {error} is {value} %, the README has {shown} %"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
