//! The system of the effective pressure: who is in it, and what couples them.

use sph_core::Vect;
use sph_implicit::Rows;
use sph_neighbours::Cluster;

/// What a particle is to the problem.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Part {
    /// No soil.
    Outside,
    /// Soil with the given Δρ, kg/m³, whose pressure is known, Pa.
    Surface(f64, f64),
    /// Soil with the given Δρ, kg/m³.
    Inside(f64),
}

impl Part {
    /// The pressure that is not solved for, Pa.
    /// Soil with a Δρ, at its surface or not; `top` over Δρ is the pressure there, m²/s².
    pub fn of(density: Option<f64>, surface: bool, top: f64) -> Self {
        match density {
            None => Part::Outside,
            Some(density) if surface => Part::Surface(density, top * density),
            Some(density) => Part::Inside(density),
        }
    }

    fn known(self) -> f64 {
        match self {
            Part::Surface(_, pressure) => pressure,
            _ => 0.0,
        }
    }

    /// Δρ where the pressure is solved for, kg/m³.
    fn inside(self) -> Option<f64> {
        match self {
            Part::Inside(density) => Some(density),
            _ => None,
        }
    }
}

/// What couples the pressures.
pub(crate) struct Couplings<'a, const D: usize> {
    /// Which rows are one's own, where some are not.
    pub own: Option<&'a [bool]>,
    /// What every particle is.
    pub parts: &'a [Part],
    /// Of every particle, m^d.
    pub volume: &'a [f64],
    /// m/s².
    pub gravity: Vect<D>,
}

impl<const D: usize> Couplings<'_, D> {
    /// Adds the rows of a cluster.
    pub fn add(&self, cluster: &mut Cluster<'_, D>, rows: &mut Rows<f64, 1>) {
        let all = cluster.candidates();
        for (lane, i) in cluster.members().enumerate() {
            // Rows of copies are with their owners.
            let own = self.own.is_none_or(|own| own[i]);
            let Some(buoyant) = self.parts[i].inside().filter(|_| own) else {
                rows.begin(0);
                rows.end(1.0, Vect::from([self.parts[i].known()]));
                continue;
            };
            rows.begin(all.len());
            let (mut held, mut source) = (0.0, 0.0);
            let factors = cluster.factor().iter().skip(lane).step_by(cluster.lanes());
            for (&column, factor) in all.iter().zip(factors) {
                let j = column as usize;
                let coupling = -self.volume[i] * self.volume[j] * factor;
                if coupling == 0.0 {
                    continue;
                }
                let density = match self.parts[j] {
                    Part::Inside(density) => {
                        rows.couple(column, &coupling, true);
                        density
                    }
                    Part::Surface(density, pressure) => {
                        held += coupling;
                        source += coupling * pressure;
                        density
                    }
                    Part::Outside => continue,
                };
                let mean = 0.5 * (buoyant + density);
                source += coupling * mean * self.gravity.dot(&cluster.separation(i, j));
            }
            // Soil that fills a closed box has no surface: the level is then that of zero.
            let own = held + FAINT * rows.sum() + f64::MIN_POSITIVE;
            rows.end(own, Vect::from([source]));
        }
    }
}

/// Share of a row's couplings that keeps a system without a surface regular.
const FAINT: f64 = 1e-9;

/// Where an iteration starts: the pressure before, or what is known, Pa.
pub(crate) fn start(pressure: f64, part: &Part) -> Vect<1> {
    Vect::from([match part {
        Part::Inside(_) => pressure,
        _ => part.known(),
    }])
}
