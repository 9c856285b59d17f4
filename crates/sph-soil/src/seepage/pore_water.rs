//! The flow through the pores of a soil: its pressure, its flux, and what it carries across the surface.

use nalgebra::SMatrix;
use sph_contribution::{Report, StepHook, StepMoment, StepPhase};
use sph_core::{Access, Field, Scalar, StepError, Vect, fields};
use sph_multiphase::linear::{
    ConjugateGradient, Entries, LinearSolver, Matrix, ParticleMatrix, Pattern, Values,
};
use sph_neighbours::{Around, Neighbourhood, World, trusted_inverse, walk_some};

use crate::seepage::exchange::{Link, Net, places};
use crate::seepage::{Exchange, Phase, PoreResistance, SEEPAGE_PRESSURE, SEEPAGE_VELOCITY};

struct Columns<'a, const D: usize> {
    phase: &'a [u32],
    volume: &'a [f64],
    gamma: Option<&'a [f64]>,
    velocity: &'a [Vect<D>],
    earlier: &'a [Vect<D>],
    flux: &'a [Vect<D>],
    depth: &'a [f64],
    body: Vect<D>,
    dt: f64,
}

pub(crate) struct Seeps<const D: usize> {
    pub resistance: PoreResistance,
    pub phase: Phase,
    pub solver: ConjugateGradient<1>,
    pub exchange: Exchange,
    /// The scalar that the formulation integrates for the density.
    pub density: Field<Scalar>,
    /// Velocities before the kick.
    pub earlier: Vec<Vect<D>>,
}

impl<const D: usize> StepHook<D> for Seeps<D> {
    fn name(&self) -> String {
        "seepage".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both((fields::PRESSURE, fields::VOLUME, fields::PHASE))
            .both((fields::VELOCITY, fields::MASS))
            .here((SEEPAGE_VELOCITY, SEEPAGE_PRESSURE, fields::IDENTITY))
            .writes((fields::VELOCITY, fields::MASS, self.density))
            .remembers((SEEPAGE_VELOCITY, SEEPAGE_PRESSURE))
            // Links go by depths, which are sums over neighbours, and so do sizes that are evened out.
            .rings(2)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::BeforeKick, StepPhase::AfterKick]
    }
    /// Lets the water flow for the time of a kick, and hands mass and momentum over.
    fn run(&mut self, phase: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        if phase == StepPhase::AfterKick {
            return self.advance(moment.world, moment.dt);
        }
        let velocity = moment.world.free.get(fields::VELOCITY)?;
        self.earlier.clear();
        self.earlier.extend_from_slice(velocity);
        Ok(())
    }
    /// Warns where sizes beside the soil differ so much that the flux is too small.
    fn report(&self, world: &World<D>) -> Report {
        let uneven = Exchange::most_uneven(world, &self.phase).ok().flatten();
        match uneven.filter(|(_, size)| (size - 1.0).abs() > UNEVEN) {
            None => Report::default(),
            Some((_, size)) => Report::warning(format!(
                "seepage: a water particle beside the soil has {size:.2} of its size, and the flux is too small where \
                 sizes differ by more than {UNEVEN} (31 % with 0.07): the grains are too coarse for this spacing; take \
                 a finer one, or finer grains"
            )),
        }
    }
}

/// Differences in size up to which fluxes are right within 7 %.
const UNEVEN: f64 = 0.04;

impl<const D: usize> Seeps<D> {
    fn advance(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mut net = self.net(world, dt)?;
        let pressure = self.pressures(world, &net)?;
        let slot = places(net.particles.iter().copied(), world.free.len());
        for (links, p) in net.links.iter_mut().zip(&pressure) {
            for link in links {
                let drop = p - pressure[slot[link.to as usize] as usize];
                link.flux = link.conductance * (drop - link.drop);
            }
        }
        self.fluxes(world, &net, &slot, &pressure, dt)?;
        self.exchange.even_out(world, &self.phase, dt)?;
        self.exchange.hand_over(world, &self.phase, &net, dt)
    }

