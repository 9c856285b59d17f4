//! Animations of the pictures of a run.

use sph_tests::{DAM_BREAK, Says, bench};

#[test]
fn an_animation_has_a_frame_for_every_picture_and_is_there_after_a_resume() {
    let bench = bench!(DAM_BREAK);
    let set = "--set output.picture=pressure --set output.animation=5 --set run.end=0.1 --set output.every=0.025";
    bench.done(&format!("run scene.toml -q --threads 1 {set} --out whole"));
    let whole = std::fs::read(bench.path("whole/animations/pressure.gif")).expect("an animation");
    assert_eq!(&whole[..6], b"GIF89a");
    // Every frame is introduced by its delay: a graphic control extension of four bytes.
    let delay = |hundredths: u8| {
        let frames = whole
            .windows(6)
            .filter(|w| w[..3] == [0x21, 0xF9, 4] && w[4] == hundredths && w[5] == 0);
        frames.count()
    };
    assert_eq!((delay(20), delay(150)), (4, 1));
    bench.failed(&format!(
        "run scene.toml -q --threads 1 {set} --set run.max_steps=30 --out parts"
    ));
    bench.done(&format!(
        "run scene.toml -q --threads 1 {set} --out parts --resume --changed"
    ));
    let parts = std::fs::read(bench.path("parts/animations/pressure.gif")).expect("an animation");
    assert!(parts == whole, "{} and {} bytes", parts.len(), whole.len());
    let listed = bench
        .done(&format!("run scene.toml --threads 1 {set} --out whole"))
        .out;
    listed.says("animations/pressure.gif");
}

#[test]
fn pictures_are_joined_to_a_film_unless_the_scene_wants_none() {
    let bench = bench!(DAM_BREAK);
    let set = "--set output.picture=pressure --set run.end=0.02";
    bench.done(&format!("run scene.toml -q {set} --out a"));
    assert!(bench.path("a/animations/pressure.gif").is_file());
    // No film of an earlier run stays.
    bench.done(&format!(
        "run scene.toml -q {set} --set output.animation=0 --out a"
    ));
    assert!(!bench.path("a/animations").exists());
    bench.refused("check scene.toml --set output.animation=-1");
}
