//! Waves that a body carries at the start, and level surfaces, plane or waves along x, that bound bodies.

use std::f64::consts::TAU;

use sph_core::parameters;

/// A wave on still water, with its velocities.
///
/// A solitary wave along x on water of depth h₀ over a flat bed, with ξ = x − x₀ (−ξ where it goes
/// backward), h = h₀ + Δh and y from the bed up:
///
/// Δh = H₀ sech²(kξ), k = √(3H₀/(4h₀³)), c = √(g(h₀ + H₀)),
/// u_x = ±c Δh/h, u_y = (y/h) ∂Δh/∂t = (y/h) 2kcΔh tanh(kξ).
///
/// It solves the equation of Korteweg and de Vries, not that of Navier and Stokes, and changes its
/// form a little on its way. In three dimensions z is up, and the wave is the same for all y. It needs
/// `pressure = "hydrostatic"`: the weight of the water up to the surface of the wave. A place is filled
/// if it is inside, with `[walls.usaw]` if it is half a spacing inside: draw `bottom` half a spacing up there.
///
/// Symbols: H₀ height (m), h₀ depth (m), x₀ crest (m), c celerity (m/s), k (1/m).
///
/// Source: Ghaïtanellis 2017, Eqs. 5.22–5.24.
#[parameters]
#[derive(Copy, PartialEq)]
pub struct Wave {
    /// Kind of the wave: `solitary`.
    pub kind: WaveKind,
    /// Height H₀ of the crest over the still water, m.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Depth h₀ of the still water, m.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Place x₀ of the crest along x, m.
    #[parameter(unit: "m")]
    pub crest: f64,
    /// Height of the bed along the last axis, m.
    #[parameter(default, unit: "m")]
    pub bottom: f64,
    /// Way of the wave along x.
    #[parameter(default)]
    pub direction: Heading,
}

/// Kinds of waves.
#[parameters]
pub enum WaveKind {
    /// One crest, sech².
    Solitary,
}

/// One of the two ways along x.
#[parameters]
pub enum Heading {
    /// Towards larger x.
    #[default]
    Forward,
    /// Towards smaller x.
    Backward,
}

impl Wave {
    /// k, 1/m.
    pub fn wave_number(&self) -> f64 {
        (0.75 * self.height / self.depth.powi(3)).sqrt()
    }

    /// c, m/s, under a gravity of so many m/s².
    pub fn celerity(&self, gravity: f64) -> f64 {
        (gravity * (self.depth + self.height)).sqrt()
    }

    /// Height of the still water, m.
    pub fn still(&self) -> f64 {
        self.bottom + self.depth
    }

    /// Δh at a place along x at the start, m.
    pub fn elevation(&self, x: f64) -> f64 {
        self.height / (self.wave_number() * (x - self.crest)).cosh().powi(2)
    }

    /// Velocity at the start, m/s, under a gravity of so many m/s².
    pub fn velocity<const D: usize>(&self, x: &[f64; D], gravity: f64) -> [f64; D] {
        let sign = match self.direction {
            Heading::Forward => 1.0,
            Heading::Backward => -1.0,
        };
        let (k, c) = (self.wave_number(), self.celerity(gravity));
        let raised = self.elevation(x[0]);
        let depth = self.depth + raised;
        let mut velocity = [0.0; D];
        velocity[0] = sign * c * raised / depth;
        let rising = 2.0 * k * c * raised * (sign * k * (x[0] - self.crest)).tanh();
        velocity[D - 1] = (x[D - 1] - self.bottom) / depth * rising;
        velocity
    }

