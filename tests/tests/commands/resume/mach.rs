//! Flow that is faster than its sound ends a run, unless the scene allows it.

use sph_tests::{PERIODIC, bench};

#[test]
fn above_a_mach_number_of_0p3_it_is_said_once_and_above_1_the_run_ends() {
    let bench = bench!(PERIODIC);
    // The whole fluid flies at 20 m/s.
    let run = |sound: f64, more: &str| {
        let set = format!(
            "--set run.end=0.004 --set phase.water.speed_of_sound={sound} --set body.all.velocity=[20,0] {more}"
        );
        bench.call(&format!("run scene.toml --out r {set}"))
    };
    let slow = run(200.0, "").ended(0);
    assert!(!slow.err.contains("of the speed of sound"), "{}", slow.err);
    let fast = run(40.0, "").ended(0);
    let remarks = fast.err.matches("faster than 0.3 of the speed of sound");
    assert_eq!(remarks.count(), 1, "{}", fast.err);
    let supersonic = run(10.0, "").ended(1);
    supersonic.says("Mach number | 100 % of the mass | numerics.supersonic = true");
    run(10.0, "--set numerics.supersonic=true").ended(0);
}
