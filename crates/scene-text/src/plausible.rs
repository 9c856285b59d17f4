//! Plausible ranges of numbers of a scene: bounds by quantity, outside which a number is a mistake.
//!
//! A number outside the range of nature or a laboratory gets a remark; where no run can be right, it is refused.
//! A key has the quantity that its schema names (`"quantity" = "spacing"`), or else that of its unit. Signs do not
//! count, and zero is left to the range of the key. Bounds leave room for scenes without units.

use std::sync::LazyLock;

use crate::number::plain;

/// Bounds of one quantity; the second pair is that of nature, with its description.
#[derive(Clone, Copy, Debug)]
pub struct Quantity {
    /// Its name, as schemas and messages have it.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Smaller sizes are refused: no run can be right. 0 where none is too small.
    pub least: f64,
    /// Smaller ones are remarked upon, and the least that there is.
    pub low: (f64, &'static str),
    /// Larger ones are remarked upon, and the largest that there is.
    pub high: (f64, &'static str),
    /// Larger ones are refused.
    pub most: f64,
    /// Reason to refuse other numbers.
    pub refusal: &'static str,
}

/// The reason where the table has none: products of a step, such as ρδr³, ρc² and their squares, stay within 10^±308 if
/// every factor is within 10^±50.
const RANGE: &str = "powers and products of it would leave the range of numbers";

/// Every quantity with bounds. The first of a unit is that of keys which name none.
static QUANTITIES: LazyLock<Vec<Quantity>> = LazyLock::new(|| {
    let rows = include_str!("plausible.txt").lines();
    let rows = rows.filter(|row| !row.starts_with('#'));
    rows.filter_map(Quantity::from_row).collect()
});

/// The remark on a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing.
    Plausible,
    /// It is outside the range of nature.
    Odd(String),
    /// No run can be right with it.
    Impossible(String),
}

impl Quantity {
    /// The quantity of a row of the table.
    fn from_row(row: &'static str) -> Option<Quantity> {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let &[
            name,
            unit,
            least,
            low,
            smallest,
            high,
            largest,
            most,
            refusal,
        ] = &cells[..]
        else {
            return None;
        };
        let number = |cell: &str| cell.parse::<f64>().ok();
        Some(Quantity {
            name,
            unit,
            least: number(least)?,
            low: (number(low)?, smallest),
            high: (number(high)?, largest),
            most: number(most)?,
            refusal: if refusal.is_empty() { RANGE } else { refusal },
        })
    }

    /// The quantity of a key: the one that its schema names, or else the first of its unit.
    pub fn find(name: Option<&str>, unit: Option<&str>) -> Option<&'static Quantity> {
        let named = |n| QUANTITIES.iter().find(|q| q.name == n);
        let measured = |u: &str| QUANTITIES.iter().find(|q| !u.is_empty() && q.unit == u);
        name.and_then(named).or_else(|| measured(unit?))
    }

    /// Reason that no run can be right with a number of the quantity of a name, if there is one.
    pub fn refused(name: &str, x: f64) -> Option<String> {
        match Self::find(Some(name), None)?.judge(x) {
            Verdict::Impossible(why) => Some(why),
            _ => None,
        }
    }

    /// The remark on a number of this quantity.
    pub fn judge(&self, x: f64) -> Verdict {
        let size = x.abs();
        let with = |value: f64| match self.unit {
            "" => plain(value),
            unit => format!("{} {unit}", plain(value)),
        };
        if size == 0.0 {
            return Verdict::Plausible;
        }
        if size < self.least || size > self.most {
            let range = match (self.least > 0.0, self.most.is_finite()) {
                (true, true) => format!("{} to {}", plain(self.least), with(self.most)),
                (true, false) => format!("at least {}", with(self.least)),
                _ => format!("at most {}", with(self.most)),
            };
            return Verdict::Impossible(format!(
                "no run can be right with the {} {}: {}; expected {range}",
                self.name,
                with(x),
                self.refusal
            ));
        }
        let (beyond, (bound, source)) = match (size < self.low.0, size > self.high.0) {
            (true, _) => ("below", self.low),
            (_, true) => ("above", self.high),
            _ => return Verdict::Plausible,
        };
        Verdict::Odd(format!(
            "the {} of {} is {beyond} {}: {source}; is it meant?",
            self.name,
            with(x),
            with(bound)
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_has_ascending_bounds_a_source_and_room_for_scenes_without_units() {
        assert_eq!(QUANTITIES.len(), 20);
        for q in QUANTITIES.iter() {
            assert!(q.least <= q.low.0 && q.low.0 < q.high.0 && q.high.0.min(q.most) <= q.most);
            assert_eq!(q.low.0 > 0.0, !q.low.1.is_empty(), "{}", q.name);
            let open = q.high.0.is_infinite() || q.high.0 == q.most;
            assert_eq!(!open, !q.high.1.is_empty(), "{}", q.name);
            assert!(!q.refusal.is_empty());
            for x in [1.0, -1.0, 10.0] {
                // Numbers without a unit have no scale to be free of.
                let judged = q.unit.is_empty() || q.judge(x) == Verdict::Plausible;
                assert!(judged, "{} {x}", q.name);
            }
            assert_eq!(q.judge(0.0), Verdict::Plausible);
            assert_eq!(q.judge(q.low.0.max(q.least)), Verdict::Plausible);
        }
    }

    #[test]
    fn a_key_has_the_quantity_that_it_names_or_that_of_its_unit() {
        let name = |n, u| Quantity::find(n, u).map(|q| q.name);
        assert_eq!(name(None, Some("Pa")), Some("pressure or stress"));
        assert_eq!(name(Some("modulus"), Some("Pa")), Some("modulus"));
        assert_eq!(name(None, Some("1")), None);
        assert_eq!(name(None, None), None);
    }

    #[test]
    fn verdicts_tell_the_bound_with_its_source() {
        let density = Quantity::find(None, Some("kg/m³")).unwrap();
        assert_eq!(
            density.judge(1e12),
            Verdict::Odd(
                "the density of 1e12 kg/m³ is above 1e10 kg/m³: white dwarfs, 2e9 kg/m³ (Holberg et al. 1998); a clamp may be as heavy; is it meant?"
                    .into()
            )
        );
        assert_eq!(
            density.judge(1e308),
            Verdict::Impossible(
                "no run can be right with the density 1e308 kg/m³: powers and products of it would leave the \
                 range of numbers; expected 1e-50 to 1e50 kg/m³"
                    .into()
            )
        );
    }
}
