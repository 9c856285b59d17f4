//! A fluid between flat semi-analytical walls, with ∇γ and γ by quadrature.
//!
//! The walls are made here, not by a wall plugin: the numbers check the operators alone.

use sph_core::{Role, Vect, fields};
use sph_kernels::{Sampler, gauss_points};
use sph_neighbours::{ContactBlock, Domain, WallSet, World};

use crate::world::world;

/// h = 1 m, δr = 1/2 m, a period of 8 m.
pub const SPACING: f64 = 0.5;
pub const PERIOD: f64 = 8.0;
const COLUMNS: usize = 16;

fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    gauss_points(from, to, 16).map(|[x, w]| w * f(x)).sum()
}

/// ∫ w over a stretch [from, to] of a line at a distance from the particle, 1/m.
fn stretch(kernel: &dyn Sampler, distance: f64, from: f64, to: f64) -> f64 {
    let rim = kernel.support_radius().powi(2) - distance * distance;
    if rim <= 0.0 {
        return 0.0;
    }
    let (from, to) = (from.max(-rim.sqrt()), to.min(rim.sqrt()));
    if from >= to {
        return 0.0;
    }
    integral(from, to, |s| kernel.at(s.hypot(distance)).0)
}

/// γ over an infinite flat wall: 1 − ∫ ∇γ from here to the end of the support.
pub fn gamma(kernel: &dyn Sampler, distance: f64) -> f64 {
    let end = kernel.support_radius();
    if distance >= end {
        return 1.0;
    }
    1.0 - integral(distance, end, |d| stretch(kernel, d, -end, end))
}

/// A channel of a height: rows at ½ m, 1 m, … below the upper wall, or `rows` without one.
pub struct Channel {
    pub world: World<2>,
    pub top: Option<f64>,
}

impl Channel {
    /// `rows` rows over a floor, nothing above them.
    pub fn open(rows: usize) -> Self {
        Self::new(rows, None)
    }

    /// `rows` rows between two walls.
    pub fn closed(rows: usize) -> Self {
        Self::new(rows, Some(SPACING * (rows + 1) as f64))
    }

    fn new(rows: usize, top: Option<f64>) -> Self {
        let row =
            |k: usize| (0..COLUMNS).map(move |i| Vect::<2>::new(i as f64, k as f64) * SPACING);
        let positions = (1..=rows).flat_map(row).collect();
        let domain = Domain {
            lower: Vect::<2>::new(0.0, -20.0),
            upper: Vect::<2>::new(PERIOD, 20.0),
            periodic: [true, false],
        };
        let mut world = world::<2>(positions, domain, SPACING, 2.0);
        world.free.add(fields::RENORMALISATION, Role::State);
        world.walls = walls(top);
        world.rebuild_lists().unwrap();
        measure(&mut world, top);
        Channel { world, top }
    }
}

/// Vertices and segments of all walls.
fn walls(top: Option<f64>) -> WallSet<2> {
    let mut walls = WallSet::default();
    let lines = [(0.0, 1.0)].into_iter().chain(top.map(|y| (y, -1.0)));
    for (y, up) in lines {
        for i in 0..COLUMNS {
            let x = i as f64 * SPACING;
            let points = &mut walls.points;
            points.position.push(Vect::<2>::new(x, y));
            points.velocity.push(Vect::zeros());
            points.viscous_velocity.push(Vect::zeros());
            points.share.push(0.5);
            points.volume.push(SPACING * SPACING);
            points.pressure.push(0.0);
            points.friction_factor.push(1.0);
            points.wall.push(0);
            let elements = &mut walls.elements;
            elements.centre.push(Vect::<2>::new(x + 0.5 * SPACING, y));
            elements.normal.push(Vect::<2>::new(0.0, up));
            elements.velocity.push(Vect::zeros());
            elements.measure.push(SPACING);
            elements.volume.push(SPACING * SPACING);
            elements.pressure.push(0.0);
            elements.friction_factor.push(1.0);
            elements.wall.push(0);
            let first = elements.corners.len() as u32;
            elements.corners.push([first, first]);
        }
    }
    walls
}

/// γ and the shares of ∇γ at the present positions, with the height of the upper wall.
pub fn measure(world: &mut World<2>, top: Option<f64>) {
    let mut gammas = Vec::new();
    let contacts = &mut world.walls.contacts;
    let mut blocks = contacts.take_blocks(world.free.len());
    blocks.clear();
    let elements = &world.walls.elements;
    for (p, x) in world.free.get(fields::POSITION).unwrap().iter().enumerate() {
        let kernel = &*world.kernel;
        let above = top.map_or(1.0, |top| gamma(kernel, top - x[1]));
        gammas.push(gamma(kernel, x[1]) + above - 1.0);
        let mut block = ContactBlock::default();
        for (s, centre) in elements.centre.iter().enumerate() {
            let apart = world.domain.nearest_image(x - centre);
            let distance = apart.dot(&elements.normal[s]);
            let half = 0.5 * SPACING;
            let share = stretch(kernel, distance, apart[0] - half, apart[0] + half);
            let share = std::iter::once((s as u32, share.max(0.0)));
            block.push(elements.normal[s], distance, share);
        }
        contacts.place(p as u32, p, 0..block.planes());
        blocks.push(block);
    }
    contacts.put_blocks(blocks);
    *world.free.get_mut(fields::RENORMALISATION).unwrap() = gammas;
    world.walls.update_contacts();
}

#[test]
fn the_quadrature_gives_the_printed_gamma_and_its_gradient() {
    let kernel = sph_kernels::Kernel::sampler(&sph_kernels::wendland_c2(), 2, 1.0);
    // Theory §3.5, infinite flat wall, nine digits.
    let table = [
        (0.1, 0.729_104_185, 0.573_814_665),
        (0.5, 0.483_731_398, 0.823_496_914),
        (1.0, 0.136_330_599, 0.971_490_937),
        (1.5, 0.009_065_153, 0.999_129_737),
    ];
    for (distance, gradient, value) in table {
        let found = stretch(&*kernel, distance, -2.0, 2.0);
        assert!((found - gradient).abs() < 1e-7, "{distance}: ∇γ {found}");
        let found = gamma(&*kernel, distance);
        assert!((found - value).abs() < 1e-7, "{distance}: γ {found}");
    }
}
