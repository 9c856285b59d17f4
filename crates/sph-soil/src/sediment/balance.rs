//! The balance of the grains of a bed: Exner's equation, and slides.

use sph_core::bed::Bed;

/// Packing of the grains of a bed, and its angle of repose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Packing {
    /// Porosity n of the bed.
    pub porosity: f64,
    /// tan φ of the angle of repose.
    pub repose: f64,
    /// Time in which what is steeper slides, s.
    pub slide_time: f64,
}

/// Rates and volumes of a step of a bed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balance {
    /// Rates of the levels, m/s.
    pub rate: Vec<f64>,
    /// Volume of grains that the places with held levels have given to the others, less what came back, over the step, m³ (m² in
    /// two dimensions), without pores.
    pub fed: f64,
    /// Volume of grains that slid.
    pub slid: f64,
}

struct Way {
    from: usize,
    to: usize,
    /// Length of the way, m.
    length: f64,
    /// Width of the border that it crosses, m; 1 in two dimensions.
    width: f64,
    along: [f64; 2],
}

/// (1 − n) ∂z/∂t = −∇·q over a step, with slides where the bed is steeper than it can stand.
///
/// Across the border of two places goes max(q_a, 0) + min(q_b, 0) of the fluxes along the way: what each sends to the other. A
/// place gives no more grains than it has. Of what is steeper than the angle of repose, a share min(1, Δt/T) slides, also
/// along the diagonals of the grid. Each way takes from one place what it gives to the other: the volume of the grains stays.
///
/// `flux` is the volume of grains without pores per width and time at the places, m²/s.
///
/// Source: Exner 1925; slides by exchange of volume are ours.
pub fn balance(bed: &Bed, flux: &[[f64; 2]], packing: &Packing, dt: f64) -> Balance {
    let solid = 1.0 - packing.porosity;
    let ways = ways(bed);
    let sent = |way: &Way| {
        let along = |place: usize| flux[place][0] * way.along[0] + flux[place][1] * way.along[1];
        let (there, back) = (along(way.from).max(0.0), along(way.to).min(0.0));
        [there * way.width * dt, -back * way.width * dt]
    };
    let straight = || ways.iter().filter(|way| way.width > 0.0);
    let mut leaving = vec![0.0; flux.len()];
    for way in straight() {
        let [there, back] = sent(way);
        leaving[way.from] += there;
        leaving[way.to] += back;
    }
    // Volume of the grains over the rock.
    let stock = |place: usize| {
        let depth = (bed.level(place) - bed.rock).max(0.0);
        (depth * solid * bed.grid.area(place), bed.held[place])
    };
    let share = |place: usize| match stock(place) {
        (stock, false) if leaving[place] > stock => stock / leaving[place],
        _ => 1.0,
    };
    let mut change = vec![0.0; flux.len()];
    for way in straight() {
        let [there, back] = sent(way);
        let net = there * share(way.from) - back * share(way.to);
        change[way.from] -= net;
        change[way.to] += net;
    }
    let slid = slide(bed, &ways, packing, dt, &mut change);
    let mut fed = 0.0;
    let mut rate = vec![0.0; flux.len()];
    for place in 0..flux.len() {
        match bed.held[place] {
            true => fed -= change[place],
            false => rate[place] = change[place] / (solid * bed.grid.area(place) * dt),
        }
    }
    Balance { rate, fed, slid }
}