    /// Distance of a point from the surface, m, positive above it.
    pub fn above<const D: usize>(&self, x: &[f64; D]) -> f64 {
        let surface = |x: f64| self.still() + self.elevation(x);
        let up = x[D - 1] - surface(x[0]);
        // Its curvature is 2 H k² at most: nearer than half its radius there is one nearest point, and Newton's
        // iteration finds it in a tenth of the time of a search.
        let k = self.wave_number();
        let curvature = 2.0 * self.height * k.powi(2);
        if up.abs() * curvature > 0.5 {
            return nearest(surface, up.abs(), x[0], x[D - 1]).copysign(up);
        }
        let (mut s, mut below) = (0.0, -up);
        for _ in 0..20 {
            let phase = k * (x[0] + s - self.crest);
            let raised = self.height / phase.cosh().powi(2);
            let share = raised / self.height;
            let slope = -2.0 * k * raised * phase.tanh();
            let bend = self.height * k * k * (4.0 - 6.0 * share) * share;
            below = self.still() + raised - x[D - 1];
            let change = (s + below * slope) / (1.0 + slope * slope + below * bend);
            s -= change;
            if change.abs() <= 1e-12 * self.depth {
                break;
            }
        }
        s.hypot(below).copysign(up)
    }
}

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
fn nearest(height: impl Fn(f64) -> f64, reach: f64, x: f64, y: f64) -> f64 {
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
mod tests {
    use super::*;

    /// Ghaïtanellis 2017, §5.4.3.
    fn tsunami() -> Wave {
        Wave {
            kind: WaveKind::Solitary,
            height: 0.1231,
            depth: 0.315,
            crest: -3.21,
            bottom: 0.2,
            direction: Heading::Forward,
        }
    }

    #[test]
    fn the_numbers_are_those_of_the_tsunami() {
        let wave = tsunami();
        let (k, c) = (wave.wave_number(), wave.celerity(9.81));
        assert!((k - 1.7187).abs() < 5e-5, "k = {k} 1/m");
        assert!((c - 2.0731).abs() < 5e-5, "c = {c} m/s");
        let [u, v] = wave.velocity(&[-3.21, 0.5], 9.81);
        assert!((u - 0.583).abs() < 1e-3 && v == 0.0, "crest at {u}, {v}");
    }

    #[test]
    fn velocities_are_those_of_the_elevation_that_travels() {
        for (direction, sign) in [(Heading::Forward, 1.0), (Heading::Backward, -1.0)] {
            let wave = Wave {
                direction,
                ..tsunami()
            };
            let c = wave.celerity(9.81);
            let step = 1e-6;
            for x in [-4.0, -3.3, -3.0, -2.0] {
                // ∂Δh/∂t at a place is Δh a little before it in the way of the wave, less that behind.
                let moved = |dt: f64| wave.elevation(x - sign * c * dt);
                let rising = (moved(step) - moved(-step)) / (2.0 * step);
                let depth = wave.depth + wave.elevation(x);
                let [u, v] = wave.velocity(&[x, 0.35], 9.81);
                let error = (v - 0.15 / depth * rising).abs();
                assert!(error < 1e-8, "u_y = {v} m/s at {x}: {error:e}");
                let flux = u * depth - sign * c * wave.elevation(x);
                assert!(flux.abs() < 1e-14, "flux {flux:e} m²/s at {x}");
                let [_, _, w] = wave.velocity(&[x, 7.0, 0.35], 9.81);
                assert_eq!(w, v, "the same in space");
            }
        }
    }

    #[test]
    fn distances_are_those_of_the_densely_sampled_surface() {
        let wave = tsunami();
        let height = |x: f64| wave.still() + wave.elevation(x);
        let beside = [(-3.21, 0.3), (-3.0, 0.6), (-2.5, 0.7), (-5.0, 0.21)];
        for (x, y) in beside.into_iter().chain([(-2.9, 0.4), (-3.7, 0.41)]) {
            let sampled = sampled(height, (x, y));
            let found = wave.above(&[x, y]);
            let error = (found.abs() - sampled).abs();
            assert!(error < 1e-8, "{x} {y}: {found} for {sampled}");
            assert_eq!(found > 0.0, y > height(x));
        }
    }

    /// Distance of the point (x, y) from the densely sampled line y = height(x), within 1 along x.
    fn sampled(height: impl Fn(f64) -> f64, (x, y): (f64, f64)) -> f64 {
        let all = (-100_000..100_000).map(|k| x + 1e-5 * f64::from(k));
        let away = all.map(|s| (s - x).hypot(height(s) - y));
        away.fold(f64::INFINITY, f64::min)
    }

    fn surface() -> LevelSurface {
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
            ..surface()
        };
        assert_eq!(plane.above(&[3.0, 0.75]), 0.25);
        assert_eq!(plane.above(&[3.0, 9.0, -0.5]), -1.0);
    }

    #[test]
    fn distances_to_a_wave_are_those_of_its_densely_sampled_line() {
        let wave = surface();
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
