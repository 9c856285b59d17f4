//! Velocity gradients are computed where somebody reads them, and nowhere else.

use sph_core::{System, Vect, fields};
use sph_tests::move_as;

use crate::soils::tried;

/// The first phase of the scene.
const SLIDE: u32 = 0;

/// Largest strain rate of mud and of water that shear alike, 1/s.
fn rates(overrides: &[&str]) -> [f64; 2] {
    let mut parts = tried("submarine-landslide", overrides).unwrap_or_else(|e| panic!("{e}"));
    move_as(&mut parts, |x| Vect::from([x[1], 0.0]));
    parts.flow.evaluate().unwrap();
    let free = &parts.flow.world.free;
    let phase = free.get(fields::PHASE).unwrap();
    let rate = free.get(fields::STRAIN_RATE).unwrap();
    let largest = |mud: bool| {
        let all = rate.iter().zip(phase);
        let all = all.filter(|(_, p)| (**p == SLIDE) == mud);
        all.fold(0.0_f64, |most, (rate, _)| most.max(*rate))
    };
    [largest(true), largest(false)]
}

#[test]
fn water_beside_mud_has_a_strain_rate_where_it_is_asked_for() {
    let coarse = "numerics.spacing=0.05";
    let [mud, water] = rates(&[coarse]);
    assert!(mud > 0.5 && water == 0.0, "{mud} and {water} 1/s");
    let probed = rates(&[coarse, "probe.all={kind='yielded',strain_rate=0.1}"]);
    let shown = rates(&[coarse, "output.fields=['strain_rate']"]);
    for [same, water] in [probed, shown] {
        assert_eq!(same, mud);
        assert!(water > 0.5, "{water} 1/s");
    }
}
