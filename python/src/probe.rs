//! A probe by a function of Python: `kind = "python"`.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

use sph_core::{AnyField, StepError, plugin};
use sph_neighbours::World;
use sph_probes::{Needs, Probe, ProbeColumn, ProbeEntry};

use crate::columns::field_of;
use crate::functions::{call, known};

/// f(t, columns) at every row of the series, one number.
#[plugin(ProbeEntry [2, 3], "python", "a function of Python on whole columns", source: "given by the caller")]
struct PythonProbe {
    /// Name of the function.
    function: String,
    /// Columns that it is given.
    #[parameter(default: ["position", "velocity"].map(String::from).to_vec())]
    columns: Vec<String>,
    /// Unit of what it returns.
    #[parameter(default: "1")]
    unit: String,
}

/// Units are few, and columns keep theirs for good.
fn kept(unit: &str) -> &'static str {
    static UNITS: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut units = UNITS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = units.get(unit) {
        return known;
    }
    let unit: &'static str = String::from(unit).leak();
    units.insert(unit);
    unit
}

impl<const D: usize> Probe<D> for PythonProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only(kept(&self.unit))
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: self.columns.clone(),
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let failed = |reason: String| StepError::Stage {
            stage: "python probe".into(),
            reason,
        };
        let name = &self.function;
        if !known(name) {
            let why = format!("there is no function `{name}`: give it to sph.run(…, probes=…)");
            return Err(failed(why));
        }
        let field = |name: &String| {
            let found = field_of(&world.free, name);
            let there = found.filter(|f| world.free.has(f.name));
            there.ok_or_else(|| failed(format!("the scene has no column `{name}`")))
        };
        let fields: Result<Vec<AnyField>, _> = self.columns.iter().map(field).collect();
        call(name, world, &fields?, &[1], false)
    }
}
