//! Beds: walls whose levels rise and sink.

/// A position this near to the border of a grid, over the cell, is on it.
const NEAR: f64 = 1e-6;

/// A regular grid of places in the horizontal plane; in two dimensions a line of them along x.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelGrid {
    /// The first place, m.
    pub lower: [f64; 2],
    /// Distances of the places along x and y, m; 1 along y in two dimensions.
    pub cell: [f64; 2],
    /// Number of places along x and y.
    pub count: [usize; 2],
    /// Axes along which the place after the last one is the first, a period on.
    pub periodic: [bool; 2],
}

impl LevelGrid {
    /// Number of places.
    pub fn len(&self) -> usize {
        self.count[0] * self.count[1]
    }

    /// True if there is no place.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Column and row of a place.
    pub fn index(&self, place: usize) -> [usize; 2] {
        [place % self.count[0], place / self.count[0]]
    }

    /// Position of a place, m.
    pub fn position(&self, place: usize) -> [f64; 2] {
        let index = self.index(place);
        std::array::from_fn(|k| self.lower[k] + self.cell[k] * index[k] as f64)
    }

    /// The part of the plane that is nearer to a place than to others, m² (m in two dimensions).
    pub fn area(&self, place: usize) -> f64 {
        self.side(place, 0) * self.side(place, 1)
    }

    /// The extent of that part along an axis, m.
    pub fn side(&self, place: usize, axis: usize) -> f64 {
        let (index, count) = (self.index(place)[axis], self.count[axis]);
        let at_end = index == 0 || index + 1 == count;
        match at_end && !self.periodic[axis] && count > 1 {
            true => 0.5 * self.cell[axis],
            false => self.cell[axis],
        }
    }

    /// The place some steps from one along an axis, upwards; none beyond the ends of an axis that is not periodic.
    pub fn step(&self, place: usize, axis: usize, by: isize) -> Option<usize> {
        let (mut index, count) = (self.index(place), self.count[axis] as isize);
        let there = index[axis] as isize + by;
        if !self.periodic[axis] && !(0..count).contains(&there) {
            return None;
        }
        index[axis] = there.rem_euclid(count) as usize;
        Some(index[0] + self.count[0] * index[1])
    }

    /// The four places around a position, m, with their weights in the bilinear mean; the nearest ones from beyond the grid.
    pub fn around(&self, at: [f64; 2]) -> [(usize, f64); 4] {
        let side = |k: usize| {
            let steps = (at[k] - self.lower[k]) / self.cell[k];
            let count = self.count[k];
            match self.periodic[k] {
                true => {
                    let whole = steps.floor();
                    let from = whole.rem_euclid(count as f64) as usize % count;
                    ([from, (from + 1) % count], steps - whole)
                }
                false => {
                    let from = (steps.max(0.0) as usize).min(count.saturating_sub(2));
                    let share = (steps - from as f64).clamp(0.0, 1.0);
                    ([from, (from + 1).min(count - 1)], share)
                }
            }
        };
        let ((xs, sx), (ys, sy)) = (side(0), side(1));
        let place = |i: usize, k: usize| xs[i] + self.count[0] * ys[k];
        [
            (place(0, 0), (1.0 - sx) * (1.0 - sy)),
            (place(1, 0), sx * (1.0 - sy)),
            (place(0, 1), (1.0 - sx) * sy),
            (place(1, 1), sx * sy),
        ]
    }

    /// True if a position, m, is between places, or at the first or the last ones.
    pub fn has(&self, at: [f64; 2]) -> bool {
        (0..2).filter(|k| self.count[*k] > 1).all(|k| {
            let steps = (at[k] - self.lower[k]) / self.cell[k];
            let last = (self.count[k] - 1) as f64;
            self.periodic[k] || (steps > -NEAR && steps < last + NEAR)
        })
    }

    /// The bilinear mean of values of the places at a position, m.
    pub fn mean(&self, values: &[f64], at: [f64; 2]) -> f64 {
        self.around(at).iter().map(|(k, w)| w * values[*k]).sum()
    }
}

