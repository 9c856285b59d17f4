//! A world of particles next to walls in either dimension, built through the registry as a solver would.

use sph_boundary::{
    Drawing, Polyline, RigidMotion, Wall, WallEntry, WallSetup, WallSpec, WallStates,
};
use sph_core::{Registry, Role, Store, Vect, fields};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, WallSet, World};

/// A wall treatment with its world; h = 2 δr with the Wendland C2 kernel.
pub struct Bench<const D: usize> {
    pub wall: Box<dyn Wall<D>>,
    pub world: World<D>,
}

/// A line that stands still and rubs.
pub fn fixed_line(polyline: Polyline) -> WallSpec<2> {
    WallSpec::at_rest(Drawing::Line(polyline))
}

/// A wall with a motion.
pub fn moving<const D: usize>(drawing: Drawing, motion: RigidMotion<D>) -> WallSpec<D> {
    WallSpec {
        motion,
        ..WallSpec::at_rest(drawing)
    }
}

/// The line of a wall.
pub fn line(spec: &WallSpec<2>) -> &Polyline {
    let Drawing::Line(line) = &spec.drawing else {
        unreachable!("walls here are lines")
    };
    line
}

/// A treatment by its name in scenes.
pub fn treatment<const D: usize>(name: &str) -> Box<dyn Wall<D>> {
    let registry = Registry::<WallEntry>::discovered().expect("a registry");
    let entry = registry.find(name).expect("a registered treatment");
    let built = entry.build::<D>(&toml::Table::new());
    built.expect("no parameters")
}

/// A box that nothing wraps.
pub fn wide<const D: usize>() -> Domain<D> {
    Domain::open(Vect::repeat(-100.0), Vect::repeat(100.0))
}

/// A box periodic in x with this period.
pub fn periodic_in_x(period: f64) -> Domain<2> {
    Domain {
        lower: Vect::<2>::new(0.0, -100.0),
        upper: Vect::<2>::new(period, 100.0),
        periodic: [true, false],
    }
}

/// The set-up of h/δr = 2 with the Wendland C2 kernel.
pub fn setup<'a, const D: usize>(
    walls: &'a [WallSpec<D>],
    spacing: f64,
    kernel: &'a dyn Kernel,
    domain: &'a Domain<D>,
) -> WallSetup<'a, D> {
    WallSetup {
        walls,
        spacing,
        smoothing_length: 2.0 * spacing,
        kernel,
        domain,
    }
}

impl<const D: usize> Bench<D> {
    /// Walls of a treatment around particles of density 1 kg/m³, lists and geometry fresh.
    pub fn new(
        name: &str,
        specs: &[WallSpec<D>],
        spacing: f64,
        domain: Domain<D>,
        positions: Vec<Vect<D>>,
    ) -> Self {
        let kernel = wendland_c2();
        let mut wall = treatment(name);
        let walls = wall.build(&setup(specs, spacing, &kernel, &domain));
        let walls: WallSet<D> = walls.expect("walls that are accepted");
        let mut free = Store::new(positions.len());
        free.add(fields::POSITION, Role::State);
        free.add(fields::VELOCITY, Role::State);
        for field in [fields::DENSITY, fields::VOLUME, fields::PRESSURE] {
            free.add(field, Role::State);
        }
        free.add(fields::RENORMALISATION, Role::Derived);
        free.add(fields::IDENTITY, Role::State);
        *free.get_mut(fields::IDENTITY).unwrap() = (0..positions.len() as u32).collect();
        *free.get_mut(fields::POSITION).unwrap() = positions;
        free.get_mut(fields::DENSITY).unwrap().fill(1.0);
        let whole = spacing.powi(D as i32);
        free.get_mut(fields::VOLUME).unwrap().fill(whole);
        let mut bench = Bench {
            wall,
            world: World {
                free,
                walls,
                lists: Default::default(),
                domain,
                kernel: kernel.sampler(D, 2.0 * spacing),
                spacing,
                skin: 0.1,
                gravity: Vect::zeros(),
                steady_gravity: Vect::zeros(),
                driving: Vect::zeros(),
                time: 0.0,
                dt: 0.0,
                transported: Vec::new(),
                extent: None,
                communicator: None,
            },
        };
        bench.refresh();
        bench
    }