/// Lets what is too steep slide, on top of the changes of volume so far; the volume that slid.
fn slide(bed: &Bed, ways: &[Way], packing: &Packing, dt: f64, change: &mut [f64]) -> f64 {
    let solid = 1.0 - packing.porosity;
    let part = (dt / packing.slide_time).min(1.0);
    let area = |place: usize| solid * bed.grid.area(place);
    let mut slid = 0.0;
    for way in ways {
        let level = |place: usize| bed.level(place) + change[place] / area(place);
        let (a, b) = (level(way.from), level(way.to));
        let excess = (a - b).abs() - packing.repose * way.length;
        if excess <= 0.0 {
            continue;
        }
        let inverse = |place: usize| match bed.held[place] {
            true => 0.0,
            false => 1.0 / area(place),
        };
        let (upper, lower, top) = match a > b {
            true => (way.from, way.to, a),
            false => (way.to, way.from, b),
        };
        let both = inverse(upper) + inverse(lower);
        if both == 0.0 {
            continue;
        }
        // Half of what would do for both: a place slides along several ways in one step.
        let mut volume = 0.5 * part * excess / both;
        if !bed.held[upper] {
            volume = volume.min((top - bed.rock).max(0.0) * area(upper));
        }
        change[upper] -= volume;
        change[lower] += volume;
        slid += volume;
    }
    slid
}

