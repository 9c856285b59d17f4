//! Which columns guests are sent, and when.

use std::collections::BTreeSet;

use sph_core::Access;

/// What guests must be sent before a stage: the columns that it reads at neighbours and that have changed since they were last
/// sent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// Place of the stage among all.
    pub stage: usize,
    /// Names of the columns, ascending.
    pub columns: Vec<&'static str>,
}

/// What is sent in an evaluation, from what its stages touch in their order. Columns that are `constant` do not change while a
/// particle lives: they come with a guest once. All others are stale when an evaluation begins, and after a stage has written them.
pub fn exchanges(stages: &[Access], constant: &[&str]) -> Vec<Exchange> {
    let mut fresh: BTreeSet<&'static str> = BTreeSet::new();
    let mut all = Vec::new();
    for (stage, access) in stages.iter().enumerate() {
        let read = access.neighbours.iter().map(|f| f.name);
        let needed: BTreeSet<&'static str> = read
            .filter(|name| !fresh.contains(name) && !constant.contains(name))
            .collect();
        if !needed.is_empty() {
            fresh.extend(&needed);
            all.push(Exchange {
                stage,
                columns: needed.into_iter().collect(),
            });
        }
        access.writes.iter().for_each(|f| {
            fresh.remove(f.name);
        });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::fields::{DENSITY, MASS, PRESSURE, VELOCITY, VOLUME};

    #[test]
    fn a_column_is_sent_once_and_again_when_it_was_written() {
        let stages = [
            Access::none().both(VOLUME).neighbours(MASS).writes(DENSITY),
            Access::none().here(DENSITY).writes(PRESSURE),
            Access::none().both(PRESSURE).both(VOLUME).writes(VELOCITY),
            Access::none()
                .both(VELOCITY)
                .both(PRESSURE)
                .writes(PRESSURE),
            Access::none().both(PRESSURE),
        ];
        let sent = exchanges(&stages, &[MASS.name]);
        let told: Vec<_> = sent.iter().map(|e| (e.stage, e.columns.clone())).collect();
        let expected = vec![
            (0, vec![VOLUME.name]),
            (2, vec![PRESSURE.name]),
            (3, vec![VELOCITY.name]),
            (4, vec![PRESSURE.name]),
        ];
        assert_eq!(told, expected);
        assert_eq!(exchanges(&[], &[]), vec![]);
    }
}
