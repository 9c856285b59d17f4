//! The pair term in lanes of `examples/artificial-viscosity`, and the bits of all widths of lanes.

use artificial_viscosity::ArtificialViscosity;
use sph_core::{Access, StepError, plugin};
use sph_kernels::lanes::{Width, force_width};
use sph_neighbours::{Interaction, Neighbourhood, Rates, RowTerm, TermEntry, WithTerm, World};
use sph_tests::{DAM_BREAK, FinalState, PERIODIC, SOAK, STIRRER, ran, scene};

/// The same term for one particle at a time.
#[plugin(TermEntry [2, 3], "artificial-viscosity-one-by-one", "the same for one particle at a time",
    source: "Monaghan 1992, Eq. 4.1 with β = 0")]
struct OneByOne(ArtificialViscosity);

/// A term without its loop over clusters.
struct ByRows<'a, const D: usize>(&'a dyn RowTerm<D>);

impl<const D: usize> RowTerm<D> for ByRows<'_, D> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        self.0.row(at, rates);
    }
}

impl<const D: usize> Interaction<D> for OneByOne {
    fn name(&self) -> String {
        Interaction::<D>::name(&self.0)
    }
    fn access(&self) -> Access {
        Interaction::<D>::access(&self.0)
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        self.0.with_columns(world, &mut |term| with(&ByRows(term)))
    }
}

/// A transparent wrapper shows the parameters of the term within, in listings and in the schema for editors.
#[test]
fn the_parameters_of_wrapped_terms_are_listed() {
    let kind = sph_core::kind_of("term");
    let all = (kind.expect("terms").plugins)();
    let wrapped = |name: &str| name.starts_with("artificial-viscosity");
    for plugin in all.iter().filter(|p| wrapped(p.name)) {
        let schema = (plugin.schema)();
        let listed = sph_core::parameters(&schema);
        assert_eq!(listed.len(), 1, "{}: {schema}", plugin.name);
        assert_eq!([&listed[0].name, &listed[0].unit], ["speed", "m/s"]);
        let told = schema["description"].as_str().unwrap_or_default();
        assert!(!told.contains("Interaction"), "{told}");
    }
}

/// The end of a run of some steps.
fn end_of(text: &str, steps: usize) -> FinalState {
    let most = format!("run.max_steps={steps}");
    let ran = ran(&scene(text, &[&most]), 2).unwrap_or_else(|e| panic!("{e}"));
    ran.state()
}

const TERM: &str = "[term.artificial-viscosity]\nspeed = 0.3\n";

/// Walls of all kinds, three dimensions, periodic faces, several phases and a soil.
#[test]
fn two_four_and_eight_lanes_end_with_the_same_bits() {
    let dummy = DAM_BREAK.replace("[walls.usaw]\nvertices = true", "[walls.dummy-particles]");
    let symmetric = DAM_BREAK.replace("[walls.usaw]\nvertices = true", "[walls.symmetric]");
    let scenes = [
        ("dam break", DAM_BREAK, 60),
        ("symmetric walls", &symmetric, 60),
        ("dummy particles", &dummy, 60),
        ("stirrer", STIRRER, 12),
        ("periodic", PERIODIC, 40),
        ("soak", SOAK, 12),
    ];
    for (name, scene, steps) in scenes {
        let scene = format!("{scene}\n{TERM}");
        let mut ends = Vec::new();
        for width in [Width::Two, Width::Four, Width::Eight] {
            force_width(Some(width));
            ends.push(end_of(&scene, steps));
        }
        force_width(None);
        ends[0].assert_same(&ends[1], &format!("{name}, 2 and 4 lanes"));
        ends[0].assert_same(&ends[2], &format!("{name}, 2 and 8 lanes"));
    }
}

#[test]
fn a_term_in_lanes_has_the_bits_of_one_particle_at_a_time() {
    for scene in [DAM_BREAK, PERIODIC] {
        let lanes = end_of(&format!("{scene}\n{TERM}"), 60);
        let term = TERM.replace("viscosity]", "viscosity-one-by-one]");
        let one = end_of(&format!("{scene}\n{term}"), 60);
        assert_eq!(lanes.columns, one.columns);
        let without = end_of(scene, 60);
        assert_ne!(lanes.columns, without.columns, "the term does something");
    }
}
