//! Columns that ghosts get, and when.

use sph_core::{Access, AnyField};

/// Columns that ghosts get after a stage: those that it has summed over neighbours. Ghosts compute all others
/// themselves.
#[derive(Clone, Debug, PartialEq)]
pub struct Exchange {
    /// Place of the stage among all.
    pub stage: usize,
    /// The columns.
    pub columns: Vec<AnyField>,
}

/// Messages of an evaluation, from the columns that its stages touch.
pub fn exchanges(stages: &[Access]) -> Vec<Exchange> {
    let sums = stages.iter().enumerate().filter(|(_, access)| access.sweep);
    let told = sums.map(|(stage, access)| Exchange {
        stage,
        columns: access.writes.clone(),
    });
    told.filter(|exchange| !exchange.columns.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::fields::{ACCELERATION, DENSITY, MASS, POSITION, PRESSURE, VOLUME};

    #[test]
    fn only_sums_over_neighbours_are_sent_to_ghosts() {
        let stages = [
            Access::none()
                .both(POSITION)
                .neighbours(MASS)
                .writes(DENSITY),
            Access::none().here(DENSITY).writes(PRESSURE).writes(VOLUME),
            Access::none()
                .both(PRESSURE)
                .both(VOLUME)
                .writes(ACCELERATION),
            Access::none().both(PRESSURE),
        ];
        let told: Vec<_> = exchanges(&stages)
            .into_iter()
            .map(|e| (e.stage, e.columns))
            .collect();
        let expected = vec![(0, vec![DENSITY.any()]), (2, vec![ACCELERATION.any()])];
        assert_eq!(told, expected);
        assert_eq!(exchanges(&[]), vec![]);
    }
}
