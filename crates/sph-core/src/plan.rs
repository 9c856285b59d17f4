//! From goals to an ordered list of stages: prune stages that are not needed, then sort.

use crate::field::AnyField;
use crate::{Access, Declares, PlanError};

/// The offered stages that run, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// Indices into the offered stages.
    pub order: Vec<usize>,
    /// Indices of the stages that were pruned.
    pub pruned: Vec<usize>,
}

/// Orders the stages that the goals need.
///
/// `sources` are columns that exist without a stage (the integrated state). A column that a stage reads where a scene has
/// it is written before, if a needed stage writes it; it makes no stage needed.
///
/// # Errors
/// If a needed field has no writer or two, or stages wait for each other.
pub fn plan(
    stages: &[&dyn Declares],
    goals: &[AnyField],
    sources: &[AnyField],
) -> Result<Plan, PlanError> {
    let access: Vec<_> = stages.iter().map(|s| s.access()).collect();
    let is_source = |f: &AnyField| sources.contains(f);
    let writer = |field: &AnyField, reader: &str| -> Result<usize, PlanError> {
        let found = (0..stages.len()).filter(|&s| access[s].writes.contains(field));
        let name = field.name;
        match found.collect::<Vec<_>>()[..] {
            [] => Err(PlanError(format!(
                "field `{name}`, needed by {reader}, is written by no stage of this scene"
            ))),
            [writer] => Ok(writer),
            [first, second, ..] => {
                let [first, second] = [first, second].map(|s| stages[s].name());
                Err(PlanError(format!(
                    "field `{name}` is written by both {first} and {second}: choose one of them"
                )))
            }
        }
    };

    let mut needed = vec![false; stages.len()];
    let mut open = Vec::new();
    for goal in goals.iter().filter(|g| !is_source(g)) {
        open.push(writer(goal, "the goals of the run")?);
    }
    while let Some(stage) = open.pop() {
        if std::mem::replace(&mut needed[stage], true) {
            continue;
        }
        for field in access[stage].reads().iter().filter(|f| !is_source(f)) {
            open.push(writer(field, &stages[stage].name())?);
        }
    }

    // Repeatedly take the first stage whose reads are all written: the order of offering
    // decides between equals, so the plan does not depend on anything else.
    let both = |a: &Access| [a.reads(), a.where_there.clone()].concat();
    let seen: Vec<Vec<AnyField>> = access.iter().map(both).collect();
    let mut done = vec![false; stages.len()];
    let mut order = Vec::new();
    loop {
        let ready = (0..stages.len()).find(|&s| {
            needed[s]
                && !done[s]
                && seen[s].iter().all(|f| {
                    (0..stages.len())
                        .all(|w| w == s || done[w] || !needed[w] || !access[w].writes.contains(f))
                })
        });
        let Some(stage) = ready else { break };
        done[stage] = true;
        order.push(stage);
    }
    let stuck = (0..stages.len()).filter(|&s| needed[s] && !done[s]);
    let stuck: Vec<_> = stuck.map(|s| stages[s].name()).collect();
    if !stuck.is_empty() {
        let stuck = stuck.join(", ");
        return Err(PlanError(format!(
            "the stages {stuck} wait for each other's fields"
        )));
    }
    let pruned = (0..stages.len()).filter(|&s| !needed[s]).collect();
    Ok(Plan { order, pruned })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Field, Scalar};

    const A: Field<Scalar> = Field::new("a", "1", "source");
    const B: Field<Scalar> = Field::new("b", "1", "from a");
    const C: Field<Scalar> = Field::new("c", "1", "from b");
    const X: Field<Scalar> = Field::new("x", "1", "no stage needs it");

    struct Work(&'static str, Access);
    impl Declares for Work {
        fn name(&self) -> String {
            self.0.to_string()
        }
        fn access(&self) -> Access {
            self.1.clone()
        }
    }

    #[test]
    fn orders_and_prunes() {
        let c = Work("c", Access::none().here(B).writes(C));
        let x = Work("x", Access::none().here(A).writes(X));
        let b = Work("b", Access::none().both(A).writes(B));
        let plan = plan(&[&c, &x, &b], &[C.any()], &[A.any()]).unwrap();
        assert_eq!(plan.order, [2, 0]);
        assert_eq!(plan.pruned, [1]);
    }

    #[test]
    fn a_column_that_may_be_there_is_written_first_and_needs_no_stage() {
        let c = Work("c", Access::none().where_there(B).writes(C));
        let b = Work("b", Access::none().here(A).writes(B));
        let order = |goals: &[AnyField]| plan(&[&c, &b], goals, &[A.any()]).unwrap().order;
        assert_eq!(order(&[C.any(), B.any()]), [1, 0]);
        assert_eq!(order(&[C.any()]), [0]);
    }

    #[test]
    fn names_what_is_missing_double_or_circular() {
        let c = Work("c", Access::none().here(B).writes(C));
        let told = |stages: &[&dyn Declares], sources: &[AnyField]| {
            plan(stages, &[C.any()], sources).unwrap_err().to_string()
        };
        assert!(told(&[&c], &[]).contains("`b`, needed by c"));
        let other = Work("other c", Access::none().writes(C));
        assert!(told(&[&c, &other], &[B.any()]).contains("written by both c and other c"));
        let b = Work("b", Access::none().here(C).writes(B));
        assert!(told(&[&c, &b], &[]).contains("wait for each other"));
    }
}
