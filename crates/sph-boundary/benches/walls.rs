//! Cost of the walls per particle next to them, on one thread: what a step does and the search that
//! new lists cost.
//!
//! Items are particles with a wall within the support.

use std::f64::consts::TAU;
use std::fmt::{self, Display};

use divan::{Bencher, counter::ItemsCount};
use rayon::{ThreadPool, ThreadPoolBuilder};
use sph_boundary::{Drawing, Polyline, Surface, Wall, WallEntry, WallSetup, WallSpec};
use sph_core::{Registry, Role, Store, Vect, fields};
use sph_kernels::{Kernel, wendland_c2};
use sph_neighbours::{Domain, World};

/// Particles along the edge of the box, across the pipe.
const ACROSS: usize = 24;
/// Facets of the pipe.
const FACETS: usize = 72;

/// Kind of wall, treatment and h over the spacing.
#[derive(Clone, Copy)]
struct Case(&'static str, &'static str, f64);

impl Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Case(shape, treatment, smoothing) = self;
        write!(f, "{shape}, {treatment}, h = {smoothing} δr")
    }
}

const FLAT: [Case; 3] = [
    Case("square", "usaw", 2.0),
    Case("square", "usaw", 1.5),
    Case("square", "dummy-particles", 2.0),
];
const SPATIAL: [Case; 5] = [
    Case("box", "usaw", 2.0),
    Case("box", "usaw", 1.5),
    Case("pipe", "usaw", 2.0),
    Case("pipe", "usaw", 1.5),
    Case("box", "dummy-particles", 2.0),
];

fn main() {
    divan::main();
}

/// γ, ∇γ and shares at new positions, the lists standing.
#[divan::bench(args = FLAT)]
fn geometry_2d(bencher: Bencher, case: Case) {
    geometry::<2>(bencher, case, false);
}

/// γ, ∇γ and shares at new positions, the lists standing.
#[divan::bench(args = SPATIAL)]
fn geometry_3d(bencher: Bencher, case: Case) {
    geometry::<3>(bencher, case, false);
}

/// The same with the search for the elements near each particle.
#[divan::bench(args = [FLAT[0]])]
fn search_2d(bencher: Bencher, case: Case) {
    geometry::<2>(bencher, case, true);
}

/// The same with the search for the elements near each particle.
#[divan::bench(args = [SPATIAL[0], SPATIAL[2]])]
fn search_3d(bencher: Bencher, case: Case) {
    geometry::<3>(bencher, case, true);
}

/// Pressures and volumes at the walls.
#[divan::bench(args = FLAT)]
fn state_2d(bencher: Bencher, case: Case) {
    state::<2>(bencher, case);
}

/// Pressures and volumes at the walls.
#[divan::bench(args = SPATIAL)]
fn state_3d(bencher: Bencher, case: Case) {
    state::<3>(bencher, case);
}

fn geometry<const D: usize>(bencher: Bencher, case: Case, search: bool) {
    let mut flow = Flow::<D>::new(case);
    let count = ItemsCount::new(flow.near(case));
    let mut step = 1e-4 * flow.world.spacing;
    bencher.counter(count).bench_local(|| {
        step = -step;
        let mut position = flow.world.free.take(fields::POSITION).expect("positions");
        position.iter_mut().for_each(|x| x[0] += step);
        flow.world
            .free
            .put(fields::POSITION, position)
            .expect("positions");
        // As if the neighbour lists were new.
        flow.world.lists.builds += u64::from(search);
        let geometry = || flow.wall.geometry(&mut flow.world);
        flow.pool.install(geometry).expect("geometry");
    });
}

fn state<const D: usize>(bencher: Bencher, case: Case) {
    let mut flow = Flow::<D>::new(case);
    let count = ItemsCount::new(flow.near(case));
    bencher.counter(count).bench_local(|| {
        let state = || flow.wall.state(&mut flow.world);
        flow.pool.install(state).expect("state");
    });
}

/// Particles in a wall.
struct Flow<const D: usize> {
    wall: Box<dyn Wall<D>>,
    world: World<D>,
    pool: ThreadPool,
}

