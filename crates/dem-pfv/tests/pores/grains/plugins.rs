//! Contact laws from outside.

use dem_pfv::grains::{
    Contact, ContactLaw, GrainError, GrainSystem, Setup, Stiffness, contact_law, contact_laws,
    require,
};
use dem_pfv::register_law;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::json;

use crate::grains::{RADIUS, close, grain, position};

/// Repels with k δ and remembers its largest overlap: unloading is half as stiff.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Bruised {
    /// k.
    #[schemars(extend("unit" = "N/m"))]
    stiffness: f64,
}

impl ContactLaw for Bruised {
    fn check(&self) -> Result<(), GrainError> {
        let k = self.stiffness;
        require("bruised", "stiffness", k, "positive", k > 0.0)
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

register_law!(
    Bruised as ContactLaw,
    "bruised",
    "half as stiff when unloading",
    "nobody"
);

#[test]
fn a_law_of_another_crate_is_found_and_remembers() {
    let names: Vec<_> = contact_laws().iter().map(|entry| entry.name).collect();
    assert_eq!(names, ["bruised", "hertz-mindlin", "linear-elastic"]);
    let law = contact_law("bruised", &json!({ "stiffness": 1e4 })).expect("the law");
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
    crate::grains::run(&mut system, step, 6000);
    assert!(position(&system, 1).x > RADIUS);
    // Half the energy comes back.
    let back = system.grains.velocity[1].x / 0.1;
    close(back * back, 0.5, 1e-3);
}

#[test]
fn schemas_carry_units() {
    let laws = contact_laws();
    let linear = laws
        .iter()
        .find(|l| l.name == "linear-elastic")
        .expect("it");
    assert_eq!((linear.schema)()["properties"]["modulus"]["unit"], "Pa");
    assert!(linear.source.contains("Catalano 2012"));
}

#[test]
fn wrong_names_and_parameters_are_refused() {
    let unknown = contact_law("linear", &json!({})).expect_err("unknown");
    assert!(unknown.to_string().contains("linear-elastic"), "{unknown}");
    let table = json!({ "modulus": 1e6, "stiffness_ratio": 0.5, "friction": 0.5, "colour": 1 });
    let extra = contact_law("linear-elastic", &table).expect_err("extra");
    assert!(extra.to_string().contains("colour"), "{extra}");
    let table = json!({ "modulus": -1e6, "stiffness_ratio": 0.5, "friction": 0.5 });
    let negative = contact_law("linear-elastic", &table).expect_err("negative");
    assert!(negative.to_string().contains("-1000000"), "{negative}");
}
