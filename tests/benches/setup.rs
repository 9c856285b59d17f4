//! What the benches share: particles in a periodic square, and the same terms and kernel twice,
//! once by name from the registries and once as types.

#![allow(
    dead_code,
    reason = "this is a module of several benches, each of which uses a part"
)]

use std::fmt::Debug;

use sph_core::SplitMix;
use sph_core::{Contract, Field, Registry, Role, Scalar, Vect, fields};
use sph_kernels::Sampler;
use sph_multiphase::diffusion::BrezziPitkaranta;
use sph_multiphase::viscosity::{
    Morris, Viscosity, ViscositySource, ViscousOperatorEntry, ViscousTerm,
};
use sph_multiphase::{FormulationEntry, PressureGradient, SquaredVolumes};
use sph_neighbours::{
    BoundTerm, ByPairs, Domain, KernelEntry, Lane, LanePair, Neighbourhood, PairSum, PairTerm,
    Particles, Rates, Terms, World, interactions, interactions_with, kernel_sums,
};
use sph_rheology::state::{EquationOfState, Laws, Linear, Reference};

/// Viscosity of the terms, Pa s.
const VISCOSITY: f64 = 1e-3;
/// Weight of the smoother.
const STRENGTH: f64 = 0.1;
/// Density at rest, kg/m³.
const DENSITY: f64 = 1000.0;
/// Smoothing length over spacing.
const RATIO: f64 = 2.0;
/// Displacement of the particles from the lattice, in spacings each way.
const JITTER: f64 = 0.2;

/// Makes this thread the only one of rayon, so that all work is timed and counted here.
pub fn one_thread() {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("nobody has built a pool before");
}

/// `side`² displaced particles in a periodic unit square, sorted, with fresh and pruned lists.
pub fn world(side: usize) -> World<2> {
    let spacing = 1.0 / side as f64;
    let mut numbers = Numbers(SplitMix(1));
    let count = side * side;
    let at = |k: usize, shift: f64| (k as f64 + 0.5 + JITTER * shift) * spacing;
    let position: Vec<Vect<2>> = (0..count)
        .map(|i| Vect::from([at(i % side, numbers.next()), at(i / side, numbers.next())]))
        .collect();
    let mut domain = Domain::open(Vect::zeros(), Vect::repeat(1.0));
    domain.periodic = [true; 2];
    let kernel = (found::<KernelEntry>("wendland-c2").build)(&Default::default());
    let mut world = World {
        free: sph_core::Store::new(count),
        walls: Default::default(),
        lists: Default::default(),
        domain,
        kernel: kernel.expect("no parameters").sampler(2, RATIO * spacing),
        spacing,
        skin: 0.1,
        gravity: Vect::from([0.0, -9.81]),
        steady_gravity: Vect::from([0.0, -9.81]),
        driving: Vect::zeros(),
        time: 0.0,
        dt: 1e-4,
        transported: Vec::new(),
        extent: None,
        communicator: None,
    };
    world.free.add(fields::POSITION, Role::State);
    world.free.add(fields::VELOCITY, Role::State);
    *column(world.free.get_mut(fields::POSITION)) = position;
    for u in column(world.free.get_mut(fields::VELOCITY)) {
        *u = Vect::from([numbers.next(), numbers.next()]);
    }
    let volume = spacing * spacing;
    fill(&mut world, fields::MASS, |_| DENSITY * volume);
    fill(&mut world, fields::DENSITY, |x| DENSITY * (1.0 + 0.01 * x));
    fill(&mut world, fields::VOLUME, |x| volume / (1.0 + 0.01 * x));
    fill(&mut world, fields::PRESSURE, |x| 1000.0 * x);
    world.rebuild_lists().expect("there are positions");
    kernel_sums(&mut world, &mut vec![0.0; count]).expect("there are positions");
    world
}

/// A column of a world made here.
fn column<T, E: Debug>(found: Result<T, E>) -> T {
    found.expect("the column was added")
}

/// Adds a column that varies with a number between −1 and 1.
fn fill(world: &mut World<2>, field: Field<Scalar>, value: impl Fn(f64) -> f64) {
    world.free.add(field, Role::Derived);
    let mut numbers = Numbers(SplitMix(7));
    for x in column(world.free.get_mut(field)) {
        *x = value(numbers.next());
    }
}

/// A plugin by its name, as a scene finds it.
fn found<E: Contract>(name: &str) -> &'static E {
    let registry = Registry::<E>::discovered().expect("no name is registered twice");
    registry.find(name).expect("it is built in")
}

/// True pairs within the support, counted from both ends.
pub fn pairs(world: &World<2>) -> usize {
    let mean = world.mean_neighbours().expect("there are positions");
    (mean * world.free.len() as f64).round() as usize
}

/// One phase, c = 20 m/s.
fn laws() -> Laws {
    let reference = Reference {
        density: 1000.0,
        sound_speed: 20.0,
    };
    vec![Linear::default().bind(reference)].into()
}

/// Pressure and viscosity, each from its registry, and the smoother.
pub fn terms_by_name() -> Terms<2> {
    let table = Default::default();
    let formulation = found::<FormulationEntry>("hu-adams").build::<2>(&table);
    let viscous = found::<ViscousOperatorEntry>("morris").build::<2>(&table);
    vec![
        column(formulation).pressure_term(),
        column(viscous).term(Viscosity::Uniform(VISCOSITY)),
        Box::new(BrezziPitkaranta::with(STRENGTH).term(&laws())),
    ]
}

