//! The beds of walls that grains make, as they are drawn.

use sph_core::Erodible;
use sph_core::bed::{Bed, LevelGrid, horizontal};

use crate::geometry::vector::{bounds, perp, sub};
use crate::{BoundaryError, Mesh, PeriodicBox, Result, WallSpec};

/// Elements whose normal has a smaller part upwards are no floor.
const FLOOR: f64 = 0.02;
const MOST_PLACES: usize = 1_000_000;
/// A place this near to the border of an element, over the cell, is within it.
const BORDER: f64 = 1e-6;

/// The beds of all walls that are one, in the order of the walls.
///
/// # Errors
/// A bed without a floor, or of too many places.
pub(crate) fn laid<const D: usize>(
    mesh: &Mesh<D>,
    specs: &[WallSpec<D>],
    domain: &PeriodicBox<D>,
) -> Result<Vec<Bed>> {
    let mut beds = Vec::new();
    let mut seen: Vec<&str> = Vec::new();
    for name in specs.iter().filter_map(|spec| spec.motion.bed.as_deref()) {
        if seen.contains(&name) {
            continue;
        }
        seen.push(name);
        let follows = |k: &usize| specs[*k].motion.bed.as_deref() == Some(name);
        let own = |k: &usize| specs[*k].drawing.name() == name;
        let (own, others): (Vec<usize>, Vec<usize>) =
            (0..specs.len()).filter(follows).partition(own);
        let erodible = own.first().and_then(|k| specs[*k].erodible.as_ref());
        let erodible = erodible.ok_or_else(|| no_floor(name))?;
        let floor = floor(mesh, &own);
        let all = own.iter().chain(&others).map(|k| *k as u32);
        beds.push(bed((name, erodible), &floor, all.collect(), domain)?);
    }
    Ok(beds)
}

fn floor<const D: usize>(mesh: &Mesh<D>, walls: &[usize]) -> Vec<[[f64; D]; D]> {
    let upward = |e: &usize| {
        let element = &mesh.elements[*e];
        walls.contains(&element.wall) && element.normal[D - 1] > FLOOR
    };
    let all = 0..mesh.elements.len();
    all.filter(upward).map(|e| mesh.corners(e)).collect()
}

fn bed<const D: usize>(
    (name, erodible): (&str, &Erodible),
    floor: &[[[f64; D]; D]],
    walls: Vec<u32>,
    domain: &PeriodicBox<D>,
) -> Result<Bed> {
    if floor.is_empty() {
        return Err(no_floor(name));
    }
    let cell = erodible.cell.unwrap_or_default();
    let (grid, cut) = grid((name, erodible), cell, floor, domain)?;
    let level = |place| level(floor, grid.position(place), BORDER * cell);
    let levels: Vec<_> = (0..grid.len()).map(level).collect();
    let covered: Vec<bool> = levels.iter().map(Option::is_none).collect();
    let at_cut = |place: usize| {
        let index = grid.index(place);
        (0..2).any(|k| cut[k][0] && index[k] == 0 || cut[k][1] && index[k] + 1 == grid.count[k])
    };
    let drawn = filled(&grid, levels).ok_or_else(|| no_floor(name))?;
    Ok(Bed {
        walls,
        held: (0..grid.len()).map(at_cut).collect(),
        covered,
        rock: erodible.rock.unwrap_or(f64::NEG_INFINITY),
        fade: erodible.stretch.unwrap_or_default(),
        ..Bed::drawn(grid, drawn)
    })
}

fn no_floor(name: &str) -> BoundaryError {
    let why = "has no part that faces upwards, which a bed of grains needs";
    BoundaryError::unfit(name, why)
}

