//! A scene carries what its plugins ask for and nothing else.

use sph_particles::setup::{Examination, examine};
use sph_tests::shipped;

fn examined(name: &str, overrides: &[&str]) -> Examination {
    examine(&shipped(name, overrides)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn columns(examined: &Examination) -> Vec<&str> {
    examined.fields.iter().map(|f| f.name.as_str()).collect()
}

#[test]
fn water_alone_carries_nothing_of_phases_laws_and_solves() {
    let water = examined("dam-break-koshizuka", &[]);
    let expected = "position velocity mass identity density_constant renormalisation density volume \
                    pressure free_surface acceleration density_constant_rate";
    assert_eq!(columns(&water).join(" "), expected);
    assert_eq!(water.bytes_per_particle, 116);
    assert_eq!(water.stages.len(), 6);
    let limits: Vec<&str> = water.step_limits.keys().map(String::as_str).collect();
    assert_eq!(limits, ["force", "smoother", "sound", "viscosity"]);
}

/// Densities that follow a rate have no constant that could be wrong: the table that relaxes it may stay, and costs nothing.
#[test]
fn surfaces_are_not_looked_for_where_densities_do_not_remember_them() {
    let over = ["formulation.colagrossi-landrini={}"];
    let water = examined("dam-break-koshizuka", &over);
    assert!(!columns(&water).contains(&"free_surface"));
    let pruned = &water.pruned;
    assert!(pruned.iter().any(|p| p == "free surface"), "{pruned:?}");
}

#[test]
fn a_law_brings_what_it_feels_and_no_more() {
    let channel = examined("bingham-poiseuille-bn0p1", &[]);
    let columns = columns(&channel);
    let felt = ["velocity_gradient", "strain_rate", "viscosity"];
    let all = felt.iter().all(|name| columns.contains(name));
    assert!(all, "{columns:?}");
    for unwanted in "elastic_stress carried_stress effective_pressure phase".split(' ') {
        assert!(!columns.contains(&unwanted), "{columns:?}");
    }
    // Without its yield stress the mud is a Newtonian fluid, and feels nothing.
    let newtonian = "phase.mud.rheology.bingham.yield_stress=0";
    let set = [newtonian, "output.picture=[\"velocity\"]"];
    let thin = examined("bingham-poiseuille-bn0p1", &set);
    let names: Vec<&str> = thin.fields.iter().map(|f| f.name.as_str()).collect();
    assert!(!felt.iter().any(|name| names.contains(name)), "{names:?}");
}
