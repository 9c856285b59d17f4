//! Mistakes in a study are shown where they are, before anything runs.

use crate::study::{STUDY, bench, refuses};

#[test]
fn mistakes_are_shown_in_the_study_at_their_line() {
    refuses(STUDY, include_str!("study.refused"));
}

#[test]
fn a_study_that_is_not_there_is_refused() {
    let bench = bench(STUDY);
    for words in [
        "study nosuch",
        "study",
        "study s.toml --only x*",
        "study s.toml --set a",
    ] {
        assert_eq!(bench.call(words).code, Some(2), "sph {words}");
    }
    assert_eq!(bench.names(), ["s.toml"]);
}