/// A wall that grains make: its levels, and how they change.
///
/// A place of the wall at the height Z when it was drawn is lifted by ζ(x, y) max(0, min(1, 1 − (Z − z₀)/H)), with the lift ζ of
/// the bed, its first level z₀ and a height H within which walls that stand in the bed stretch. Beyond the grid walls stay.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bed {
    /// Numbers of the walls that follow it; the bed's own one is the first.
    pub walls: Vec<u32>,
    /// Grid of the known levels.
    pub grid: LevelGrid,
    /// Levels z₀ at the start, m.
    pub drawn: Vec<f64>,
    /// Places that a structure covers, of which no grain moves.
    pub covered: Vec<bool>,
    /// Places whose level is held: grains pass them, in or out of the bed.
    pub held: Vec<bool>,
    /// The level under which there are no grains, m; −∞ without.
    pub rock: f64,
    /// H, m.
    pub fade: f64,
    /// ζ, m.
    pub lift: Vec<f64>,
    /// Rate of ζ, m/s.
    pub rate: Vec<f64>,
    /// Shear stress of the flow along x and y over the density of the water, m²/s².
    pub shear: Vec<[f64; 2]>,
    /// Volume of grains, without pores, that moves along the bed per width and time along x and y, m²/s.
    pub transport: Vec<[f64; 2]>,
    /// Volume of grains that came through the places with held levels since the start, less the outflow, m³ (m² in two
    /// dimensions), without pores.
    pub fed: f64,
    /// Volume of grains that slid since the start.
    pub slid: f64,
    /// Volume of grains that the flow has lifted into suspension since the start, less what has settled.
    pub lifted: f64,
    /// Shields numbers at which the grains of the places begin to move; none as long as the bed is held fast.
    pub critical: Vec<f64>,
    /// (s − 1) g d, the shear over density of a Shields number of 1, m²/s²; 0 as long as no grains lie there.
    pub unit_shear: f64,
    /// √((s − 1) g d³), the flux of a dimensionless rate of 1, m²/s; 0 as long as no grains lie there.
    pub unit_transport: f64,
}

/// The horizontal part of a position, m.
pub fn horizontal<const D: usize>(x: &[f64; D]) -> [f64; 2] {
    [x[0], if D == 3 { x[1] } else { 0.0 }]
}

impl Bed {
    /// A bed as it is drawn, with its places and first levels, m.
    pub fn drawn(grid: LevelGrid, levels: Vec<f64>) -> Self {
        let count = grid.len();
        Bed {
            grid,
            drawn: levels,
            covered: vec![false; count],
            held: vec![false; count],
            rock: f64::NEG_INFINITY,
            fade: f64::INFINITY,
            lift: vec![0.0; count],
            rate: vec![0.0; count],
            shear: vec![[0.0; 2]; count],
            transport: vec![[0.0; 2]; count],
            ..Bed::default()
        }
    }

    /// Present level at a place, m.
    pub fn level(&self, place: usize) -> f64 {
        self.drawn[place] + self.lift[place]
    }

    /// The lift of a point of the walls that was drawn somewhere, m.
    pub fn lift_of<const D: usize>(&self, drawn: &[f64; D]) -> f64 {
        let at = horizontal(drawn);
        if !self.grid.has(at) {
            return 0.0;
        }
        self.grid.mean(&self.lift, at) * self.share(drawn[D - 1] - self.grid.mean(&self.drawn, at))
    }

    /// True if a point of the walls that was drawn somewhere follows the bed.
    pub fn moves<const D: usize>(&self, drawn: &[f64; D]) -> bool {
        let at = horizontal(drawn);
        self.grid.has(at) && self.share(drawn[D - 1] - self.grid.mean(&self.drawn, at)) > 0.0
    }

    /// The upward velocity of a point of the walls at its present position, m/s.
    pub fn rate_of<const D: usize>(&self, present: &[f64; D]) -> f64 {
        let at = horizontal(present);
        if !self.grid.has(at) {
            return 0.0;
        }
        let lift = self.grid.mean(&self.lift, at);
        let above = present[D - 1] - self.grid.mean(&self.drawn, at) - lift;
        // Z − z₀ of a place that was stretched from the height H.
        let height = above / (1.0 - lift / self.fade);
        self.grid.mean(&self.rate, at) * self.share(height)
    }

    fn share(&self, height: f64) -> f64 {
        (1.0 - height / self.fade).clamp(0.0, 1.0)
    }

    /// Shields number at a place; 0 as long as no grains lie there.
    pub fn shields(&self, place: usize) -> f64 {
        let [x, y] = self.shear[place];
        match self.unit_shear > 0.0 {
            true => x.hypot(y) / self.unit_shear,
            false => 0.0,
        }
    }

    /// All that changes, for files.
    pub fn numbers(&self) -> Vec<f64> {
        let mut all = [&self.lift[..], &self.rate].concat();
        all.extend(self.shear.iter().chain(&self.transport).flatten());
        all.extend([self.fed, self.slid, self.lifted]);
        all
    }

