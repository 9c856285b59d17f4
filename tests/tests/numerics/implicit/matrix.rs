//! The matrix is the explicit term's: the same accelerations, symmetric, positive definite.

use sph_core::{System, Vect, fields};
use sph_multiphase::linear::{Block, Cholesky, Diagonal, Entries, LinearSolver, Matrix, Operator};
use sph_multiphase::viscosity::{
    Choice, EspanolRevenga, FrictionOperator, FrictionSystem, HuAdamsViscosity, KrimiViscosity,
    MonaghanGingold, Morris, OnLattice, Viscosity, ViscousOperator, WallTerm,
};
use sph_neighbours::{Weak, World, interactions};
use sph_tests::{assembled, scene, within};

const ETA: f64 = 3.0;
/// A tank with a slanted wall, and what else stands in `[numerics]` and behind `[wall.tank]`.
fn tank(numerics: &str, rest: &str) -> World<2> {
    let text = format!(
        r#"
        title = "tank"
        dimension = 2
        [run]
        end = 1.0
        [numerics]
        spacing = 0.05
        smoothing_ratio = 2.0
        {numerics}
        [walls.usaw]
        [wall.tank]
        polyline = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.7], [0.6, 1.0], [0.0, 1.0]]
        closed = true
        {rest}
    "#
    );
    disturbed(&text)
}

/// A still fluid between slanted walls, cut from a lattice, then stirred and disturbed.
fn wedge() -> World<2> {
    let fluid = r#"
        velocity = [0.3, 0.0]
        [phase.fluid]
        density = 2.0
        speed_of_sound = 10.0
        [phase.fluid.rheology.newtonian]
        viscosity = 1.0
        [body.fluid]
        phase = "fluid"
        fill = "walls"
    "#;
    tank("", fluid)
}

/// A box in three dimensions.
fn cube() -> World<3> {
    let text = include_str!("cube.toml");
    disturbed(text)
}

fn disturbed<const D: usize>(text: &str) -> World<D> {
    let mut flow = assembled::<D>(&scene(text, &[])).flow;
    let spacing = flow.world.spacing;
    let wave = |x: f64, k: usize| (37.0 * x + 2.0 * k as f64).sin();
    let positions = flow.world.free.get_mut(fields::POSITION).unwrap();
    for (i, x) in positions.iter_mut().enumerate() {
        *x += Vect::from_fn(|k, _| 0.1 * spacing * wave(i as f64, k));
    }
    flow.evaluate().expect("a state");
    let velocities = flow.world.free.get_mut(fields::VELOCITY).unwrap();
    for (i, u) in velocities.iter_mut().enumerate() {
        *u = Vect::from_fn(|k, _| wave(0.7 * i as f64, k));
    }
    flow.world
}

/// Two liquids, 10⁶ times as viscous the lower one, at random places.
fn layers() -> World<2> {
    let liquids = r#"
        [phase.honey]
        density = 3.0
        speed_of_sound = 10.0
        [phase.honey.rheology.newtonian]
        viscosity = 1000.0
        [phase.water]
        density = 2.0
        speed_of_sound = 10.0
        [phase.water.rheology.newtonian]
        viscosity = 0.001
        [body.below]
        phase = "honey"
        box = [[0.0, 0.0], [1.0, 0.4]]
        [body.above]
        phase = "water"
        box = [[0.0, 0.4], [1.0, 1.0]]
        clip = true
    "#;
    tank("jitter = 0.4", liquids)
}

fn operators<const D: usize>() -> Vec<(&'static str, Box<dyn ViscousOperator<D>>)> {
    let literal = Morris(Choice {
        wall_term: WallTerm::Literal,
        on_lattice: OnLattice::Literal,
        ..Choice::default()
    });
    vec![
        ("morris", Box::new(Morris::default())),
        ("morris, literal", Box::new(literal)),
        ("hu-adams", Box::new(HuAdamsViscosity::default())),
        ("espanol-revenga", Box::new(EspanolRevenga::default())),
        ("monaghan-gingold", Box::new(MonaghanGingold::default())),
        ("krimi", Box::new(KrimiViscosity::default())),
    ]
}