    /// All particles in the soil, and the water particles that have soil in reach.
    fn net(&self, world: &World<D>, dt: f64) -> Result<Net<D>, StepError> {
        let (phase, volume) = world.free.all((fields::PHASE, fields::VOLUME))?;
        let shares = |wanted: &(dyn Fn(usize) -> bool + Sync)| {
            walk_some(world, sph_neighbours::Values::Both, wanted, |around| {
                self.depth(phase, volume, world.kernel.value_at_zero(), around)
            })
        };
        let ground = shares(&|i| phase[i] == self.phase.soil)?;
        let mut touched = vec![false; phase.len()];
        for (_, water) in ground.iter().flatten() {
            water.iter().for_each(|&i| touched[i as usize] = true);
        }
        let beside = shares(&|i| touched[i])?;
        let both = ground.iter().zip(&beside);
        let depth: Vec<f64> = both
            .map(|(a, b)| a.as_ref().or(b.as_ref()).map_or(0.0, |found| found.0))
            .collect();
        let columns = Columns {
            phase,
            volume,
            gamma: world.free.get(fields::RENORMALISATION).ok(),
            velocity: world.free.get(fields::VELOCITY)?,
            earlier: &self.earlier,
            flux: world.free.get(SEEPAGE_VELOCITY)?,
            depth: &depth,
            body: world.gravity + world.driving,
            dt,
        };
        let takes_part = |i: usize| touched[i] || phase[i] == self.phase.soil;
        let gradient = sph_neighbours::Values::Gradient;
        let all = walk_some(world, gradient, takes_part, |around| {
            self.links(&columns, &around.rows)
        })?;
        let all = all.into_iter().enumerate();
        let (particles, links) = all
            .filter_map(|(i, links)| Some((i as u32, links?)))
            .unzip();
        Ok(Net { particles, links })
    }

    /// Excess over one half of the share of its own phase around a particle, which is its depth behind the surface
    /// between soil and water over some length; and the water within reach of soil.
    fn depth(
        &self,
        phase: &[u32],
        volume: &[f64],
        at_zero: f64,
        around: &Around<'_, D>,
    ) -> (f64, Vec<u32>) {
        let (i, mut water) = (around.rows.particle, Vec::new());
        let mut own = volume[i] * at_zero;
        let mut all = own;
        for (&j, w) in around.rows.free.index.iter().zip(around.free) {
            let k = j as usize;
            let part = volume[k] * w;
            if phase[k] == phase[i] {
                own += part;
                all += part;
            } else if phase[k] == self.phase.water || phase[k] == self.phase.soil {
                all += part;
            }
            if phase[k] == self.phase.water && phase[i] == self.phase.soil {
                water.push(j);
            }
        }
        ((own / all - 0.5).max(LEAST_DEPTH), water)
    }

    /// The links of a particle, sorted by neighbours. Both ends of a link find the same numbers, or their opposites.
    fn links(&self, columns: &Columns<'_, D>, rows: &Neighbourhood<'_, D>) -> Vec<Link<D>> {
        let (a, density) = (rows.particle, self.phase.density);
        let Columns { phase, volume, .. } = columns;
        let soil = |i: usize| phase[i] == self.phase.soil;
        let mobility = |i: usize| self.resistance.mobility(columns.flux[i].norm(), columns.dt);
        // What drives the water in the pores besides its pressure; water beside a soil goes with itself.
        let force = |i: usize| {
            let change = (columns.velocity[i] - columns.earlier[i]) / columns.dt;
            (columns.body - change) * density
        };
        let inertia = self.resistance.inertia / columns.dt;
        let gamma = |i: usize| columns.gamma.map_or(1.0, |g| g[i]);
        let mut links = Vec::new();
        for (k, &to) in rows.free.index.iter().enumerate() {
            let b = to as usize;
            let (both, either) = (soil(a) && soil(b), soil(a) || soil(b));
            let other = if soil(a) { b } else { a };
            if !either || !(both || phase[other] == self.phase.water) {
                continue;
            }
            let (mobility, within, history, weight) = match both {
                true => {
                    let (here, there) = (mobility(a), mobility(b));
                    let between = 2.0 * here * there / (here + there);
                    let history = (columns.flux[a] + columns.flux[b]) * 0.5;
                    (between, 1.0, history, (force(a) + force(b)) * 0.5)
                }
                // The rest of the way is free.
                false => {
                    let (ground, free) = if soil(a) { (a, b) } else { (b, a) };
                    let within =
                        columns.depth[ground] / (columns.depth[ground] + columns.depth[free]);
                    let weight = force(ground) * within + force(free) * (1.0 - within);
                    let history = columns.flux[ground] * within;
                    (mobility(ground), within, history, weight)
                }
            };
            let separation = rows.free.separation[k];
            let renormalised = -rows.free.factor[k] / (0.5 * (gamma(a) + gamma(b)));
            let weight = weight.dot(&separation);
            links.push(Link {
                to,
                conductance: 2.0 * mobility / within * (volume[a] * volume[b]) * renormalised,
                weight,
                drop: weight + inertia * history.dot(&separation),
                share: volume[b] * renormalised,
                separation,
                within,
                flux: 0.0,
            });
        }
        links.sort_unstable_by_key(|link| link.to);
        links
    }