    /// Takes the values of [`numbers`](Self::numbers); the rest of the numbers, or none if there are too few or
    /// impossible ones.
    pub fn put<'a>(&mut self, numbers: &'a [f64]) -> Option<&'a [f64]> {
        let (own, rest) = numbers.split_at_checked(6 * self.lift.len() + 3)?;
        if !own.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut own = own.iter().copied();
        let mut next = || own.next().unwrap_or_default();
        self.lift.fill_with(&mut next);
        self.rate.fill_with(&mut next);
        let vectors = self.shear.iter_mut().chain(&mut self.transport);
        vectors.for_each(|v| *v = [next(), next()]);
        [self.fed, self.slid, self.lifted] = [next(), next(), next()];
        Some(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(periodic: bool) -> LevelGrid {
        LevelGrid {
            lower: [1.0, -1.0],
            cell: [0.5, 0.25],
            count: [4, 3],
            periodic: [periodic, false],
        }
    }

    /// The mean is exact for bilinear levels, and the areas of the places integrate them.
    #[test]
    fn means_and_areas_are_exact_for_bilinear_levels() {
        let grid = grid(false);
        let f = |p: [f64; 2]| 0.3 + 2.0 * p[0] - p[1] + 0.7 * p[0] * p[1];
        let values: Vec<f64> = (0..grid.len()).map(|k| f(grid.position(k))).collect();
        for at in [[1.0, -1.0], [1.2, -0.8], [2.49, -0.5], [2.5, -0.6]] {
            assert!((grid.mean(&values, at) - f(at)).abs() < 1e-14, "{at:?}");
        }
        assert_eq!(grid.mean(&values, [9.0, 9.0]), values[11]);
        let integral: f64 = (0..grid.len()).map(|k| grid.area(k) * values[k]).sum();
        // Over [1, 2.5] × [−1, −0.5] at the middle (1.75, −0.75).
        assert!((integral - 0.75 * f([1.75, -0.75])).abs() < 1e-14);
    }

    #[test]
    fn periodic_grids_close() {
        let grid = grid(true);
        let values: Vec<f64> = (0..grid.len()).map(|k| grid.index(k)[0] as f64).collect();
        assert!((grid.mean(&values, [2.75, -1.0]) - 1.5).abs() < 1e-14);
        assert!((grid.mean(&values, [0.75, -1.0]) - 1.5).abs() < 1e-14);
        assert_eq!(grid.step(3, 0, 1), Some(0));
        assert_eq!(grid.step(8, 1, 1), None);
        let area: f64 = (0..grid.len()).map(|k| grid.area(k)).sum();
        assert!((area - 2.0 * 0.5).abs() < 1e-14);
    }

    fn bed() -> Bed {
        let grid = LevelGrid {
            lower: [0.0; 2],
            cell: [1.0; 2],
            count: [3, 1],
            periodic: [false; 2],
        };
        Bed {
            fade: 2.0,
            lift: vec![0.0, -0.2, 0.4],
            rate: vec![0.0, 0.1, -0.3],
            shear: vec![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]],
            fed: 7.0,
            lifted: 8.0,
            ..Bed::drawn(grid, vec![0.0, 0.5, 0.0])
        }
    }

    /// Points of the bed follow it, those at H above it stay, and the velocity of a point is the rate of its lift.
    #[test]
    fn walls_in_a_bed_stretch_up_to_a_height() {
        let now = bed();
        assert_eq!(now.lift_of(&[1.0, 0.5]), -0.2);
        assert_eq!(now.lift_of(&[1.0, 2.5]), 0.0);
        assert_eq!(now.lift_of(&[2.0, 1.0]), 0.2);
        let mut later = now.clone();
        let dt = 1e-6;
        (0..3).for_each(|k| later.lift[k] += dt * now.rate[k]);
        for drawn in [[1.0, 0.5], [1.3, 0.7], [1.8, 1.2], [2.0, 3.0]] {
            let present = [drawn[0], drawn[1] + now.lift_of(&drawn)];
            let rate = (later.lift_of(&drawn) - now.lift_of(&drawn)) / dt;
            assert!((now.rate_of(&present) - rate).abs() < 1e-9, "{drawn:?}");
        }
    }

    #[test]
    fn numbers_come_back() {
        let mut other = bed();
        other.lift = vec![0.0; 3];
        other.shear = vec![[0.0; 2]; 3];
        let numbers = [bed().numbers(), vec![1.0]].concat();
        assert_eq!(other.put(&numbers), Some(&[1.0][..]));
        assert_eq!(other, bed());
        assert_eq!(other.put(&numbers[..20]), None);
    }
}
