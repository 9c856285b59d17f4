//! A world of particles next to walls, built through the registry as a solver would.

use sph_boundary::{
    Drawing, Polyline, RigidMotion, Wall, WallCondition, WallEntry, WallSetup, WallSpec,
};
use sph_core::{Registry, Role, Store, Vect, fields};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, WallSet, World};

/// A wall treatment with its world.
pub struct Bench {
    pub wall: Box<dyn Wall<2>>,
    pub world: World<2>,
}

/// A wall that stands still and rubs.
pub fn fixed(polyline: Polyline) -> WallSpec<2> {
    WallSpec {
        drawing: Drawing::Line(polyline),
        condition: WallCondition::NoSlip,
        surface_velocity: Vect::zeros(),
        motion: RigidMotion::default(),
        mover: None,
        open: false,
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
pub fn treatment(name: &str) -> Box<dyn Wall<2>> {
    let registry = Registry::<WallEntry>::discovered().expect("a registry");
    let entry = registry.find(name).expect("a registered treatment");
    entry
        .build::<2>(&toml::Table::new())
        .expect("no parameters")
}

/// A box that nothing wraps.
pub fn wide() -> Domain<2> {
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
pub fn setup<'a>(
    walls: &'a [WallSpec<2>],
    spacing: f64,
    kernel: &'a dyn Kernel,
    domain: &'a Domain<2>,
) -> WallSetup<'a, 2> {
    WallSetup {
        walls,
        spacing,
        smoothing_length: 2.0 * spacing,
        kernel,
        domain,
    }
}

impl Bench {
    /// Walls of a treatment around particles of density 1 kg/m³, lists and geometry fresh.
    pub fn new(
        name: &str,
        specs: &[WallSpec<2>],
        spacing: f64,
        domain: Domain<2>,
        positions: Vec<Vect<2>>,
    ) -> Self {
        let kernel = wendland_c2();
        let mut wall = treatment(name);
        let walls = wall.build(&setup(specs, spacing, &kernel, &domain));
        let walls: WallSet<2> = walls.expect("walls that are accepted");
        let mut free = Store::new(positions.len());
        for field in [fields::POSITION, fields::VELOCITY] {
            free.add(field, Role::State);
        }
        for field in [fields::DENSITY, fields::VOLUME, fields::PRESSURE] {
            free.add(field, Role::State);
        }
        free.add(fields::RENORMALISATION, Role::Derived);
        *free.get_mut(fields::POSITION).unwrap() = positions;
        free.get_mut(fields::DENSITY).unwrap().fill(1.0);
        free.get_mut(fields::VOLUME)
            .unwrap()
            .fill(spacing * spacing);
        let mut bench = Bench {
            wall,
            world: World {
                free,
                walls,
                lists: Default::default(),
                domain,
                kernel: kernel.sampler(2, 2.0 * spacing),
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

    /// [`Bench::refresh`], and the marks follow their particles if those are sorted anew.
    pub fn refresh_sorting(&mut self, marks: &mut [bool]) {
        let before = self.positions().to_vec();
        self.refresh();
        if before != self.positions() {
            let mut order: Vec<usize> = (0..marks.len()).collect();
            let key = |x: &Vect<2>| (x[0].to_bits(), x[1].to_bits());
            order.sort_by_key(|&i| key(&before[i]));
            let old = marks.to_vec();
            for (i, x) in self.positions().iter().enumerate() {
                let found = order.binary_search_by_key(&key(x), |&k| key(&before[k]));
                marks[i] = old[order[found.expect("the same particles")]];
            }
        }
    }

    /// Positions of the particles, in the order of the store.
    pub fn positions(&self) -> &[Vect<2>] {
        self.world.free.get(fields::POSITION).unwrap()
    }

    /// γ of the particles.
    pub fn gamma(&self) -> &[f64] {
        self.world.free.get(fields::RENORMALISATION).unwrap()
    }

    /// The particle nearest to a place.
    pub fn at(&self, place: Vect<2>) -> usize {
        let distance = |x: &Vect<2>| (x - place).norm();
        let all = self.positions().iter().enumerate();
        let nearest = all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
        nearest.expect("a particle").0
    }

    /// Sets a scalar from the position.
    pub fn set(&mut self, field: sph_core::Field<sph_core::Scalar>, of: impl Fn(&Vect<2>) -> f64) {
        let values: Vec<f64> = self.positions().iter().map(of).collect();
        *self.world.free.get_mut(field).unwrap() = values;
    }
}

/// Rows k = 1 … `rows` over a flat wall at y = 0 that is periodic in x; h = 1, δr = 1/2.
pub fn over_a_flat_wall(name: &str, rows: usize, offset: f64) -> Bench {
    let floor = Polyline::open("floor", vec![[0.0, 0.0], [8.0, 0.0]]);
    let row = |k: usize| (0..16).map(move |i| [i as f64, k as f64]);
    let place = |[i, k]: [f64; 2]| Vect::<2>::new(0.5 * (i + offset), 0.5 * (k - offset));
    let positions = (1..=rows).flat_map(row).map(place).collect();
    Bench::new(name, &[fixed(floor)], 0.5, periodic_in_x(8.0), positions)
}

/// Numbers in [0, 1) that are the same at every run.
pub struct Random(u64);

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
}
