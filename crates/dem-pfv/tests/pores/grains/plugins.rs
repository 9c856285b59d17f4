//! Contact laws from outside.

use dem_pfv::grains::{
    Contact, ContactLaw, ContactLawEntry, GrainError, GrainSystem, Setup, Stiffness, contact_law,
};
use dem_pfv::require;
use sph_core::{plugin, plugins_of};

use crate::grains::{RADIUS, grain, position, run};
use crate::{assert_says, close};

/// Repels with k δ and remembers its largest overlap: unloading is half as stiff.
#[plugin(ContactLawEntry, "bruised", "half as stiff when unloading", source: "a test")]
struct Bruised {
    /// k.
    #[parameter(unit: "N/m")]
    stiffness: f64,
}

impl ContactLaw for Bruised {
    fn check(&self) -> Result<(), GrainError> {
        let k = self.stiffness;
        Ok(require("the stiffness is", k, "positive", k > 0.0)?)
    }
    fn memory(&self) -> &'static [&'static str] {
        &["largest overlap"]
    }
    fn respond(&self, contacts: &mut [Contact]) {
        for contact in contacts {
            let before = contact.memory[0];
            contact.memory[0] = before.max(contact.overlap);
            let share = if contact.overlap < before { 0.5 } else { 1.0 };
            contact.force = contact.normal * (share * self.stiffness * contact.overlap);
        }
    }
    fn stiffness(&self, _radius: [f64; 2], _overlap: f64) -> Stiffness {
        Stiffness {
            normal: self.stiffness,
            ..Stiffness::default()
        }
    }
}

#[test]
fn a_law_of_another_crate_is_found_and_remembers() {
    let laws = plugins_of::<ContactLawEntry>();
    let names: Vec<_> = laws.iter().map(|law| law.name).collect();
    assert_eq!(names, ["bruised", "hertz-mindlin", "linear-elastic"]);
    let law = contact_law("bruised", &table("stiffness = 1e4")).expect("the law");
    let grains = vec![
        grain(-RADIUS, 0.0, 0.0).moving([0.1, 0.0, 0.0]),
        grain(RADIUS, 0.0, 0.0).moving([-0.1, 0.0, 0.0]),
    ];
    let setup = Setup {
        grains,
        laws: vec![law],
        ..Setup::default()
    };
    let mut system = GrainSystem::new(setup).expect("pair");
    let step = 1e-3 * system.critical_step();
    run(&mut system, step, 6000);
    assert!(position(&system, 1).x > RADIUS);
    // Half the energy comes back.
    let back = system.grains.velocity[1].x / 0.1;
    close(back * back, 0.5, 1e-3);
}

fn table(parameters: &str) -> toml::Table {
    parameters.parse().expect("TOML")
}

#[test]
fn schemas_carry_units() {
    let laws = plugins_of::<ContactLawEntry>();
    let linear = laws.iter().find(|l| l.name == "linear-elastic");
    let linear = linear.expect("it");
    assert_eq!((linear.schema)()["properties"]["modulus"]["unit"], "Pa");
    assert!(linear.source.contains("Catalano 2012"));
}

#[test]
fn wrong_names_and_parameters_are_refused() {
    let unknown = contact_law("linear", &table("")).expect_err("unknown");
    assert_says(unknown, "linear-elastic");
    for (wrong, told) in [
        ("modulus = 1e6\ncolour = 1", "colour"),
        ("modulus = -1e6", "-1000000"),
    ] {
        let rest = "stiffness_ratio = 0.5\nfriction = 0.5";
        let parameters = table(&format!("{wrong}\n{rest}"));
        let error = contact_law("linear-elastic", &parameters).expect_err(told);
        assert_says(error, told);
    }
}
