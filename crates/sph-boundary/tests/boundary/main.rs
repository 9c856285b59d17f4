//! Wall integrals, wall geometry and wall treatments, in the plane and in space.

mod bench;
mod constrain;
mod dummy;
mod gamma;
mod motion;
mod plugin;
mod random;
mod spatial;
mod spatial_plugin;
mod surface;
mod vector;
mod walls;

/// Fails where a number is off by `most` or more.
#[track_caller]
fn close(found: f64, expected: f64, most: f64, at: impl std::fmt::Debug) {
    let off = (found - expected).abs();
    assert!(
        off < most,
        "{at:?}: {found} instead of {expected}, off by {off:e}"
    );
}