/// Buffers of a sweep.
#[derive(Default)]
pub struct Sums {
    /// Accelerations, m/s².
    pub acceleration: Vec<Vect<2>>,
    /// Rates of the density constant, kg/m³/s.
    pub scalar: Vec<f64>,
}

impl Sums {
    /// Buffers for a world.
    pub fn new(world: &World<2>) -> Self {
        Sums {
            acceleration: vec![Vect::zeros(); world.free.len()],
            scalar: vec![0.0; world.free.len()],
        }
    }

    /// One sweep with kernel and terms behind their traits.
    pub fn by_name(&mut self, world: &World<2>, terms: &Terms<2>) {
        let (acceleration, scalar) = (&mut self.acceleration, &mut self.scalar);
        interactions(world, terms, acceleration, Some(scalar)).expect("all columns are there");
    }

    /// One sweep with kernel and terms as types.
    pub fn by_type(&mut self, world: &World<2>, kernel: &WendlandC2) {
        let smoother = BrezziPitkaranta::with(STRENGTH).term(&laws());
        let friction = ViscousTerm(Morris::default(), ViscositySource::Uniform(VISCOSITY));
        let bound = ByPairs(OneLoop(
            column(PairTerm::<2>::bind(
                &PressureGradient(SquaredVolumes),
                world,
            )),
            column(PairTerm::<2>::bind(&friction, world)),
            column(PairTerm::<2>::bind(&smoother, world)),
        ));
        let sums = sph_neighbours::Sums {
            acceleration: &mut self.acceleration,
            scalar: Some(&mut self.scalar),
            more: &mut [],
        };
        interactions_with(world, kernel, &bound, sums).expect("there are positions");
    }
}

/// Three terms as one: each pair is looked at once.
struct OneLoop<A, B, C>(A, B, C);

impl<const D: usize, A: PairSum<D>, B: PairSum<D>, C: PairSum<D>> PairSum<D> for OneLoop<A, B, C> {
    type Own<L: Lane> = (A::Own<L>, B::Own<L>, C::Own<L>);
    type Sum<L: Lane> = (A::Sum<L>, B::Sum<L>, C::Sum<L>);
    #[inline(always)]
    fn own<L: Lane>(&self, all: Particles) -> Self::Own<L> {
        (self.0.own(all), self.1.own(all), self.2.own(all))
    }
    #[inline(always)]
    fn pair<L: Lane>(
        &self,
        own: &Self::Own<L>,
        j: usize,
        pair: &LanePair<D, L>,
        sum: &mut Self::Sum<L>,
    ) {
        self.0.pair(&own.0, j, pair, &mut sum.0);
        self.1.pair(&own.1, j, pair, &mut sum.1);
        self.2.pair(&own.2, j, pair, &mut sum.2);
    }
}

impl<const D: usize, A, B, C> BoundTerm<D> for OneLoop<A, B, C>
where
    A: BoundTerm<D>,
    B: BoundTerm<D>,
    C: BoundTerm<D>,
{
    #[inline(always)]
    fn finish(&self, sum: Self::Sum<f64>, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        self.0.finish(sum.0, at, rates);
        self.1.finish(sum.1, at, rates);
        self.2.finish(sum.2, at, rates);
    }
}

/// Wendland C2 in two dimensions, written out: w = σ/h² (1 − q/2)⁴ (1 + 2q) and
/// F = −5σ/h⁴ (1 − q/2)³ with σ = 7/(4π).
#[derive(Clone, Copy, Debug)]
pub struct WendlandC2 {
    h: f64,
}

impl WendlandC2 {
    /// The kernel of a world made here.
    pub fn from_world(world: &World<2>) -> Self {
        let h = world.kernel.smoothing_length();
        WendlandC2 { h }
    }

    #[inline(always)]
    fn value_and_factor(&self, r2: f64) -> (f64, f64) {
        let q = (r2.sqrt() / self.h).min(2.0);
        let scale = 7.0 / (4.0 * std::f64::consts::PI) / (self.h * self.h);
        let left = 1.0 - 0.5 * q;
        let cube = left * left * left;
        let factor = -5.0 * scale / (self.h * self.h) * cube;
        (scale * cube * left * (1.0 + 2.0 * q), factor)
    }
}

impl Sampler for WendlandC2 {
    fn dimension(&self) -> usize {
        2
    }
    fn smoothing_length(&self) -> f64 {
        self.h
    }
    fn support_radius(&self) -> f64 {
        2.0 * self.h
    }
    fn value_at_zero(&self) -> f64 {
        self.value_and_factor(0.0).0
    }
    fn at(&self, r: f64) -> (f64, f64) {
        self.value_and_factor(r * r)
    }
    fn value(&self, r2: &[f64], w: &mut [f64]) {
        for (w, r2) in w.iter_mut().zip(r2) {
            *w = self.value_and_factor(*r2).0;
        }
    }
    #[inline(always)]
    fn gradient_factor(&self, r2: &[f64], factor: &mut [f64]) {
        for (factor, r2) in factor.iter_mut().zip(r2) {
            *factor = self.value_and_factor(*r2).1;
        }
    }
    fn both(&self, r2: &[f64], w: &mut [f64], factor: &mut [f64]) {
        for ((w, factor), r2) in w.iter_mut().zip(factor).zip(r2) {
            (*w, *factor) = self.value_and_factor(*r2);
        }
    }
}

/// Numbers between −1 and 1, the same in every run.
struct Numbers(SplitMix);

impl Numbers {
    fn next(&mut self) -> f64 {
        2.0 * self.0.unit() - 1.0
    }
}
