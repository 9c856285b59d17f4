//! Beds and gates that nobody wants: refused at their line, or remarked upon before the run starts.

use sph_tests::{CHECK_AND_RUN, Says, bench, one_line};

const BED: &str = include_str!("../../../../scenes/saturated-bed-at-rest.toml");

#[test]
fn nothing_is_odd_about_the_shipped_bed() {
    let told = one_line(&bench!(BED).done("check scene.toml").out);
    told.lacks("stands above | beneath them | spacings wide | bounds the first step");
}

#[test]
fn dry_hanging_coarse_and_stiff_beds_are_remarked_upon() {
    bench!().remarks(BED, include_str!("odd_beds.remarked"));
}

#[test]
fn a_gate_faster_than_sound_is_refused() {
    let changes = include_str!("odd_beds.refused");
    bench!().refuses("scene.toml", &CHECK_AND_RUN, BED, changes);
}
