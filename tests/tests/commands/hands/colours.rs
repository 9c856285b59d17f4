//! Values at the ends of the colours of pictures.

use sph_tests::{DAM_BREAK, Says, bench};

const SHORT: &str =
    "--set run.end=0.02 --set output.every=0.02 --set output.picture=[\"pressure\",\"velocity\"]";

#[test]
fn a_range_by_field_colours_its_field_and_leaves_the_others() {
    let bench = bench!(DAM_BREAK);
    for (set, out) in [
        ("", "free"),
        ("--set output.picture_range=[0,9000]", "all"),
        ("--set output.picture_range={pressure=[0,9000]}", "by-field"),
    ] {
        bench.done(&format!(
            "run scene.toml -q --threads 1 {SHORT} {set} --out {out}"
        ));
    }
    let picture = |out: &str, field: &str| {
        std::fs::read(bench.path(&format!("{out}/pictures/{field}_0001.png"))).expect("a picture")
    };
    let same = |a, b, field| picture(a, field) == picture(b, field);
    assert!(same("by-field", "all", "pressure"));
    assert!(!same("by-field", "free", "pressure"));
    assert!(same("by-field", "free", "velocity"));
    assert!(!same("all", "free", "velocity"));
}

#[test]
fn a_range_of_no_field_is_told_with_the_nearest_name_and_one_of_a_field_that_is_not_drawn_is_kept()
{
    let bench = bench!(DAM_BREAK);
    let checked = |set: &str| {
        bench.call(&format!(
            "check scene.toml --set output.picture_range.{set}"
        ))
    };
    checked("presure=[0,1]")
        .ended(2)
        .says("output.picture_range.presure | did you mean `pressure`?");
    let falling = checked("pressure=[1,0]");
    falling.says("output.picture_range.pressure | the first must be less than the second");
    assert_eq!(checked("vorticity=[-50,50]").code, Some(0));
}

#[test]
fn colours_are_those_of_the_whole_run_also_after_a_resume() {
    let bench = bench!(DAM_BREAK);
    let set =
        "--set run.end=0.1 --set output.every=0.02 --set output.picture=[\"pressure\",\"speed\"]";
    let whole = bench.call(&format!("run scene.toml --threads 1 {set} --out whole"));
    whole.says("colours of `speed` go from 0 to");
    whole.err.lacks("colours of `pressure`");
    bench.call(&format!(
        "run scene.toml -q --threads 1 {set} --set run.max_steps=60 --out parts"
    ));
    bench.done(&format!(
        "run scene.toml -q --threads 1 {set} --out parts --resume --changed"
    ));
    let pictures =
        |out: &str| sph_tests::files_with_extension(&bench.path(out).join("pictures"), "png");
    let (all, again) = (pictures("whole"), pictures("parts"));
    assert_eq!((all.len(), again.len()), (12, 12));
    for (a, b) in all.iter().zip(&again) {
        let read = |path: &std::path::PathBuf| std::fs::read(path).expect("a picture");
        assert!(read(a) == read(b), "{}", b.display());
    }
}