impl<const D: usize> Flow<D> {
    fn new(Case(shape, treatment, smoothing): Case) -> Self {
        let spacing = 1.0 / ACROSS as f64;
        let h = smoothing * spacing;
        let kernel = wendland_c2();
        let registry = Registry::<WallEntry>::discovered().expect("a registry");
        let entry = registry.find(treatment).expect("a registered treatment");
        let mut wall = entry
            .build::<D>(&toml::Table::new())
            .expect("no parameters");
        let domain = Domain::open(Vect::repeat(-2.0), Vect::repeat(3.0));
        let spec = WallSpec::at_rest(drawing(shape));
        let setup = WallSetup {
            walls: &[spec],
            spacing,
            smoothing_length: h,
            kernel: &kernel,
            domain: &domain,
        };
        let walls = wall.build(&setup).expect("walls that are accepted");
        let positions = positions::<D>(shape == "pipe", spacing);
        let mut free = Store::new(positions.len());
        for field in [fields::POSITION, fields::VELOCITY] {
            free.add(field, Role::State);
        }
        for field in [fields::DENSITY, fields::VOLUME, fields::PRESSURE] {
            free.add(field, Role::State);
        }
        free.add(fields::RENORMALISATION, Role::Derived);
        free.put(fields::POSITION, positions).expect("as many");
        let put = |free: &mut Store<D>, field, value| {
            free.get_mut(field).expect("the field").fill(value);
        };
        put(&mut free, fields::DENSITY, 1.0);
        put(&mut free, fields::VOLUME, spacing.powi(D as i32));
        let mut world = World {
            free,
            walls,
            lists: Default::default(),
            domain,
            kernel: kernel.sampler(D, h),
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
        };
        world.refresh_lists().expect("positions");
        wall.geometry(&mut world).expect("geometry");
        let pool = ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.expect("a thread");
        Self { wall, world, pool }
    }

    /// Particles with a wall within the support.
    fn near(&self, Case(shape, ..): Case) -> usize {
        let reach = self.world.kernel.support_radius();
        let positions = self.world.free.get(fields::POSITION).expect("positions");
        let beside = |x: f64| x.min(1.0 - x);
        let depth = |x: &Vect<D>| match shape {
            "pipe" => beside(x[0]).min(0.5 - off_axis(x)),
            _ => x.iter().map(|x| beside(*x)).fold(1.0, f64::min),
        };
        positions.iter().filter(|x| depth(x) < reach).count()
    }
}

fn off_axis<const D: usize>(x: &Vect<D>) -> f64 {
    (1..D).map(|k| (x[k] - 0.5).powi(2)).sum::<f64>().sqrt()
}

/// A lattice displaced a little, in the unit box or in the pipe around its axis.
fn positions<const D: usize>(round: bool, spacing: f64) -> Vec<Vect<D>> {
    let place = |n: usize| {
        Vect::<D>::from_fn(|k, _| {
            let i = (n / ACROSS.pow(k as u32) % ACROSS) as f64;
            let shift = (0.37 * (n * (k + 1)) as f64).sin();
            (i + 0.5 + 0.1 * shift) * spacing
        })
    };
    let all = (0..ACROSS.pow(D as u32)).map(place);
    all.filter(|x| !round || off_axis(x) < 0.5 - 0.4 * spacing)
        .collect()
}

fn drawing(shape: &str) -> Drawing {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let around = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / FACETS as f64).sin_cos();
        [0.5 + 0.5 * cos, 0.5 + 0.5 * sin]
    };
    match shape {
        "square" => Drawing::Line(Polyline::closed("square", square.to_vec())),
        "box" => Drawing::Surface(prism(&square)),
        _ => Drawing::Surface(prism(&(0..FACETS).map(around).collect::<Vec<_>>())),
    }
}

/// A closed prism along x from 0 to 1 m over a convex outline, with the fluid inside.
fn prism(outline: &[[f64; 2]]) -> Surface {
    let n = outline.len() as u32;
    let ring = |x: f64| outline.iter().map(move |[y, z]| [x, *y, *z]);
    let side = |i: u32| {
        let j = (i + 1) % n;
        [[i, n + j, j], [i, n + i, n + j]]
    };
    let ends = (1..n - 1).flat_map(|i| [[0, i, i + 1], [n, n + i + 1, n + i]]);
    Surface {
        name: "prism".into(),
        points: ring(0.0).chain(ring(1.0)).collect(),
        triangles: (0..n).flat_map(side).chain(ends).collect(),
    }
}
