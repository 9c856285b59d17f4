//! Distance of a particle to a plane surface, from the part of its kernel beyond.

/// Distances d by the integral I(d) = ∫ w dA of the kernel over the plane, which is |Σ V ∇w| over the soil before it.
#[derive(Debug)]
pub(crate) struct SurfaceDistance {
    /// I, 1/m, at distances from 0 to the support radius; falling.
    integrals: Vec<f64>,
    /// m.
    radius: f64,
}

/// Places of the table.
const PLACES: usize = 256;
/// Points of an integral.
const POINTS: usize = 256;
/// Share of the support radius below which no particle is from its surface.
const LEAST: f64 = 0.05;

impl SurfaceDistance {
    /// Of a kernel w(r), 1/m^d, in D dimensions with a support radius, m.
    pub fn new<const D: usize>(radius: f64, kernel: &dyn Fn(f64) -> f64) -> Self {
        let integral = |d: f64| {
            let end = (radius * radius - d * d).max(0.0).sqrt();
            let step = end / POINTS as f64;
            let at = |k: usize| {
                let across = (k as f64 + 0.5) * step;
                let ring = match D {
                    2 => 2.0,
                    _ => std::f64::consts::TAU * across,
                };
                ring * kernel(across.hypot(d))
            };
            (0..POINTS).map(at).sum::<f64>() * step
        };
        let place = |k: usize| radius * k as f64 / (PLACES - 1) as f64;
        SurfaceDistance {
            integrals: (0..PLACES).map(|k| integral(place(k))).collect(),
            radius,
        }
    }

    /// d, m, of an integral, 1/m.
    pub fn at(&self, integral: f64) -> f64 {
        let k = self.integrals.partition_point(|i| *i > integral);
        let place = match k {
            0 => 0.0,
            PLACES => (PLACES - 1) as f64,
            _ => {
                let (above, below) = (self.integrals[k - 1], self.integrals[k]);
                (k - 1) as f64 + (above - integral) / (above - below)
            }
        };
        self.radius * (place / (PLACES - 1) as f64).max(LEAST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The half plane beyond, in cells of a sixteenth of a spacing, on both sides of a plane half a spacing away and more.
    #[test]
    fn distances_follow_from_the_missing_part_of_the_kernel() {
        let spacing = 0.01;
        let (h, cell) = (2.0 * spacing, spacing / 16.0);
        let strength = 7.0 / (4.0 * std::f64::consts::PI * h * h);
        // Wendland C2 in the plane, and −w'/r.
        let left = |r: f64| (1.0 - 0.5 * r / h).max(0.0);
        let kernel = |r: f64| strength * left(r).powi(4) * (1.0 + 2.0 * r / h);
        let slope = |r: f64| 5.0 * strength / (h * h) * left(r).powi(3);
        let table = SurfaceDistance::new::<2>(2.0 * h, &kernel);
        for row in 0..3 {
            let distance = (f64::from(row) + 0.5) * spacing;
            let mut missing = 0.0;
            for above in 0..96 {
                let y = distance + (f64::from(above) + 0.5) * cell;
                for across in -96..=96 {
                    let r = f64::hypot(f64::from(across) * cell, y);
                    missing += cell * cell * slope(r) * y;
                }
            }
            let found = table.at(missing);
            assert!(
                (found - distance).abs() < 1e-3 * spacing,
                "row {row}: {found}"
            );
        }
    }
}
