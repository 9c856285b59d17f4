//! Level surfaces that are plane or waves along x, and the parts above and below them.

use std::f64::consts::TAU;

use sph_core::parameters;

/// A level surface: y = level + amplitude · cos(2π x/wavelength + phase), with z for y in three
/// dimensions.
#[parameters]
#[derive(PartialEq)]
pub struct LevelSurface {
    /// Mean height along the last axis, m.
    #[parameter(unit: "m")]
    pub level: f64,
    /// Amplitude of the wave, m; 0 for a plane.
    #[parameter(default, unit: "m")]
    pub amplitude: f64,
    /// Wavelength along x, m; needed where there is an amplitude.
    #[parameter(unit: "m", above: 0.0)]
    pub wavelength: Option<f64>,
    /// Phase of the wave, rad: 0 has a crest at x = 0.
    #[parameter(default, unit: "rad")]
    pub phase: f64,
}

/// Places tried on either side for the nearest point of a wave.
const TRIED: i32 = 8;

impl LevelSurface {
    /// Height of the surface, m.
    pub fn height(&self, x: f64) -> f64 {
        match self.wavelength {
            Some(length) if self.amplitude != 0.0 => {
                self.level + self.amplitude * (TAU * x / length + self.phase).cos()
            }
            _ => self.level,
        }
    }

    /// Distance of a point from the surface, m, positive above it.
    pub fn above<const D: usize>(&self, x: &[f64; D]) -> f64 {
        let up = x[D - 1] - self.height(x[0]);
        let Some(length) = self.wavelength.filter(|_| self.amplitude != 0.0) else {
            return up;
        };
        // The nearest point is nearer than the one below, and within half a wavelength.
        let reach = up.abs().min(0.5 * length);
        nearest(|s| self.height(s), reach, x[0], x[D - 1]).copysign(up)
    }
}

/// Distance of the point (x, y) from the line y = height(x), m, whose nearest point is within
/// `reach` along x.
pub(crate) fn nearest(height: impl Fn(f64) -> f64, reach: f64, x: f64, y: f64) -> f64 {
    let square = |s: f64| s * s + (y - height(x + s)).powi(2);
    let step = reach / f64::from(TRIED);
    let tried = (-TRIED..=TRIED).map(|k| f64::from(k) * step);
    let best = tried.min_by(|a, b| square(*a).total_cmp(&square(*b)));
    let (mut low, mut high) = best.map_or((0.0, 0.0), |s| (s - step, s + step));
    // A minimum between two places is narrowed down to a millionth of their distance.
    for _ in 0..40 {
        let third = (high - low) / 3.0;
        match square(low + third) < square(high - third) {
            true => high -= third,
            false => low += third,
        }
    }
    square(0.5 * (low + high)).sqrt()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Distance of the point (x, y) from the densely sampled line y = height(x), within 1 along x.
    pub(crate) fn sampled(height: impl Fn(f64) -> f64, (x, y): (f64, f64)) -> f64 {
        let all = (-100_000..100_000).map(|k| x + 1e-5 * f64::from(k));
        let away = all.map(|s| (s - x).hypot(height(s) - y));
        away.fold(f64::INFINITY, f64::min)
    }

    fn wave() -> LevelSurface {
        LevelSurface {
            level: 0.5,
            amplitude: 0.1,
            wavelength: Some(0.8),
            phase: 0.3,
        }
    }

    #[test]
    fn a_plane_has_its_height_as_distance() {
        let plane = LevelSurface {
            amplitude: 0.0,
            ..wave()
        };
        assert_eq!(plane.above(&[3.0, 0.75]), 0.25);
        assert_eq!(plane.above(&[3.0, 9.0, -0.5]), -1.0);
    }

    #[test]
    fn distances_to_a_wave_are_those_of_its_densely_sampled_line() {
        let wave = wave();
        let near = [(0.0, 0.9), (0.3, 0.42), (0.55, 0.3), (0.1, 0.55)];
        for (x, y) in near.into_iter().chain([(7.0, -2.0)]) {
            let sampled = sampled(|x| wave.height(x), (x, y));
            let found = wave.above(&[x, y]);
            let error = (found.abs() - sampled).abs();
            assert!(error < 1e-8, "{x} {y}: {found} {sampled}");
            assert_eq!(found > 0.0, y > wave.height(x));
            assert_eq!(found, wave.above(&[x, 55.0, y]), "the same in space");
        }
        assert_eq!(wave.above(&[0.2, wave.height(0.2)]), 0.0);
    }
}
