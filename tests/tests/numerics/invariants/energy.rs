//! The books of energy close, and friction takes what closed forms say.

use sph_core::System;
use sph_open as _;
use sph_particles::setup::Assembled;
use sph_tests::{Says, below, near};

use crate::invariants::{fly, shipped};

const BUDGET: &str = "probe.budget={ kind = \"energy-budget\" }";

/// The columns of the budget, by their names.
struct Budget(Vec<(String, f64)>);

impl Budget {
    fn new(parts: &Assembled<2>) -> Self {
        let (_, probe) = parts
            .probes
            .iter()
            .find(|(n, _)| n == "budget")
            .expect("it");
        let columns = probe.columns().into_iter().map(|c| c.suffix);
        let values = probe.measure(&parts.flow.world).unwrap();
        Budget(columns.zip(values).collect())
    }
    fn at(&self, name: &str) -> f64 {
        let found = self
            .0
            .iter()
            .find(|(n, _)| n.trim_start_matches('.') == name);
        found.expect(name).1
    }
    /// Energy is that of the start and the work of everybody: to rounding with what finite steps make, and to a thousandth of
    /// the `initial` energy, J, without.
    fn closes(&self, initial: f64) {
        let (unlisted, remainder) = (self.at("unlisted"), self.at("remainder"));
        below(unlisted, 1e-9 * initial, "J unlisted");
        below(remainder, 1e-3 * initial, "J that remain");
    }
}

/// A flow at the end of a time, s.
fn flown(name: &str, end: f64, more: &[&str]) -> Assembled<2> {
    let mut parts = shipped(name, &[&[BUDGET][..], more].concat());
    while parts.flow.time() < end {
        fly(&mut parts, 1, None);
    }
    parts
}

/// Water that falls, meets a wall and splashes has ½ρgWH² at the start. If it cannot be pulled, the books close with the
/// scene's steps. If it can, with a quarter of them: what steps make is of first order, 0.128, 0.063 and 0.029 J of
/// 61 J with 0.6 (the scene's), 0.3 and 0.15 h/c.
#[test]
fn the_budget_of_a_dam_break_closes_with_the_damper_and_without() {
    let initial = 0.5 * 1000.0 * 9.81 * 0.146 * 0.292 * 0.292;
    let torn = "phase.water.equation-of-state.tait.tension_limit=0";
    let short_steps = "integrator.symplectic-euler.courant=0.15";
    let damper = "damping.acoustic={}";
    for more in [
        vec![torn],
        vec![torn, damper],
        vec![short_steps],
        vec![short_steps, damper],
    ] {
        let mut overrides = vec!["numerics.spacing=0.01"];
        overrides.extend(more);
        let budget = Budget::new(&flown("dam-break-koshizuka", 0.5, &overrides));
        budget.closes(initial);
        let (taken, surface) = (budget.at("damper"), budget.at("surface"));
        assert!(taken <= 0.0 && (taken < 0.0) == overrides.contains(&damper));
        assert!(surface != 0.0, "the scene relaxes density constants");
        assert!(budget.at("smoother") < 0.0, "{:?}", budget.0);
    }
}

/// A standing wave has ¼ρga²λ for every wavelength: a thousandth of that with a quarter of the scene's steps. What steps make is
/// of first order and comes back: −0.0043, −0.0021 and −0.0011 J after a period with 0.4 (the scene's), 0.2 and 0.1 h/c.
#[test]
fn the_budget_of_a_standing_wave_closes() {
    let initial = 0.25 * 1000.0 * 0.05 * 0.05 * 2.0;
    let coarse = [
        "numerics.spacing=0.05 body.water.box=[[-1.0, 0.0], [1.0, 1.025]] \
         integrator.symplectic-euler.courant=0.1 surface={}",
    ];
    let budget = Budget::new(&flown("standing-wave-inviscid", 3.5515, &coarse));
    budget.closes(initial);
    assert_eq!(budget.at("surface"), 0.0, "nothing relaxes constants here");
}

/// Without relaxation the force of a renormalised surface takes what the strain of the densities gives, to the error of the
/// step, of first order: 4.8·10⁻⁴ J of the wave's 1.25 J, and 2.2·10⁻⁴ J with half the step.
#[test]
fn a_renormalised_surface_gives_no_energy() {
    let of_surface = |courant: &str| {
        let more = [
            "numerics.spacing=0.05",
            "body.water.box=[[-1.0, 0.0], [1.0, 1.025]]",
            "surface.renormalised.time=1e6",
            "smoother={}",
            courant,
        ];
        let budget = Budget::new(&flown("standing-wave-inviscid", 1.5, &more));
        let surface: f64 = budget.at("surface");
        surface.abs()
    };
    let whole = of_surface("integrator.symplectic-euler.courant=0.2");
    let half = of_surface("integrator.symplectic-euler.courant=0.1");
    println!("{whole:e} J, {half:e} J of 1.25 J");
    assert!(whole < 5e-4 && half < 0.6 * whole, "{whole:e}, {half:e}");
}

/// A force ρg drives a channel: once it flows, friction takes what the force gives, ρgLHū with ū = gH²/12ν. To 1 %, as good as
/// the profile is at 16 spacings across; explicitly, and solved for.
#[test]
fn friction_takes_what_drives_a_channel() {
    let power = 8.0 * 0.625 * 8.0 / 12.0;
    for more in [
        &[][..],
        &["implicit-viscosity.backward-euler={}", "smoother={}"],
    ] {
        let mut overrides = vec!["numerics.spacing=0.0625"];
        overrides.extend(more);
        let mut parts = flown("poiseuille-2d", 1.0, &overrides);
        let (start, before) = (parts.flow.time(), Budget::new(&parts));
        while parts.flow.time() < start + 0.1 {
            fly(&mut parts, 1, None);
        }
        let (now, time) = (Budget::new(&parts), parts.flow.time() - start);
        let rate = |name: &str| (now.at(name) - before.at(name)) / time;
        for (name, expected) in [("others", power), ("viscosity", -power)] {
            near(rate(name), expected, 0.01, name);
        }
        below(now.at("unlisted"), 1e-9 * now.at("others"), "J unlisted");
    }
}

/// Steps of another form, and particles that leave.
#[test]
fn flows_without_an_energy_budget_are_refused() {
    let refused = |more: &str| {
        let set = [BUDGET, "numerics.spacing=0.02", more];
        let scene = sph_tests::shipped("dam-break-koshizuka", &set);
        let refused = sph_particles::setup::assemble::<2>(&scene).err();
        refused.expect("a refusal").to_string()
    };
    let why = refused("integrator.leap-frog={}");
    why.says("probe.budget.kind | symplectic-euler");
    let why = refused("outlet.right={ beyond = 0.5 }");
    why.says("probe.budget.kind | leave");
}
