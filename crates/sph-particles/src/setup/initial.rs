//! State of the particles at time zero.

use sph_core::Vect;
use sph_probes::Solution;
use sph_rheology::state::BoundState;
use sph_scene::{Body, Pressure, Region, Scene};

use crate::setup::layers::Layers;

/// Density and velocity of a body's particles at the start.
pub struct InitialState<'a, const D: usize> {
    body: &'a Body,
    law: &'a dyn BoundState,
    field: Option<&'a dyn Solution<D>>,
    /// The bodies whose weight is over it, if the scene gives no surface.
    layers: Option<&'a Layers<'a, D>>,
    gravity: Vect<D>,
    /// Height of the free surface along −gravity, m.
    surface: f64,
}

impl<'a, const D: usize> InitialState<'a, D> {
    /// The state of one body.
    pub fn new(
        scene: &Scene,
        body: &'a Body,
        region: &Region<D>,
        law: &'a dyn BoundState,
        field: Option<&'a dyn Solution<D>>,
        layers: Option<&'a Layers<'a, D>>,
    ) -> Self {
        let gravity = scene.gravity::<D>();
        let (lower, upper) = region.base.bounds();
        let highest = (0..D).map(|k| match gravity[k] > 0.0 {
            true => -gravity[k] * lower[k],
            false => -gravity[k] * upper[k],
        });
        let top = highest.sum::<f64>() / gravity.norm().max(f64::MIN_POSITIVE);
        InitialState {
            body,
            law,
            field,
            layers: layers.filter(|_| body.surface.is_none()),
            gravity,
            surface: body.surface.unwrap_or(top),
        }
    }

    /// Density, kg/m³, at a position.
    pub fn density(&self, x: &Vect<D>) -> f64 {
        let given = self.field.and_then(|f| f.pressure(x, 0.0));
        let pressure = given.unwrap_or_else(|| match self.body.pressure {
            Pressure::Zero => 0.0,
            Pressure::Hydrostatic if self.layers.is_some() => {
                self.layers.map_or(0.0, |layers| layers.weight(x))
            }
            Pressure::Hydrostatic => {
                let g = self.gravity.norm();
                let height = -self.gravity.dot(x) / g.max(f64::MIN_POSITIVE);
                self.law.reference().density * g * (self.surface - height).max(0.0)
            }
        });
        match (given, self.body.pressure) {
            (None, Pressure::Zero) => self.law.reference().density,
            // Given pressures count from that of the reference density.
            _ => self.law.density(pressure + self.background()),
        }
    }

    /// Pressure at the reference density, Pa.
    fn background(&self) -> f64 {
        let mut pressure = [0.0];
        self.law
            .pressure(&[self.law.reference().density], &mut pressure);
        pressure[0]
    }

    /// Velocity, m/s, at a position.
    pub fn velocity(&self, x: &Vect<D>) -> Vect<D> {
        let plain = || {
            self.body
                .velocity
                .as_ref()
                .map(|u| Vect::from_column_slice(u))
        };
        let wave = self.body.wave.as_ref();
        let wave = wave.map(|w| Vect::from(w.velocity(&(*x).into(), self.gravity.norm())));
        self.field
            .and_then(|f| f.velocity(x, 0.0))
            .or(wave)
            .or_else(plain)
            .unwrap_or_else(Vect::zeros)
    }
}
