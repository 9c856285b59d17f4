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
        let mut found = (0..stages.len()).filter(|&s| access[s].writes.contains(field));
        let missing = || PlanError::NoWriter(field.name, reader.to_string());
        let first = found.next().ok_or_else(missing)?;
        match found
            .next()
            .map(|second| [first, second].map(|s| stages[s].name()))
        {
            None => Ok(first),
            Some([first, second]) => Err(PlanError::TwoWriters(field.name, first, second)),
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
        return Err(PlanError::Cycle(stuck.join(", ")));
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
        let missing = plan(&[&c], &[C.any()], &[]).unwrap_err();
        assert!(
            missing.to_string().contains("`b`, needed by c"),
            "{missing}"
        );
        let other = Work("other c", Access::none().writes(C));
        let double = plan(&[&c, &other], &[C.any()], &[B.any()]).unwrap_err();
        assert!(matches!(double, PlanError::TwoWriters("c", ..)));
        let b = Work("b", Access::none().here(C).writes(B));
        let cycle = plan(&[&c, &b], &[C.any()], &[]).unwrap_err();
        assert!(matches!(cycle, PlanError::Cycle(_)));
    }
}
