//! The limit of small steps that `taylor-green-time-order` names is that of this program.

use sph_tests::{bench, close};

/// Two schemes of second order with steps of 0.4 h/c and half of that: within 0.15 of it, which is asked of the orders of
/// all velocities too (docs/validation/implicit.md).
#[test]
fn verlet_and_leap_frog_are_of_second_order_towards_the_limit_of_the_shipped_study() {
    let bench = bench!();
    let only = "--only verlet_step-1 --only verlet_step-0.5 --only leap-frog_step-1 --only leap-frog_step-0.5";
    bench.done(&format!(
        "study taylor-green-time-order --threads 1 --out s {only}"
    ));
    let told = bench.json("s/study.json");
    let variants = told["variants"].as_array().expect("variants");
    let energy = |name: &str| {
        let variant = variants.iter().find(|v| v["name"] == name);
        let error = variant.and_then(|v| v["errors"]["energy"]["value"].as_f64());
        error.unwrap_or_else(|| panic!("no error of {name} in {told:#}"))
    };
    for scheme in ["verlet", "leap-frog"] {
        let ratio = energy(&format!("{scheme}_step-1")) / energy(&format!("{scheme}_step-0.5"));
        let order = ratio.log2();
        println!("{scheme}: order {order:.3}");
        close(order, 2.0, 0.15, &format!("order of {scheme}"));
    }
}