/// All ways between places of which grains move; those along diagonals have no width.
fn ways(bed: &Bed) -> Vec<Way> {
    let grid = &bed.grid;
    let mut ways = Vec::new();
    let mut push = |from: Option<usize>, to: Option<usize>, steps: [f64; 2]| {
        let moves = |place: &usize| !bed.covered[*place];
        let (Some(from), Some(to)) = (from.filter(moves), to.filter(moves)) else {
            return;
        };
        if from == to {
            return;
        }
        let way = [0, 1].map(|k| steps[k] * grid.cell[k]);
        let length = way[0].hypot(way[1]);
        // The part of the border that both places have.
        let common = |axis: usize| grid.side(from, axis).min(grid.side(to, axis));
        let width = match steps {
            [_, 0.0] => common(1),
            [0.0, _] => common(0),
            _ => 0.0,
        };
        let along = way.map(|x| x / length);
        ways.push(Way {
            from,
            to,
            length,
            width,
            along,
        });
    };
    for place in 0..grid.len() {
        let next = [0, 1].map(|axis| grid.step(place, axis, 1).filter(|_| grid.count[axis] > 1));
        push(Some(place), next[0], [1.0, 0.0]);
        push(Some(place), next[1], [0.0, 1.0]);
        if let [Some(right), Some(up)] = next {
            push(Some(place), grid.step(right, 1, 1), [1.0, 1.0]);
            push(Some(right), Some(up), [-1.0, 1.0]);
        }
    }
    ways
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::bed::LevelGrid;

    const SAND: Packing = Packing {
        porosity: 0.4,
        repose: 0.6,
        slide_time: 1e-3,
    };

    fn bed(count: [usize; 2], periodic: bool, level: impl Fn([f64; 2]) -> f64) -> Bed {
        let grid = LevelGrid {
            lower: [0.0; 2],
            cell: [0.1, if count[1] > 1 { 0.1 } else { 1.0 }],
            count,
            periodic: [periodic, false],
        };
        let levels = (0..grid.len()).map(|k| level(grid.position(k))).collect();
        Bed::drawn(grid, levels)
    }

    /// Volume of the grains, without pores.
    fn volume(bed: &Bed) -> f64 {
        let all = (0..bed.grid.len()).filter(|k| !bed.covered[*k]);
        0.6 * all.map(|k| bed.level(k) * bed.grid.area(k)).sum::<f64>()
    }

    fn step(bed: &mut Bed, flux: &[[f64; 2]], dt: f64) -> Balance {
        let step = balance(bed, flux, &SAND, dt);
        for (lift, rate) in bed.lift.iter_mut().zip(&step.rate) {
            *lift += dt * rate;
        }
        step
    }

    #[test]
    fn the_volume_of_the_grains_stays() {
        let mut sand = bed([12, 7], false, |x| 0.1 * (9.0 * x[0]).sin() - x[1]);
        sand.covered[40] = true;
        let before = volume(&sand);
        let flux: Vec<_> = (0..84)
            .map(|k| [(k as f64).sin() * 1e-3, (0.3 * k as f64).cos() * 1e-3])
            .collect();
        for _ in 0..50 {
            let step = step(&mut sand, &flux, 1e-3);
            assert_eq!(step.fed, 0.0);
            assert_eq!(step.rate[40], 0.0);
        }
        assert!((volume(&sand) / before - 1.0).abs() < 1e-13);
    }

    /// Held places feed the others with what they lack, and the books agree.
    #[test]
    fn held_places_feed_the_bed() {
        let mut sand = bed([20, 1], false, |_| 0.0);
        (sand.held[0], sand.held[19]) = (true, true);
        let flux: Vec<_> = (0..20).map(|k| [1e-4 * k as f64, 0.0]).collect();
        let before = volume(&sand);
        let mut fed = 0.0;
        for _ in 0..10 {
            fed += step(&mut sand, &flux, 1e-2).fed;
        }
        let grown = volume(&sand) - before;
        // What comes in at the first place, less what goes out at the last but one.
        let error = (grown - 0.1 * (0.0 - 1e-4 * 18.0)).abs();
        assert!(error < 1e-15, "{grown:e}");
        assert!((fed - grown).abs() < 1e-15);
    }

    /// q = q₀ + c z on a periodic bed moves a wave with c/(1 − n): upwind differences multiply it by 1 − C (1 − e^(−ikΔx)) in
    /// each step, C the Courant number.
    #[test]
    fn a_small_wave_moves_with_the_slope_of_the_flux() {
        let (c, dt, steps) = (0.01, 0.6, 500);
        let k = std::f64::consts::TAU / 4.0;
        let mut sand = bed([40, 1], true, |x| 1e-3 * (k * x[0]).sin());
        for _ in 0..steps {
            let flux: Vec<_> = (0..40).map(|p| [0.01 + c * sand.level(p), 0.0]).collect();
            step(&mut sand, &flux, dt);
        }
        let courant = c / 0.6 * dt / 0.1;
        let real = 1.0 - courant * (1.0 - (k * 0.1).cos());
        let imaginary = -courant * (k * 0.1).sin();
        let size = real.hypot(imaginary).powi(steps);
        let turned = imaginary.atan2(real) * f64::from(steps);
        assert!((turned + k * c / 0.6 * dt * f64::from(steps)).abs() < 0.03);
        for place in 0..40 {
            let exact = 1e-3 * size * (k * sand.grid.position(place)[0] + turned).sin();
            assert!((sand.level(place) - exact).abs() < 1e-14, "{place}");
        }
    }

    /// A heap too steep becomes one at the angle of repose, along diagonals too, and no steeper.
    #[test]
    fn heaps_slide_to_the_angle_of_repose() {
        let mut sand = bed([21, 21], false, |x| {
            let away = (x[0] - 1.0).hypot(x[1] - 1.0);
            (0.6 - 2.0 * away).max(0.0)
        });
        let (before, flux) = (volume(&sand), vec![[0.0; 2]; 441]);
        let mut last = 0.0;
        for _ in 0..4000 {
            last = step(&mut sand, &flux, 1e-3).slid;
        }
        assert!(last < 1e-9, "{last:e}");
        assert!((volume(&sand) / before - 1.0).abs() < 1e-13);
        let steepest = ways(&sand).iter().fold(0.0, |most: f64, way| {
            let rise = (sand.level(way.from) - sand.level(way.to)).abs();
            most.max(rise / way.length)
        });
        assert!(steepest < 0.6 + 1e-4, "{steepest}");
    }

    #[test]
    fn no_place_gives_more_than_it_has() {
        let mut sand = bed([10, 1], false, |x| if x[0] < 0.45 { 0.02 } else { 0.0 });
        sand.rock = 0.0;
        let before = volume(&sand);
        for _ in 0..200 {
            step(&mut sand, &[[5e-3, 0.0]; 10], 0.05);
        }
        assert!((0..10).all(|k| sand.level(k) >= -1e-15));
        assert!((volume(&sand) - before).abs() < 1e-16);
        assert!(sand.level(0) < 1e-15 && sand.level(9) > 0.0);
    }
}
