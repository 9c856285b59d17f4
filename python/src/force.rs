//! A body force by functions of Python: `[body-force.python]`.

use sph_contribution::{Contribution, Offer, Refusal, Setting, contribution_kind};
use sph_core::{
    Access, AnyField, Declares, Field, Stage, StepError, Vect, Vector, plugin, suggestion,
};
use sph_neighbours::{Interaction, Neighbourhood, Rates, RowTerm, WithTerm, World};

use crate::columns::field_of;
use crate::functions::{call, known};

contribution_kind!(
    /// What pushes particles from outside.
    pub BodyForceEntry, "body-force", Any, "accelerations that come from outside"
);

const PUSH: Field<Vector> = Field::new(
    "python_acceleration",
    "m/s²",
    "sum of the accelerations by functions of Python",
);

/// du/dt = … + Σ f(t, columns) with functions of Python on whole columns.
#[plugin(BodyForceEntry [2, 3], "python", "functions of Python on whole columns", source: "given by the caller")]
struct PythonForce {
    /// Names of the functions; each returns accelerations, one row per particle.
    functions: Vec<String>,
    /// Columns that they are given.
    #[parameter(default: ["position", "velocity"].map(String::from).to_vec())]
    columns: Vec<String>,
}

impl PythonForce {
    fn fields<const D: usize>(&self, world: &World<D>) -> Vec<AnyField> {
        let found = self.columns.iter().map(|name| field_of(&world.free, name));
        found.flatten().collect()
    }
}

impl<const D: usize> Contribution<D> for PythonForce {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let refuse = |key: &str, why: String| {
            Err(Refusal {
                kind: "body-force",
                key: key.into(),
                why,
            })
        };
        if let Some(name) = self.functions.iter().find(|name| !known(name)) {
            let why = format!("there is no function `{name}`: give it to sph.run(…, forces=…)");
            return refuse("functions", why);
        }
        let store = &setting.world.free;
        let missing = |name: &&String| field_of(store, name).is_none();
        if let Some(name) = self.columns.iter().find(missing) {
            let near = suggestion(name, store.fields().map(|f| f.name));
            return refuse("columns", format!("there is no column `{name}`{near}"));
        }
        offer.stage(Pushing {
            functions: self.functions.clone(),
            fields: self.fields(setting.world),
        });
        offer.term(Push);
        Ok(())
    }
}

/// Calls the functions and adds up what they return.
struct Pushing {
    functions: Vec<String>,
    fields: Vec<AnyField>,
}

impl Declares for Pushing {
    fn name(&self) -> String {
        format!("python force: {}", self.functions.join(", "))
    }
    fn access(&self) -> Access {
        let access = Access {
            here: self.fields.clone(),
            ..Access::none()
        };
        access.writes(PUSH)
    }
}

impl<const D: usize> Stage<World<D>> for Pushing {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let count = world.free.len();
        let mut sum = vec![Vect::<D>::zeros(); count];
        for name in &self.functions {
            let pushed = call(name, world, &self.fields, &[count, D], true)?;
            let rows = sum.iter_mut().zip(pushed.chunks_exact(D));
            rows.for_each(|(sum, row)| *sum += Vect::<D>::from_column_slice(row));
        }
        Ok(world.free.put(PUSH, sum)?)
    }
}

/// The sum in the sweep.
struct Push;

struct BoundPush<'a, const D: usize>(&'a [Vect<D>]);

impl<const D: usize> RowTerm<D> for BoundPush<'_, D> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.acceleration += self.0[at.particle];
    }
}

impl<const D: usize> Interaction<D> for Push {
    fn name(&self) -> String {
        "python force".into()
    }
    fn access(&self) -> Access {
        Access::none().here(PUSH)
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&BoundPush(world.free.get(PUSH)?))
    }
}
