//! The weight of bodies that stand one over the other.

use sph_core::Vect;
use sph_scene::{Region, Scene, Shape};

/// Longest stride through the bodies next to their surfaces, in spacings.
const STRIDE: f64 = 1.0 / 16.0;
/// A place counts as inside of a body that is no farther away, in spacings.
const NEAR: f64 = 1e-9;

/// The bodies of a scene with their densities.
pub struct Layers<'a, const D: usize> {
    bodies: Vec<(&'a Region<D>, f64)>,
    up: Vect<D>,
    gravity: f64,
    /// Height of the highest body along `up`, m.
    top: f64,
    spacing: f64,
}

impl<'a, const D: usize> Layers<'a, D> {
    /// The bodies of a scene with gravity, if it has several or one below a level surface or a wave; the
    /// weight over a place in the only body is that up to its top.
    pub fn from_scene(scene: &Scene, regions: &'a [Region<D>]) -> Option<Self> {
        let gravity = scene.gravity::<D>();
        let up = -gravity.try_normalize(0.0)?;
        let ends = |c: &Shape<D>| matches!(c, Shape::Side { .. } | Shape::OverWave(_));
        let surface = |r: &Region<D>| r.cuts.iter().any(ends);
        if regions.len() < 2 && !regions.iter().any(surface) {
            return None;
        }
        let phases = scene.body.values().map(|b| &b.phase);
        let densities = phases.map(|p| scene.phase.get(p).map_or(0.0, |p| p.density));
        let top = |region: &Region<D>| -> f64 {
            let (lo, hi) = region.bounds();
            let farthest = |k: usize| up[k] * if up[k] > 0.0 { hi[k] } else { lo[k] };
            (0..D).map(farthest).sum()
        };
        Some(Layers {
            bodies: regions.iter().zip(densities).collect(),
            up,
            gravity: gravity.norm(),
            top: regions.iter().map(top).fold(f64::NEG_INFINITY, f64::max),
            spacing: scene.numerics.spacing,
        })
    }

    /// Σ_k ρ_k g × length of the vertical from `x` upward within body k, Pa.
    ///
    /// Gaps between bodies weigh nothing. The vertical is walked in strides that cannot leave the
    /// body they are in, and at least a sixteenth of a spacing long; where the body changes, the
    /// place is bisected.
    pub fn weight(&self, x: &Vect<D>) -> f64 {
        let length = self.top - self.up.dot(x);
        let stride = STRIDE * self.spacing;
        let (mut weight, mut at) = (0.0, 0.0);
        let mut here = self.look(x);
        while at < length {
            let next = (at + here.clear.max(stride)).min(length);
            let there = self.look(&(x + self.up * next));
            if there.body == here.body {
                weight += here.density * (next - at);
                (at, here) = (next, there);
                continue;
            }
            let (mut low, mut high, mut beyond) = (at, next, there);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let seen = self.look(&(x + self.up * middle));
                match seen.body == here.body {
                    true => low = middle,
                    false => (high, beyond) = (middle, seen),
                }
            }
            weight += here.density * (high - at);
            (at, here) = (high, beyond);
        }
        weight * self.gravity
    }

    /// The body a place is in.
    fn look(&self, x: &Vect<D>) -> LayerSample {
        let mut seen = LayerSample {
            body: None,
            density: 0.0,
            clear: f64::INFINITY,
        };
        let mut deepest = -NEAR * self.spacing;
        for (k, (region, density)) in self.bodies.iter().enumerate() {
            let depth = region.depth(&(*x).into());
            seen.clear = seen.clear.min(depth.abs());
            if depth > deepest {
                deepest = depth;
                (seen.body, seen.density) = (Some(k), *density);
            }
        }
        seen
    }
}

struct LayerSample {
    body: Option<usize>,
    density: f64,
    /// Distance to the nearest surface of any body, m.
    clear: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(bodies: &str) -> Scene {
        let text = format!(
            "title = \"t\"\ndimension = 2\nrun.end = 1\n\
             numerics = {{ spacing = 0.1, gravity = [0, -10] }}\n\
             phase.air = {{ density = 1, rheology.newtonian = {{ viscosity = 1 }} }}\n\
             phase.oil = {{ density = 800, rheology.newtonian = {{ viscosity = 1 }} }}\n\
             phase.water = {{ density = 1000, rheology.newtonian = {{ viscosity = 1 }} }}\n{bodies}"
        );
        let loaded = sph_scene::parse(&text, "t.toml", &[]);
        loaded.unwrap_or_else(|e| panic!("{e}")).scene
    }

    fn weight(bodies: &str, x: f64, y: f64) -> f64 {
        let scene = scene(bodies);
        let regions = scene.regions::<2>();
        let layers = Layers::from_scene(&scene, &regions).expect("layers");
        layers.weight(&Vect::from([x, y]))
    }

    #[test]
    fn layers_add_up_and_gaps_weigh_nothing() {
        let bodies = "body.a = { phase = \"water\", box = [[0, 0], [1, 0.4]] }\n\
                      body.b = { phase = \"oil\", box = [[0, 0.4], [1, 1]] }\n\
                      body.c = { phase = \"air\", box = [[0, 1.5], [0.5, 2]] }";
        for (x, y, exact) in [
            (0.75, 0.1, 3000.0 + 4800.0),
            (0.25, 0.1, 3000.0 + 4800.0 + 5.0),
            (0.0, 0.0, 4000.0 + 4800.0 + 5.0),
            (0.75, 0.4, 4800.0),
            (0.75, 1.2, 0.0),
            (0.25, 1.75, 2.5),
            (0.25, 3.0, 0.0),
        ] {
            let found = weight(bodies, x, y);
            let near = (found - exact).abs() < 1e-6 * (1.0 + exact);
            assert!(near, "{x} {y}: {found} {exact}");
        }
    }

    #[test]
    fn a_wave_and_a_drop_are_weighed_to_their_surfaces() {
        let wave = "level = 0.5, amplitude = 0.1, wavelength = 0.8, phase = 0.2";
        let bodies = format!(
            "body.a = {{ phase = \"water\", box = [[0, 0], [1, 1]], below = {{ {wave} }} }}\n\
             body.b = {{ phase = \"air\", box = [[0, 0], [1, 1]], above = {{ {wave} }}, \
             subtract = [{{ disc = {{ centre = [0.3, 0.8], radius = 0.1 }} }}] }}\n\
             body.d = {{ phase = \"oil\", disc = {{ centre = [0.3, 0.8], radius = 0.1 }} }}"
        );
        for x in [0.05, 0.25, 0.33, 0.7] {
            let height = 0.5 + 0.1 * (std::f64::consts::TAU * x / 0.8 + 0.2).cos();
            let chord = 2.0 * (0.01 - (x - 0.3_f64).powi(2)).max(0.0).sqrt();
            let exact = 1e4 * (height - 0.1) + 10.0 * (1.0 - height - chord) + 8e3 * chord;
            let found = weight(&bodies, x, 0.1);
            assert!((found / exact - 1.0).abs() < 1e-6, "{x}: {found} {exact}");
        }
    }

    #[test]
    fn one_plain_body_has_no_layers() {
        let plain = scene("body.a = { phase = \"water\", box = [[0, 0], [1, 1]] }");
        assert!(Layers::from_scene(&plain, &plain.regions::<2>()).is_none());
        let only =
            "body.a = { phase = \"water\", box = [[0, 0], [1, 1]], below = { level = 0.3 } }";
        assert!((weight(only, 0.5, 0.1) - 2000.0).abs() < 1e-6);
    }
}
