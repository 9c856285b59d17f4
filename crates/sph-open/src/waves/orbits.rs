//! Velocities and pressures of the water below waves.

use crate::waves::superposition::Component;

/// Waves that run along x on a uniform current, at x = 0.
///
/// With ψ = ωt + φ, σ = ω − kU and z from the still level, to first order in the amplitudes
///
///   η = a cos ψ,   u = U + aσ cosh k(z + d)/sinh kd cos ψ,   w = −aσ sinh k(z + d)/sinh kd sin ψ,
///   p/ρ + gz = (σ/k)(u − U).
///
/// A single wave may be of second order (Stokes): it has besides
///
///   η₂ = ¼ a²k cosh kd (2 + cosh 2kd)/sinh³ kd cos 2ψ,   u₂ = ¾ a²kσ cosh 2k(z + d)/sinh⁴ kd cos 2ψ,
///   p₂/ρ = (σ/k) u₂ − ½ ((u₁ − U)² + w₁²) + a²σ²/(4 sinh² kd),
///
/// and w₂ accordingly. The current is the mean velocity below the troughs. Above the still level the first order is that of the
/// still level, the second straight on from there.
///
/// Source: Stokes 1847, as in Dean & Dalrymple 1991; on a current Peregrine 1976.
#[derive(Clone, Debug)]
pub(crate) struct Orbits {
    pub depth: f64,
    pub gravity: f64,
    pub current: f64,
    pub waves: Vec<Component>,
    /// True if the only wave is of second order.
    pub second: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Water {
    /// Horizontal velocity, the current with it, m/s.
    pub along: f64,
    /// Vertical velocity, m/s.
    pub up: f64,
    /// p/ρ, m²/s²; 0 above the surface.
    pub pressure: f64,
}

/// cosh and sinh of k(z + d) over sinh kd, below the still level; straight on above it.
pub(crate) fn depths(k: f64, z: f64, depth: f64) -> [f64; 2] {
    let below = z.min(0.0);
    let (near, far) = ((k * below).exp(), (-k * (below + 2.0 * depth)).exp());
    let over = 1.0 - (-2.0 * k * depth).exp();
    let [cosh, sinh] = [(near + far) / over, (near - far) / over];
    let more = k * z.max(0.0);
    [cosh + more * sinh, sinh + more * cosh]
}

impl Orbits {
    /// σ of a wave, rad/s.
    fn intrinsic(&self, wave: &Component) -> f64 {
        wave.frequency - wave.wavenumber * self.current
    }

    /// η of the waves of this share of their amplitudes, m.
    pub fn elevation(&self, time: f64, share: f64) -> f64 {
        let one = |w: &Component| {
            let psi = w.frequency * time + w.phase;
            let a = share * w.amplitude;
            let bound = match self.second {
                true => a * a * w.wavenumber * w.bound(self.depth) * (2.0 * psi).cos(),
                false => 0.0,
            };
            a * psi.cos() + bound
        };
        self.waves.iter().map(one).sum()
    }

    /// The water at a height over the still level, m, where the surface is at `elevation`; above it its velocity.
    pub fn at(&self, z: f64, elevation: f64, time: f64, share: f64) -> Water {
        let top = if self.second { elevation.max(0.0) } else { 0.0 };
        let water = self.extrapolated(z.min(top), time, share);
        let pressure = match z < elevation {
            // Above the still level the first order has the pressure of the still level, and the weight of the water
            // above.
            true => water.pressure + self.gravity * (z.min(top) - z),
            false => 0.0,
        };
        Water {
            pressure: pressure.max(0.0),
            ..water
        }
    }