    /// Lists and geometry at the present positions.
    pub fn refresh(&mut self) {
        self.world.refresh_lists().expect("positions");
        self.wall.geometry(&mut self.world).expect("geometry");
    }

    /// The walls at a time, geometry fresh.
    pub fn move_to(&mut self, time: f64) {
        self.world.time = time;
        let states = WallStates::default();
        let walls = &mut self.world.walls;
        self.wall.put_back(walls, &states, time).unwrap();
        self.refresh();
    }

    /// Positions of the particles, in the order of the store.
    pub fn positions(&self) -> &[Vect<D>] {
        self.world.free.get(fields::POSITION).unwrap()
    }

    /// γ of the particles.
    pub fn gamma(&self) -> &[f64] {
        self.world.free.get(fields::RENORMALISATION).unwrap()
    }

    /// Sets a scalar from the position.
    pub fn set(&mut self, field: sph_core::Field<sph_core::Scalar>, of: impl Fn(&Vect<D>) -> f64) {
        let values: Vec<f64> = self.positions().iter().map(of).collect();
        *self.world.free.get_mut(field).unwrap() = values;
    }

    /// ∇γ of a particle, 1/m.
    pub fn gradient(&self, particle: usize) -> Vect<D> {
        let contacts = self.world.walls.contacts.of_particle(particle);
        contacts.iter().map(|c| c.gradient).sum()
    }

    /// The particle nearest to a place.
    pub fn at(&self, place: Vect<D>) -> usize {
        let distance = |x: &Vect<D>| (x - place).norm();
        let all = self.positions().iter().enumerate();
        let nearest = all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
        nearest.expect("a particle").0
    }

    /// Shares of all wall points nearer than 10⁻⁹ m to a place.
    pub fn shares_at(&self, place: Vect<D>) -> Vec<f64> {
        let points = &self.world.walls.points;
        let all = points.position.iter().zip(&points.share);
        let here = all.filter(|(x, _)| (*x - place).norm() < 1e-9);
        here.map(|(_, share)| *share).collect()
    }
}

/// The largest differences of γ and of ∇γ between two benches with the same particles.
pub fn largest<const D: usize>(a: &Bench<D>, b: &Bench<D>) -> [f64; 2] {
    assert_eq!(a.positions(), b.positions());
    let pairs = a.gamma().iter().zip(b.gamma());
    let gamma = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let gradients = (0..a.positions().len()).map(|i| (a.gradient(i) - b.gradient(i)).norm());
    [gamma, gradients.fold(0.0, f64::max)]
}

/// Rows k = 1 … `rows` over a flat wall at y = 0 that is periodic in x; h = 1, δr = 1/2.
pub fn over_a_flat_wall(name: &str, rows: usize, offset: f64) -> Bench<2> {
    let floor = Polyline::open("floor", vec![[0.0, 0.0], [8.0, 0.0]]);
    let row = |k: usize| (0..16).map(move |i| [i as f64, k as f64]);
    let place = |[i, k]: [f64; 2]| Vect::<2>::new(0.5 * (i + offset), 0.5 * (k - offset));
    let positions = (1..=rows).flat_map(row).map(place).collect();
    let floor = [fixed_line(floor)];
    Bench::new(name, &floor, 0.5, periodic_in_x(8.0), positions)
}

/// Numbers in [0, 1) that are the same at every run.
pub struct Random(pub u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub fn point<const D: usize>(&mut self, low: f64, high: f64) -> Vect<D> {
        Vect::from_fn(|_, _| self.between(low, high))
    }

    /// A place in a box.
    pub fn within(&mut self, low: [f64; 3], high: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.between(low[k], high[k]))
    }
}
