//! Mistakes in a study are shown where they are, before anything runs.

use crate::study::{STUDY, bench, files, says, with};

/// The study is refused with code 2, at the line that contains `line`, and leaves no file.
fn refused(study: &str, line: &str, words: &[&str]) {
    let bench = bench(study);
    let number = 1 + study
        .lines()
        .position(|l| l.contains(line))
        .expect("the line is there");
    let outcome = bench.call("study s.toml");
    assert_eq!(outcome.code, Some(2), "{}", outcome.err);
    says(&outcome, words);
    says(&outcome, &[&format!("s.toml:{number}:")]);
    assert_eq!(files(bench.folder()), ["s.toml"], "something was written");
}

#[test]
fn a_misspelt_key_of_the_study_is_refused() {
    let words = ["did you mean `values`", "nothing was written"];
    refused(&with("values", "valeus"), "valeus", &words);
    refused(&with("error", "eror"), "eror", &["did you mean `error`"]);
    let time = with("[[vary]]\nname", "[[vary]]\ntime_limit = 1\nname");
    refused(&time, "time_limit", &["vary[0].time_limit"]);
}

#[test]
fn an_unknown_scene_of_an_entry_is_shown_there() {
    refused(
        &with(
            "name = \"krimi\"",
            "name = \"krimi\", scene = \"taylor-gren-2d\"",
        ),
        "taylor-gren-2d",
        &["vary[0].entries[1].scene", "did you mean `taylor-green-2d`"],
    );
}

#[test]
fn a_misspelt_scene_key_is_shown_in_the_study() {
    refused(
        &with("numerics.spacing", "numerics.spcing"),
        "[0.0625",
        &["numerics.spcing", "did you mean `spacing`"],
    );
    refused(
        &with("krimi = {}", "krimmi = {}"),
        "krimmi",
        &[
            "no viscous-operator called `krimmi`",
            "did you mean `krimi`",
        ],
    );
    refused(
        &with("0.05, ", "-0.05, "),
        "-0.05",
        &["numerics.spacing", "more than 0"],
    );
    refused(
        &with("run.end", "run.edn"),
        "run.edn",
        &["did you mean `end`"],
    );
}

#[test]
fn an_error_or_scene_that_is_not_there_is_refused() {
    refused(
        &with("velocity-l1", "velocity-l2"),
        "velocity-l2",
        &[
            "no reference called `velocity-l2`",
            "did you mean `velocity-l1`",
        ],
    );
    refused(
        &with("taylor-green-2d", "tailor-green-2d"),
        "tailor",
        &["did you mean `taylor-green-2d`"],
    );
    refused(
        &with("[[vary]]", "[[skip]]\nviscosity = \"moris\"\n[[vary]]"),
        "moris",
        &["did you mean `morris`"],
    );
    let bench = bench(STUDY);
    for words in [
        "study nosuch",
        "study",
        "study s.toml --only x*",
        "study s.toml --set a",
    ] {
        assert_eq!(bench.call(words).code, Some(2), "sph {words}");
    }
    assert_eq!(files(bench.folder()), ["s.toml"]);
}