/// The places of a bed, and at which ends of the axes it is cut off from the rest of the wall.
fn grid<const D: usize>(
    (name, erodible): (&str, &Erodible),
    cell: f64,
    floor: &[[[f64; D]; D]],
    domain: &PeriodicBox<D>,
) -> Result<(LevelGrid, [[bool; 2]; 2])> {
    let mut grid = LevelGrid {
        lower: [0.0; 2],
        cell: [1.0; 2],
        count: [1; 2],
        periodic: [false; 2],
    };
    let [lower, upper] = bounds(floor.iter().flatten().copied());
    let mut cut = [[false; 2]; 2];
    for k in 0..D - 1 {
        let (low, high) = (lower[k], upper[k]);
        let near = BORDER * cell;
        let [from, to] = erodible.extent(k);
        cut[k] = [from > low + near, to < high - near];
        let (low, high) = (low.max(from), high.min(to));
        let length = high - low;
        if length.is_nan() || length <= 0.0 {
            return Err(no_floor(name));
        }
        let cells = (length / cell).round().max(1.0);
        if cells * grid.count[0] as f64 > MOST_PLACES as f64 {
            return Err(BoundaryError(format!(
                "the bed `{name}` has {} places, more than {MOST_PLACES}: give it a larger `cell`",
                cells * grid.count[0] as f64
            )));
        }
        let whole = domain.periodic[k] && length > domain.periods()[k] - near;
        grid.periodic[k] = whole;
        grid.lower[k] = low;
        grid.cell[k] = length / cells;
        grid.count[k] = cells as usize + usize::from(!whole);
    }
    Ok((grid, cut))
}

/// The lowest floor over a place, m; none where there is no floor.
fn level<const D: usize>(floor: &[[[f64; D]; D]], at: [f64; 2], border: f64) -> Option<f64> {
    let levels = floor.iter().filter_map(|corners| {
        let flat = corners.map(|c| horizontal(&c));
        let shares = shares(&flat, at, border)?;
        Some((0..D).map(|k| shares[k] * corners[k][D - 1]).sum::<f64>())
    });
    levels.reduce(f64::min)
}

/// The shares of the corners of a simplex, drawn in the plane, of which a place is the mean; none if it is outside.
fn shares<const D: usize>(corners: &[[f64; 2]; D], at: [f64; 2], border: f64) -> Option<[f64; D]> {
    let side = |k: usize| sub(corners[(k + 1) % D], corners[k]);
    let mut shares = [0.0; D];
    if D == 2 {
        let (length, along) = (side(0)[0], at[0] - corners[0][0]);
        let within =
            along * length.signum() > -border && (along - length) * length.signum() < border;
        let share = (along / length).clamp(0.0, 1.0);
        [shares[0], shares[1]] = [1.0 - share, share];
        return within.then_some(shares);
    }
    let double = perp(side(0), side(1));
    for (k, share) in shares.iter_mut().enumerate() {
        // The share of a corner is the area opposite to it.
        let opposite = (k + 1) % D;
        let edge = side(opposite);
        let area = perp(edge, sub(at, corners[opposite]));
        if area * double.signum() < -border * edge[0].hypot(edge[1]) {
            return None;
        }
        *share = area / double;
    }
    Some(shares)
}

/// Levels with those of places without a floor from their neighbours; none if there is no floor at all.
fn filled(grid: &LevelGrid, mut levels: Vec<Option<f64>>) -> Option<Vec<f64>> {
    while levels.contains(&None) {
        let known = levels.clone();
        let mut sums = vec![(0.0, 0.0); grid.len()];
        for place in 0..grid.len() {
            for other in (0..2).filter_map(|axis| grid.step(place, axis, 1)) {
                for (a, b) in [(place, other), (other, place)] {
                    if let Some(level) = known[b] {
                        sums[a] = (sums[a].0 + level, sums[a].1 + 1.0);
                    }
                }
            }
        }
        for (level, (sum, count)) in levels.iter_mut().zip(sums) {
            if level.is_none() && count > 0.0 {
                *level = Some(sum / count);
            }
        }
        if levels == known {
            return None;
        }
    }
    levels.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_those_of_the_lowest_floor() {
        let floor = [
            [[0.0, 0.0], [1.0, 0.5]],
            [[1.0, 0.5], [2.0, 0.5]],
            [[0.0, 3.0], [2.0, 3.0]],
        ];
        let at = |x: f64| level(&floor, [x, 0.0], 1e-9);
        assert_eq!(at(0.5), Some(0.25));
        assert_eq!(at(2.0), Some(0.5));
        assert_eq!(at(2.1), None);
        let triangle = [[[0.0, 0.0, 1.0], [1.0, 0.0, 2.0], [0.0, 1.0, 4.0]]];
        let at = |x: f64, y: f64| level(&triangle, [x, y], 1e-9);
        assert_eq!(at(0.25, 0.5), Some(0.25 * 1.0 + 0.25 * 2.0 + 0.5 * 4.0));
        assert_eq!(at(0.0, 1.0), Some(4.0));
        assert_eq!(at(0.6, 0.5), None);
    }
}