    /// Pressures of the water for which the flux has no divergence in the soil, in the order of the net; those of water
    /// particles are given.
    fn pressures(&mut self, world: &mut World<D>, net: &Net<D>) -> Result<Vec<f64>, StepError> {
        let mut seeping = world.free.take(SEEPAGE_PRESSURE)?;
        let (phase, present) = world.free.all((fields::PHASE, fields::PRESSURE))?;
        let soil = |i: u32| phase[i as usize] == self.phase.soil;
        let grounds = net.particles.iter().copied().filter(|i| soil(*i));
        let row = places(grounds, phase.len());
        let space = world.space()?;
        let (mut pattern, mut values) = (Pattern::default(), Values::default());
        let mut places = Vec::new();
        pattern.starts.push(0);
        let (mut right, mut x) = (Vec::new(), Vec::new());
        for (&particle, links) in net.particles.iter().zip(&net.links) {
            if !soil(particle) {
                continue;
            }
            let all: f64 = links.iter().map(|l| l.conductance).sum();
            // Soil that no water touches may have any pressure: the one that it had.
            let faint = FAINT * all + f64::MIN_POSITIVE;
            let start = seeping[particle as usize];
            let mut source = faint * start;
            for link in links {
                source += link.conductance * link.drop;
                match soil(link.to) {
                    // Rows of copies are with their owners.
                    true if space.owned.has(particle as usize) => {
                        pattern.columns.push(row[link.to as usize]);
                        values.others.push(-link.conductance);
                    }
                    true => {}
                    false => source += link.conductance * present[link.to as usize],
                }
            }
            places.push(particle);
            values.diagonal.push(all + faint);
            pattern.starts.push(pattern.columns.len() as u32);
            right.push(Vect::<1>::from([source]));
            x.push(Vect::<1>::from([start]));
        }
        let matrix = Matrix::new(pattern, Entries::Scalar(values));
        let system = ParticleMatrix::new(&matrix, &space, Some(&places));
        let solved = self.solver.solve(&system, &right, &mut x);
        solved.map_err(|e| StepError::stage("seepage", e.to_string()))?;
        seeping.fill(0.0);
        for &i in &net.particles {
            seeping[i as usize] = match soil(i) {
                true => x[row[i as usize] as usize][0],
                false => present[i as usize],
            };
        }
        let found = net.particles.iter().map(|&i| seeping[i as usize]).collect();
        world.free.put(SEEPAGE_PRESSURE, seeping)?;
        Ok(found)
    }

    /// q' = (C/Δt q − ∇p + ρ_w(g − Du/Dt))/(C/Δt + a + b|q|), with the gradient that fits the links best.
    fn fluxes(
        &self,
        world: &mut World<D>,
        net: &Net<D>,
        slot: &[u32],
        pressure: &[f64],
        dt: f64,
    ) -> Result<(), StepError> {
        let mut flux = world.free.take(SEEPAGE_VELOCITY)?;
        let phase = world.free.get(fields::PHASE)?;
        for (k, (&particle, links)) in net.particles.iter().zip(&net.links).enumerate() {
            let i = particle as usize;
            if phase[i] != self.phase.soil {
                continue;
            }
            let mut moment = SMatrix::<f64, D, D>::zeros();
            let mut sum = Vect::<D>::zeros();
            for link in links {
                let there = pressure[slot[link.to as usize] as usize];
                let drive = pressure[k] - there - link.weight;
                sum -= link.separation * (link.share / link.within * drive);
                moment += link.separation * link.separation.transpose() * link.share;
            }
            let force = trusted_inverse(&moment).map_or(sum, |inverse| inverse * sum);
            let inertia = self.resistance.inertia / dt;
            let mobility = self.resistance.mobility(flux[i].norm(), dt);
            flux[i] = (flux[i] * inertia + force) * mobility;
        }
        Ok(world.free.put(SEEPAGE_VELOCITY, flux)?)
    }
}

/// Share of a row's conductances that keeps soil without water regular.
const FAINT: f64 = 1e-9;

/// Least depth behind the surface, as a share of the support: a particle on it has no way of its own.
const LEAST_DEPTH: f64 = 0.02;