    /// The same as if there were water at this height.
    fn extrapolated(&self, height: f64, time: f64, share: f64) -> Water {
        let (mut u, mut up, mut pushed) = (0.0, 0.0, 0.0);
        for w in &self.waves {
            let (sigma, k, a) = (self.intrinsic(w), w.wavenumber, share * w.amplitude);
            let (sine, cosine) = (w.frequency * time + w.phase).sin_cos();
            let [cosh, sinh] = depths(k, height, self.depth);
            let (along, rising) = (a * sigma * cosh * cosine, -a * sigma * sinh * sine);
            let (mut more, mut lift, mut pull) = (0.0, 0.0, 0.0);
            if self.second {
                let [cosh2, sinh2] = depths(2.0 * k, height, self.depth);
                // sinh 2x/sinh⁴ x = 2 coth x/sinh² x, and 1/sinh² x = coth² x − 1.
                let coth = 1.0 / (k * self.depth).tanh();
                let steep = coth * coth - 1.0;
                let size = 0.75 * a * a * k * sigma * 2.0 * coth * steep;
                more = size * cosh2 * (cosine * cosine - sine * sine);
                lift = -size * sinh2 * 2.0 * sine * cosine;
                pull = 0.25 * (a * sigma).powi(2) * steep - 0.5 * (along * along + rising * rising);
            }
            u += along + more;
            up += rising + lift;
            pushed += sigma / k * (along + more) + pull;
        }
        Water {
            along: self.current + u,
            up,
            pressure: pushed - self.gravity * height,
        }
    }

    /// The largest velocity, m/s: the current and that of all crests together.
    pub fn fastest(&self) -> f64 {
        let one = |w: &Component| {
            w.amplitude * self.intrinsic(w) * depths(w.wavenumber, 0.0, self.depth)[0]
        };
        self.current.abs() + self.waves.iter().map(one).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(
        [depth, current]: [f64; 2],
        [amplitude, frequency, wavenumber, phase]: [f64; 4],
    ) -> Orbits {
        Orbits {
            depth,
            gravity: 9.81,
            current,
            waves: vec![Component {
                amplitude,
                frequency,
                wavenumber,
                phase,
            }],
            second: true,
        }
    }

    /// One wave, its phase that of the place kx.
    fn orbits(amplitude: f64, kx: f64) -> Orbits {
        let k = crate::waves::wavenumber_on(5.2, 0.5, 9.81, 0.3).expect("a wave");
        wave([0.5, 0.3], [amplitude, 5.2, k, -kx])
    }

    /// Errors of p = 0 and of η_t + u η_x = w at the surface, over all phases.
    fn errors(amplitude: f64) -> [f64; 2] {
        let k = orbits(amplitude, 0.0).waves[0].wavenumber;
        let eta = |kx: f64, t: f64| orbits(amplitude, kx).elevation(t, 1.0);
        let mut worst = [0.0_f64; 2];
        for j in 0..40 {
            let kx = 0.157 * f64::from(j);
            let here = eta(kx, 0.2);
            let water = orbits(amplitude, kx).extrapolated(here, 0.2, 1.0);
            let step = 1e-5;
            let rises = (eta(kx, 0.2 + step) - eta(kx, 0.2 - step)) / (2.0 * step);
            let slope = k * (eta(kx + step, 0.2) - eta(kx - step, 0.2)) / (2.0 * step);
            worst[0] = worst[0].max(water.pressure.abs());
            worst[1] = worst[1].max((rises + water.along * slope - water.up).abs());
        }
        worst
    }

    /// Both conditions at the surface hold to second order: their errors are of third.
    #[test]
    fn the_surface_of_a_wave_of_second_order_has_errors_of_third() {
        let [a, b] = [0.02, 0.01].map(errors);
        for c in 0..2 {
            let order = (a[c] / b[c]).log2();
            assert!((order - 3.0).abs() < 0.2, "{order}: {a:?} {b:?}");
        }
    }

    /// In deep water waves of second order have no potential of twice the frequency, and the crest is ½ a²k higher.
    #[test]
    fn deep_water_has_the_crest_of_stokes() {
        let all = wave([50.0, 0.0], [0.1, 9.81_f64.sqrt(), 1.0, 0.0]);
        assert!((all.elevation(0.0, 1.0) - 0.105).abs() < 1e-12);
        let below = all.at(-1.0, 0.105, 0.0, 1.0);
        let linear = 0.1 * 9.81_f64.sqrt() * (-1.0_f64).exp();
        assert!((below.along - linear).abs() < 1e-12, "{below:?}");
    }
}