/// K of an operator without the `weak` pairs, and s; `of` looks at them.
fn friction<const D: usize, R>(
    world: &World<D>,
    operator: &dyn ViscousOperator<D>,
    viscosity: Viscosity,
    weak: Option<Weak<'_, D>>,
    of: impl FnOnce(&FrictionOperator<'_, D>, &[Vect<D>]) -> R,
) -> R {
    let coupling = operator.coupling(viscosity);
    let mut system = FrictionSystem::default();
    system.mass = vec![0.0; world.free.len()];
    let filled = system.fill_without(&*coupling, world, weak, [1.0, 1.0]);
    filled.unwrap();
    let space = world.space().unwrap();
    of(&system.operator(world, &space).unwrap(), &system.right)
}

fn largest<const D: usize>(all: &[Vect<D>]) -> f64 {
    all.iter().map(|v| v.amax()).fold(0.0, f64::max)
}

/// Mean coupling of every row.
fn mean_couplings<const D: usize>(matrix: &Matrix<D>) -> Vec<f64> {
    let mean = |i: usize| {
        let own = match &matrix.entries {
            Entries::Scalar(v) => v.diagonal[i],
            Entries::Block(v) => v.diagonal[i][(0, 0)],
        };
        own / matrix.pattern.row(i).len() as f64
    };
    (0..matrix.rows()).map(mean).collect()
}

/// The diagonal that is found without the matrix is the matrix's, and so is the stiffness.
fn is_its_diagonal<const D: usize>(
    couplings: &FrictionOperator<'_, D>,
    matrix: &Matrix<D>,
    name: &str,
) {
    let apart = match (couplings.diagonal().expect("one"), &matrix.entries) {
        (Diagonal::Scalar(own), Entries::Scalar(all)) => {
            let both = own.iter().zip(&all.diagonal);
            both.map(|(a, b)| (a - b).abs() / b.abs())
                .fold(0.0, f64::max)
        }
        (Diagonal::Block(own), Entries::Block(all)) => {
            let both = own.iter().zip(&all.diagonal);
            both.map(|(a, b)| (a - b).amax() / b.amax())
                .fold(0.0, f64::max)
        }
        _ => panic!("{name}: numbers here, blocks there"),
    };
    assert!(apart < 1e-12, "{name} in {D}D: {apart:e} between diagonals");
}

fn is_the_term<const D: usize>(world: &World<D>) {
    let velocity = world.free.get(fields::VELOCITY).unwrap();
    let mass = world.free.get(fields::MASS).unwrap();
    let gamma = world.free.get(fields::RENORMALISATION).unwrap();
    for (name, operator) in operators::<D>() {
        let mut explicit = vec![Vect::zeros(); mass.len()];
        let term = operator.term(Viscosity::Uniform(ETA));
        interactions(world, &[term], &mut explicit, None).unwrap();
        for (i, a) in explicit.iter_mut().enumerate() {
            *a *= mass[i] * gamma[i];
        }
        let viscosity = Viscosity::Uniform(ETA);
        let is_explicit = |weak| {
            friction(world, &*operator, viscosity, weak, |couplings, source| {
                let matrix = couplings.assembled().expect("a matrix");
                let both: [&dyn Operator<D>; 2] = [couplings, matrix];
                for (from, product) in ["couplings", "matrix"].into_iter().zip(both) {
                    let mut force = vec![Vect::zeros(); mass.len()];
                    product.multiply(velocity, &mut force);
                    let apart: Vec<_> = (0..mass.len())
                        .map(|i| explicit[i] - (source[i] - force[i]))
                        .collect();
                    let error = largest(&apart) / largest(&explicit);
                    assert!(error < 1e-12, "{name} in {D}D: {error:e} by {from}");
                }
                let apart = matrix.asymmetry();
                assert!(apart < 1e-14, "{name} in {D}D: asymmetry {apart:e}");
                is_its_diagonal(couplings, matrix, name);
                matrix.clone()
            })
        };
        let whole = is_explicit(None);
        let limit = mean_couplings(&whole);
        let strong = is_explicit(Some(Weak {
            velocity,
            limit: &limit,
        }));
        let entries = |m: &Matrix<D>| m.pattern.columns.len() as f64;
        let left = entries(&strong) / entries(&whole);
        within(left, 0.1..0.9, &format!("{name} in {D}D: pairs left"));
    }
}

#[test]
fn couplings_matrix_and_weak_pairs_give_the_explicit_force_to_1e_12_next_to_walls_in_2d_and_3d() {
    is_the_term(&wedge());
    is_the_term(&cube());
}

fn is_symmetric_and_definite<const D: usize>(world: &World<D>, viscosity: Viscosity) {
    for (name, operator) in operators::<D>() {
        let mut matrix = friction(world, &*operator, viscosity, None, |couplings, _| {
            couplings.assembled().expect("a matrix").clone()
        });
        let apart = matrix.asymmetry();
        assert!(apart < 1e-14, "{name} in {D}D: asymmetry {apart:e}");
        // With a millionth of the mass the factorisation still has positive pivots.
        let mass = 1e-6 * world.free.get(fields::MASS).unwrap()[0];
        match &mut matrix.entries {
            Entries::Scalar(v) => v.diagonal.iter_mut().for_each(|d| *d += mass),
            Entries::Block(v) => {
                let unit = Block::<D>::identity() * mass;
                v.diagonal.iter_mut().for_each(|d| *d += unit);
            }
        }
        let right = vec![Vect::repeat(1.0); matrix.rows()];
        let mut x = right.clone();
        let solved = Cholesky::default().solve(&matrix, &right, &mut x);
        assert!(solved.is_ok(), "{name} in {D}D: {solved:?}");
    }
}

#[test]
fn it_is_symmetric_to_1e_14_and_positive_definite_on_disturbed_particles_with_walls() {
    is_symmetric_and_definite(&wedge(), Viscosity::Uniform(ETA));
    is_symmetric_and_definite(&cube(), Viscosity::Uniform(ETA));
}

#[test]
fn nor_does_a_contrast_of_a_million_on_random_particles_change_that() {
    is_symmetric_and_definite(&layers(), Viscosity::PerPhase);
}
