//! A damped oscillator on which integrators are tried.

use sph_core::{Recall, StepError, StepLimit, System};

use crate::integrators::{Integrator, LeapFrog, PredictorCorrector, SymplecticEuler, Verlet};

/// ẋ = u, u̇ = −p − c u with the "pressure" p = x that an evaluation of the forces alone leaves as it was.
#[derive(Clone, Copy, Default)]
pub struct Trial {
    x: f64,
    u: f64,
    p: f64,
    a: f64,
    t: f64,
    spring: f64,
    damping: f64,
    kept: [f64; 4],
}

impl Trial {
    fn new(damping: f64) -> Self {
        Trial {
            x: 1.0,
            p: 1.0,
            spring: 1.0,
            damping,
            ..Trial::default()
        }
    }

    fn step(&mut self, scheme: &mut dyn Integrator, dt: f64) {
        self.evaluate().unwrap();
        scheme.step(self, dt).unwrap();
    }

    fn after(mut self, scheme: &mut dyn Integrator, dt: f64, steps: usize) -> Self {
        (0..steps).for_each(|_| self.step(scheme, dt));
        self
    }
}

/// Largest departure of the energy from 1/2 without damping.
fn worst_energy(scheme: &mut dyn Integrator, dt: f64, steps: usize) -> f64 {
    let mut system = Trial::new(0.0);
    let mut worst: f64 = 0.0;
    for _ in 0..steps {
        system.step(scheme, dt);
        worst = worst.max((0.5 * (system.x.powi(2) + system.u.powi(2)) - 0.5).abs());
    }
    worst
}

/// Observed order at t = 5 with a damping.
fn order(scheme: &mut dyn Integrator, damping: f64) -> f64 {
    let mut error = |steps: usize| {
        let end = Trial::new(damping).after(scheme, 5.0 / steps as f64, steps);
        let (decay, t) = (0.5 * damping, end.t);
        let omega = (1.0 - decay * decay).sqrt();
        let (sin, cos) = (omega * t).sin_cos();
        let x = (-decay * t).exp() * (cos + decay / omega * sin);
        let u = -(-decay * t).exp() * sin / omega;
        (end.x - x).hypot(end.u - u)
    };
    (error(400) / error(800)).log2()
}

/// Observed order of u = exp(−t) at t = 2.
fn friction_order(scheme: &mut dyn Integrator) -> f64 {
    let mut error = |steps: usize| {
        let start = Trial {
            u: 1.0,
            spring: 0.0,
            ..Trial::new(1.0)
        };
        let end = start.after(scheme, 2.0 / steps as f64, steps);
        (end.u - (-2.0f64).exp()).abs()
    };
    (error(400) / error(800)).log2()
}

/// Largest ωΔt without growth over a thousand steps, by bisection.
fn largest_step(scheme: &mut dyn Integrator) -> f64 {
    let (mut stable, mut unstable) = (0.1, 4.0);
    for _ in 0..20 {
        let dt = 0.5 * (stable + unstable);
        let end = Trial::new(0.0).after(scheme, dt, 1000);
        match end.x.hypot(end.u) < 1e3 {
            true => stable = dt,
            false => unstable = dt,
        }
    }
    stable
}

impl System for Trial {
    fn evaluate(&mut self) -> Result<(), StepError> {
        self.p = self.x;
        self.evaluate_forces()
    }
    fn evaluate_forces(&mut self) -> Result<(), StepError> {
        self.a = -self.spring * self.p - self.damping * self.u;
        Ok(())
    }
    fn keep(&mut self) -> Result<(), StepError> {
        self.kept = [self.x, self.u, self.t, self.a];
        Ok(())
    }
    fn recall(&mut self, what: Recall) -> Result<(), StepError> {
        let [x, u, t, _] = self.kept;
        if what == Recall::State {
            (self.x, self.t) = (x, t);
        }
        if what != Recall::Scalars {
            self.u = u;
        }
        Ok(())
    }
    fn average_rates(&mut self) -> Result<(), StepError> {
        self.a = 0.5 * (self.a + self.kept[3]);
        Ok(())
    }
    fn kick(&mut self, dt: f64) -> Result<(), StepError> {
        self.u += dt * self.a;
        Ok(())
    }
    fn drift(&mut self, dt: f64) -> Result<(), StepError> {
        self.x += dt * self.u;
        self.t += dt;
        Ok(())
    }
    fn time(&self) -> f64 {
        self.t
    }
    fn limits(&self) -> Vec<StepLimit> {
        Vec::new()
    }
}

#[test]
fn orders_stability_and_energy_are_as_stated() {
    // Orders without damping, of spring and damping together and of the velocity under damping alone; the largest stable
    // ωΔt; the bound of the error of the energy 1/2 over ten thousand steps of ωΔt = 0.1.
    let mut corrector = PredictorCorrector::default();
    let schemes: [(&mut dyn Integrator, [f64; 5]); 4] = [
        (&mut LeapFrog::default(), [2.0, 2.0, 2.0, 2.0, 2e-3]),
        (&mut corrector, [1.0, 1.0, 2.0, 2.0, 0.06]),
        (&mut SymplecticEuler::default(), [1.0, 1.0, 1.0, 2.0, 0.06]),
        (&mut Verlet::default(), [2.0, 2.0, 2.0, 2.0, 2e-3]),
    ];
    for (k, (scheme, stated)) in schemes.into_iter().enumerate() {
        let found = [
            order(scheme, 0.0),
            order(scheme, 0.5),
            friction_order(scheme),
            largest_step(scheme),
        ];
        for (n, within) in [0.02, 0.05, 0.02, 0.01].into_iter().enumerate() {
            let apart = (found[n] - stated[n]).abs();
            assert!(apart < within, "scheme {k}: {found:.3?}");
        }
        let worst = worst_energy(scheme, 0.1, 10_000);
        assert!(worst < stated[4], "scheme {k}: energy off by {worst:.2e}");
    }
}
