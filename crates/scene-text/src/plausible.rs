//! Plausible ranges of numbers of a scene: bounds by quantity, outside which a number is a mistake.
//!
//! A number outside the range of nature or a laboratory gets a remark; where no run can be right, it is refused.
//! A key has the quantity that its schema names (`"quantity" = "spacing"`), or else that of its unit. Signs do not
//! count, and zero is left to the range of the key. Bounds leave room for scenes without units.

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

/// Products of a step, such as ρδr³, ρc² and their squares, stay within 10^±308 if every factor is within this.
const RANGE: [f64; 2] = [1e-50, 1e50];
const RANGE_TEXT: &str = "powers and products of it would leave the range of numbers";

const fn signed(name: &'static str, unit: &'static str, high: (f64, &'static str)) -> Quantity {
    Quantity {
        name,
        unit,
        least: 0.0,
        low: (0.0, ""),
        high,
        most: RANGE[1],
        refusal: RANGE_TEXT,
    }
}

const fn positive(
    name: &'static str,
    unit: &'static str,
    low: (f64, &'static str),
    high: (f64, &'static str),
) -> Quantity {
    Quantity {
        least: RANGE[0],
        low,
        ..signed(name, unit, high)
    }
}

/// Every quantity with bounds. The first of a unit is that of keys which name none.
pub const QUANTITIES: [Quantity; 20] = [
    positive(
        "density",
        "kg/m³",
        (
            1e-4,
            "air 65 km up, 1.6e-4 kg/m³ (US Standard Atmosphere 1976)",
        ),
        (
            1e10,
            "white dwarfs, 2e9 kg/m³ (Holberg et al. 1998); a clamp may be as heavy",
        ),
    ),
    signed(
        "speed",
        "m/s",
        (1e5, "the fastest meteors, 72 km/s (Ceplecha et al. 1998)"),
    ),
    // Numerical speeds of sound are ten times those of the flow, and flows creep.
    positive(
        "speed of sound",
        "m/s",
        (
            1e-9,
            "the Earth's mantle creeps at 1e-9 m/s (Turcotte & Schubert 2014)",
        ),
        (
            4e4,
            "no solid or fluid has more than 36 km/s (Trachenko et al. 2020)",
        ),
    ),
    signed("length", "m", (4.1e7, "the Earth's circumference, 4.0e7 m")),
    positive(
        "spacing",
        "m",
        (
            1e-9,
            "below three molecules of water, 3e-10 m each, is no continuum",
        ),
        (4.1e7, "the Earth's circumference, 4.0e7 m"),
    ),
    signed(
        "time",
        "s",
        (4.4e17, "the age of the universe (Planck 2018)"),
    ),
    signed(
        "acceleration",
        "m/s²",
        (
            2e7,
            "the fastest centrifuges, a million times gravity (Svedberg & Pedersen 1940)",
        ),
    ),
    signed(
        "pressure or stress",
        "Pa",
        (
            1e13,
            "the highest static pressure of a laboratory, 1e12 Pa (Dubrovinskaia et al. 2016)",
        ),
    ),
    positive(
        "modulus",
        "Pa",
        (1e-3, "the softest gels, some 0.1 Pa"),
        (2e12, "diamond, 1.2e12 Pa (CRC Handbook)"),
    ),
    Quantity {
        low: (1e-7, "hydrogen at 20 K, 1e-6 Pa s (CRC Handbook)"),
        ..signed(
            "viscosity",
            "Pa s",
            (
                1e24,
                "the Earth's lower mantle, 1e23 Pa s (Mitrovica & Forte 2004)",
            ),
        )
    },
    signed(
        "kinematic viscosity",
        "m²/s",
        (
            1e21,
            "the Earth's mantle, 1e20 m²/s (Turcotte & Schubert 2014)",
        ),
    ),
    Quantity {
        low: (1e-10, "phases of colloids, some nN/m (Aarts et al. 2004)"),
        ..signed(
            "surface tension",
            "N/m",
            (1e3, "liquid rhenium, 2.7 N/m (Keene 1993)"),
        )
    },
    signed("permeability", "m²", (1e3, "gravel, 1e-7 m² (Bear 1972)")),
    signed(
        "strain rate",
        "1/s",
        (1e15, "the vibrations of molecules, 1e14 1/s"),
    ),
    Quantity {
        most: 1e15,
        refusal: "doubles of such a size are a tenth of a radian apart",
        ..signed("angle", "rad", (f64::INFINITY, ""))
    },
    signed(
        "angular velocity",
        "rad/s",
        (1e11, "beads spun by light, 3e10 rad/s (Ahn et al. 2020)"),
    ),
    // Values from the axis `smoothing-down` of the study of stability.
    Quantity {
        name: "smoothing ratio",
        unit: "",
        least: 0.472,
        low: (
            1.0,
            "velocities are 5 % wrong at 0.8 (docs/validation/stability.md)",
        ),
        high: (6.0, "particles smooth over more than they resolve"),
        most: 20.0,
        refusal: "even the widest kernel, 3 h, would reach the nearest neighbours along the axes only, √2 spacings",
    },
    Quantity {
        name: "kernel support over the spacing",
        unit: "",
        least: 1.414,
        low: (
            std::f64::consts::SQRT_2,
            "the neighbours across the squares of a lattice",
        ),
        high: (f64::INFINITY, ""),
        most: f64::INFINITY,
        refusal: "sums over the nearest neighbours along the axes alone feel no shear; take a larger `smoothing_ratio`",
    },
    Quantity {
        name: "distance over the spacing",
        unit: "",
        least: 0.0,
        low: (0.0, ""),
        high: (1e12, ""),
        most: 1e12,
        refusal: "positions there are rounded to more than a ten-thousandth of a spacing",
    },
    Quantity {
        name: "safety factor",
        unit: "",
        least: 1e-9,
        low: (1e-4, "ten thousand times the steps of a stable run"),
        high: (1.0, ""),
        most: 1.0,
        refusal: "the run would need a billion times the steps of a stable one",
    },
];

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
        for q in QUANTITIES {
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
