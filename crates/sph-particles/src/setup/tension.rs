//! Background pressure of a full box whose open faces brake the fluid: without it the fluid would have to carry
//! tension.
//!
//! A face whose velocity into the fluid falls by Δu sends off a wave of −ρcΔu. Particles carry no tension: a full box
//! without background pressure is torn apart, and torn parts move on their own.

use sph_boundary::Wall;
use sph_core::Vect;
use sph_neighbours::{CellGrid, World};
use sph_open::OpenBoundaries;
use sph_rheology::state::{Laws, Lift};
use sph_scene::Scene;

/// Lift over ρcΔu: half as much again for reflections at faces and walls.
const LIFT: f64 = 1.5;
/// The largest lift over ρc²: that of a flow of Mach 0.1 that turns round.
const MOST: f64 = 0.3;
/// Distance over the spacing within which a particle fills a place.
const NEAR: f64 = 0.8;

/// A box, its particles, their laws and their lift.
pub(crate) type FilledBox<'a, const D: usize> = (&'a World<D>, &'a [Vect<D>], &'a Laws, &'a Lift);

/// Lifts the law of a full box of one phase if a face brakes its fluid and the law has no background pressure; a
/// remark on it, or on the background pressure that is missing.
pub(crate) fn lift<const D: usize>(
    scene: &Scene,
    opened: &OpenBoundaries<D>,
    walls: Option<&dyn Wall<D>>,
    (room, positions, laws, lift): FilledBox<'_, D>,
) -> Option<String> {
    let walls = walls?;
    let references = || laws.iter().map(|law| law.reference());
    let slowest = references()
        .map(|r| r.sound_speed)
        .fold(f64::INFINITY, f64::min);
    let ends = positions
        .iter()
        .fold(None, |ends: Option<(Vect<D>, Vect<D>)>, x| {
            let (low, high) = ends.unwrap_or((*x, *x));
            Some((low.inf(x), high.sup(x)))
        });
    let (low, high) = ends?;
    // Sound goes there and back.
    let time = 2.0 * (high - low).norm() / slowest;
    let (face, fall) = opened.braking(time, scene.run.end)?;
    let at_reference = laws.iter().map(|law| {
        let mut pressure = [0.0];
        law.pressure(&[law.reference().density], &mut pressure);
        pressure[0]
    });
    let background = at_reference.fold(0.0, f64::max);
    let tension = references()
        .map(|r| r.density * r.sound_speed * fall)
        .fold(0.0, f64::max);
    if background >= tension || !is_full(room, walls, positions) {
        return None;
    }
    let stiffness = references().map(|r| r.density * r.sound_speed.powi(2));
    let stiffness = stiffness.fold(f64::INFINITY, f64::min);
    let pressure = LIFT * tension;
    let why = format!(
        "the open face `{face}` brakes the fluid of a full box by {fall:.3} m/s, which needs a tension of {tension:.3e} Pa; particles carry none"
    );
    // A light phase beside a heavy one would be stirred by a background pressure of the heavy one's size.
    if background > 0.0 || laws.len() > 1 {
        return Some(format!(
            "{why}: let it change more slowly, or give a `background_pressure` of {pressure:.2e} Pa"
        ));
    }
    if pressure > MOST * stiffness {
        return Some(format!(
            "{why}: raise `speed_of_sound` until ρc² is above {:.2e} Pa, or give a `background_pressure`",
            pressure / MOST
        ));
    }
    lift.set(pressure);
    opened.lifted();
    Some(format!(
        "{why}: all pressures are {pressure:.3e} Pa higher; a `background_pressure` of the equation of state takes \
         its place"
    ))
}

/// True if every place a spacing beside a particle has another particle, or is behind a wall.
fn is_full<const D: usize>(room: &World<D>, walls: &dyn Wall<D>, positions: &[Vect<D>]) -> bool {
    let reach = (1.0 + NEAR) * room.spacing;
    let grid = CellGrid::new(positions, reach, &room.domain);
    positions.iter().all(|x| {
        let mut around = Vec::new();
        grid.ranges(x, reach, |range| {
            let ways = grid.order()[range]
                .iter()
                .map(|j| positions[*j as usize] - x);
            around.extend(ways.map(|way| room.domain.nearest_image(way)));
        });
        (0..2 * D).all(|side| {
            let mut way = Vect::<D>::zeros();
            way[side / 2] = if side % 2 == 0 {
                room.spacing
            } else {
                -room.spacing
            };
            let near = |other: &Vect<D>| (other - way).norm() < NEAR * room.spacing;
            around.iter().any(near) || !walls.contains(&(x + way))
        })
    })
}
