//! Poiseuille and Couette flow between semi-analytical walls, from rest to the steady profile.

use crate::shipped::finished;

#[test]
fn poiseuille_converges_from_0_18_to_0_048_per_cent() {
    let coarse = finished("poiseuille-2d", &["numerics.spacing=0.0625"]);
    let coarse = coarse.error("profile", 0.002, 0.00179);
    let fine = finished("poiseuille-2d", &["numerics.spacing=0.03125"]);
    let fine = fine.error("profile", 0.00055, 0.000475);
    assert!(
        fine < 0.3 * coarse,
        "halving the spacing: {coarse} to {fine}"
    );
}

#[test]
fn couette_is_met_to_0_0074_per_cent() {
    finished("couette-2d", &[]).error("profile", 0.0001, 0.0000738);
}
