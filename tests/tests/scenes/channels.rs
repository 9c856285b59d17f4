//! Poiseuille and Couette flow between semi-analytical walls, from rest to the steady profile.

use crate::shipped::finished;

#[test]
fn poiseuille_converges_from_1_86_to_1_14_per_cent() {
    let coarse = finished("poiseuille-2d", &["numerics.spacing=0.0625"]);
    let coarse = coarse.error("profile", 0.022, 0.0186);
    let fine = finished("poiseuille-2d", &["numerics.spacing=0.03125"]);
    let fine = fine.error("profile", 0.013, 0.0114);
    assert!(
        fine < 0.8 * coarse,
        "halving the spacing: {coarse} to {fine}"
    );
}

#[test]
fn couette_is_met_to_0_24_per_cent() {
    finished("couette-2d", &[]).error("profile", 0.01, 0.0024);
}
