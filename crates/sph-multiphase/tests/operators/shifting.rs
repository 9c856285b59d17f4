//! Shifting: nothing to do on a lattice, at rest and across surfaces; evens out the rest.

use sph_contribution::Offer;
use sph_core::{Role, Vect, fields};
use sph_multiphase::diffusion::{Fickian, Transport};
use sph_multiphase::{Formulation, HuAdams};
use sph_neighbours::World;

use crate::channel::{Channel, SPACING};
use crate::evaluate::{laws, offered, rates};
use crate::world::{
    Random, disorder, lattice, longest, open, periodic, set, set_phase, set_velocity, world,
};

/// The speed of sound of every phase, m/s.
const SOUND: f64 = 20.0;

/// The offer of a shifting scheme where densities are sums or not.
fn offer<const D: usize>(world: &World<D>, mut shifting: Fickian, summed: bool) -> Offer<D> {
    let laws = laws(&[(1.0, SOUND), (1.0, SOUND)]);
    offered(&mut shifting, (&laws, summed), world)
}

fn shift<const D: usize>(world: &mut World<D>, shifting: Fickian) -> Vec<Vect<D>> {
    world.free.add(fields::SHIFT_VELOCITY, Role::State);
    world.free.add(fields::VOID_FRACTION, Role::Derived);
    // So short that the bound of an explicit diffusion does not count.
    world.dt = 1e-4;
    for mut stage in offer(world, shifting, true).stages {
        stage.run(world).unwrap();
    }
    world.free.get(fields::SHIFT_VELOCITY).unwrap().to_vec()
}

/// Moves particles with their shifts for so many seconds.
fn shift_by(world: &mut World<2>, shifts: &[Vect<2>], dt: f64) {
    let positions = world.free.get_mut(fields::POSITION).unwrap().iter_mut();
    positions.zip(shifts).for_each(|(x, s)| *x += s * dt);
}

fn stir<const D: usize>(world: &mut World<D>) {
    let along = |y: f64| (std::f64::consts::TAU * y).sin();
    set_velocity(world, |x| {
        Vect::from_fn(|k, _| if k == 0 { along(x[1]) } else { 0.0 })
    });
}

#[test]
fn a_lattice_stays_as_it_is() {
    fn check<const D: usize>(n: usize, ratio: f64) {
        let mut still = world(lattice::<D>(n), periodic(), 1.0 / n as f64, ratio);
        stir(&mut still);
        // Terms of 1/h that cancel to rounding.
        let found = longest(&shift(&mut still, Fickian::default()));
        assert!(found < 1e-12, "{D}D: {found:e}");
    }
    check::<2>(20, 2.0);
    check::<3>(10, 1.3);
}

#[test]
fn at_rest_and_in_a_uniform_wind_nothing_is_shifted() {
    let mut cloud = world(disorder::<2>(20, 0.3, 1), periodic(), 0.05, 2.0);
    assert_eq!(longest(&shift(&mut cloud, Fickian::default())), 0.0);
    set_velocity(&mut cloud, |_| Vect::<2>::new(3.1, -0.7));
    assert_eq!(longest(&shift(&mut cloud, Fickian::default())), 0.0);
    stir(&mut cloud);
    let shifts = shift(&mut cloud, Fickian::default());
    let most = Fickian::default().limit;
    assert!(longest(&shifts) > 0.0);
    // U is the largest speed against the mean, which is not quite 0 in disorder.
    assert!(longest(&shifts) <= most * 1.01, "{}", longest(&shifts));
}

/// Root mean square of the gradient of the concentration, from the shift without limits.
#[test]
fn disorder_is_evened_out() {
    let mut cloud = world(disorder::<2>(20, 0.2, 1), periodic(), 0.05, 2.0);
    stir(&mut cloud);
    let unevenness = |shifts: &[Vect<2>]| shifts.iter().map(|s| s.norm_squared()).sum::<f64>();
    let shifting = Fickian {
        tensile: 0.0,
        ..Fickian::default()
    };
    let before = unevenness(&shift(&mut cloud, shifting));
    let mut after = before;
    for _ in 0..40 {
        let shifts = shift(&mut cloud, shifting);
        after = unevenness(&shifts);
        // A step of δr/20 at U = 1.
        shift_by(&mut cloud, &shifts, 0.0025);
        cloud.refresh_lists().unwrap();
        stir(&mut cloud);
    }
    assert!(after < 0.03 * before, "{after} of {before}");
}

/// A patch with free sides: its outer rows keep their distance from them, its corners stay.
#[test]
fn at_a_free_surface_nothing_leaves_along_the_normal() {
    let n = 16;
    for ratio in [1.3, 2.0, 3.0] {
        let mut patch = world(lattice::<2>(n), open(), 1.0 / n as f64, ratio);
        // A turn as a whole.
        set_velocity(&mut patch, |x| Vect::<2>::new(0.5 - x[1], x[0] - 0.5));
        let shifts = shift(&mut patch, Fickian::default());
        let positions = patch.free.get(fields::POSITION).unwrap();
        let reach = (2.0 * ratio).ceil() / n as f64;
        for (x, s) in positions.iter().zip(&shifts) {
            let corner = (0..2).all(|k| (x[k] - 0.5).abs() > 0.5 - 2.0 * reach);
            let depth = (0..2).map(|k| 0.5 - (x[k] - 0.5).abs()).fold(1.0, f64::min);
            // Along a side all rows are the same; the rows below it do not rise either.
            if !corner {
                assert!(s.norm() < 1e-12, "h/δr = {ratio}: {s} at {x}");
            }
            if corner && depth < 1.0 / n as f64 {
                // Outward is what would lose the surface.
                let outward = s.dot(&(x - Vect::repeat(0.5)).normalize());
                assert!(outward < 0.1, "h/δr = {ratio}: {outward} at {x}");
            }
        }
    }
}

#[test]
fn a_disordered_round_patch_keeps_its_rim() {
    let n = 30;
    let middle = Vect::<2>::repeat(0.5);
    let places = disorder::<2>(n, 0.2, 7).into_iter();
    let round = places.filter(|x| (x - middle).norm() < 0.4).collect();
    let mut patch = world(round, open(), 1.0 / n as f64, 2.0);
    set_velocity(&mut patch, |x| Vect::<2>::new(0.5 - x[1], x[0] - 0.5));
    let shifts = shift(&mut patch, Fickian::default());
    let without = Fickian {
        surface: 0.0,
        ..Fickian::default()
    };
    let loose = shift(&mut patch, without);
    let positions = patch.free.get(fields::POSITION).unwrap();
    let rim = |shifts: &[Vect<2>]| {
        let all = positions.iter().zip(shifts);
        let outward = all.filter(|(x, _)| (*x - middle).norm() > 0.4 - 1.0 / n as f64);
        let outward = outward.map(|(x, s)| s.dot(&(x - middle).normalize()));
        let (sum, count) = outward.fold((0.0, 0), |(sum, k), s| (sum + s, k + 1));
        sum / count as f64
    };
    // Measured: the normals of a ragged rim differ from the radius.
    let [kept, loose] = [rim(&shifts), rim(&loose)];
    assert!(kept.abs() < 0.02 * loose, "{kept} of {loose}");
}

#[test]
fn a_lone_row_and_a_lone_particle_stay() {
    let row = (0..10).map(|k| Vect::<2>::new(0.05 * k as f64, 0.0));
    let both = row.chain([Vect::<2>::new(3.0, 3.0)]).collect();
    let mut row = world(both, open(), 0.05, 2.0);
    let mut random = Random::new(1);
    set_velocity(&mut row, |_| Vect::<2>::new(random.next(), random.next()));
    let shifts = shift(&mut row, Fickian::default());
    assert!(shifts.iter().all(|s| s.norm() < 1e-12), "{shifts:?}");
}

/// Air blows over water at rest: the water is not shifted by the speed of the air, and does not take it up.
#[test]
fn a_phase_at_rest_is_not_stirred_by_another() {
    let mut layers = world(disorder::<2>(20, 0.2, 3), periodic(), 0.05, 2.0);
    set_phase(&mut layers, |x| u32::from(x[1] < 0.5));
    // Without a mean: the mean is what a speed is measured against.
    let mut sign = 1.0;
    set_velocity(&mut layers, |x| {
        sign = if x[1] < 0.5 { sign } else { -sign };
        Vect::<2>::new(if x[1] < 0.5 { 0.0 } else { sign }, 0.0)
    });
    let shifting = Fickian::default();
    let shifts = shift(&mut layers, shifting);
    let (acceleration, _) = rates(&layers, &offer(&layers, shifting, true).terms);
    let positions = layers.free.get(fields::POSITION).unwrap();
    let of = |below: bool, all: &[Vect<2>]| {
        let some = positions.iter().zip(all);
        let some = some.filter(|(x, _)| (x[1] < 0.5) == below);
        some.map(|(_, v)| v.norm()).fold(0.0, f64::max)
    };
    assert!(of(false, &shifts) > 0.01 && of(false, &acceleration) > 0.1);
    assert!(of(true, &shifts) < 1e-12, "{:e}", of(true, &shifts));
    assert_eq!(of(true, &acceleration), 0.0);
}

#[test]
fn across_an_interface_nothing_is_shifted() {
    let n = 20;
    let mut layers = world(disorder::<2>(n, 0.2, 3), periodic(), 0.05, 2.0);
    stir(&mut layers);
    set_phase(&mut layers, |x| u32::from(x[1] < 0.5));
    let shifts = shift(&mut layers, Fickian::default());
    let positions = layers.free.get(fields::POSITION).unwrap();
    let near = || {
        let all = positions.iter().zip(&shifts);
        all.filter(|(x, _)| (x[1] - 0.5).abs() < 0.05)
    };
    let across: f64 = near().map(|(_, s)| s[1].abs()).sum();
    let along: f64 = near().map(|(_, s)| s[0].abs()).sum();
    // Measured: disorder tilts the normals.
    assert!(across < 0.25 * along, "{across} of {along}");
}

/// ρ = (K + mΣw)/γ after a small shift with K̇: the error is of second order.
#[test]
fn a_summed_density_does_not_notice_the_shift() {
    let errors = [1e-3, 5e-4].map(|step| {
        let mut cloud = world(disorder::<2>(20, 0.3, 1), periodic(), 0.05, 2.0);
        stir(&mut cloud);
        let formulation = HuAdams::default();
        Formulation::<2>::rebase(&formulation, &mut cloud).unwrap();
        // Without the way back, which is not of the shift's making.
        let shifting = Fickian {
            relaxation: 0.0,
            ..Fickian::default()
        };
        let shifts = shift(&mut cloud, shifting);
        let rate = rates(&cloud, &offer(&cloud, shifting, true).terms).1;
        let constant = cloud.free.get_mut(fields::DENSITY_CONSTANT).unwrap();
        let both = constant.iter_mut().zip(&rate);
        both.for_each(|(k, r)| *k += step * r);
        shift_by(&mut cloud, &shifts, step);
        cloud.lists.pruned = None;
        for mut stage in Formulation::<2>::stages(&formulation) {
            stage.run(&mut cloud).unwrap();
        }
        let density = cloud.free.get(fields::DENSITY).unwrap().iter();
        density.map(|rho| (rho - 1.0).abs()).fold(0.0, f64::max)
    });
    let second_order = (errors[0] / errors[1] - 4.0).abs() < 0.3;
    assert!(errors[0] < 1e-3 && second_order, "{errors:?}");
}

#[test]
fn carried_columns_follow_the_fluid() {
    let mut cloud = world(disorder::<2>(20, 0.1, 1), open(), 0.05, 2.0);
    set_velocity(&mut cloud, |x| Vect::<2>::new(3.0 * x[1], x[0]));
    set(&mut cloud, fields::DENSITY, |x| 1000.0 + 2.0 * x[1]);
    let shifting = Fickian {
        relaxation: 0.0,
        ..Fickian::default()
    };
    let shifts = shift(&mut cloud, shifting);
    // Integrated densities: s·∇ρ alone.
    let (acceleration, rate) = rates(&cloud, &offer(&cloud, shifting, false).terms);
    let positions = cloud.free.get(fields::POSITION).unwrap();
    let inner =
        (0..positions.len()).filter(|i| (0..2).all(|k| (positions[*i][k] - 0.5).abs() < 0.25));
    let (mut size, mut error) = (0.0, 0.0);
    for i in inner {
        let s = shifts[i];
        let exact = [3.0 * s[1], s[0], 2.0 * s[1]];
        let found = [acceleration[i][0], acceleration[i][1], rate[i]];
        for (f, e) in found.iter().zip(exact) {
            size += e * e;
            error += (f - e) * (f - e);
        }
    }
    // Plain gradients of linear fields in 10 % disorder.
    assert!(size > 0.0 && error < 0.01 * size, "{error} of {size}");
    let asked = |transport| {
        let fickian = Fickian {
            transport,
            ..shifting
        };
        !offer(&cloud, fickian, true).terms.is_empty()
    };
    assert!(!asked(Transport::Nothing) && asked(Transport::All));
}

/// No density is taken up within reach of points that stand, and ρc² would make a pressure of every shift there.
#[test]
fn within_reach_of_wall_points_nothing_is_shifted() {
    let mut channel = Channel::closed(16);
    set(&mut channel.world, fields::VOLUME, |x| {
        SPACING * SPACING * (1.0 + 0.1 * x[1].sin())
    });
    set_velocity(&mut channel.world, |x| Vect::<2>::new(x[1], 0.0));
    let shifts = shift(&mut channel.world, Fickian::default());
    let (mut beside, mut inside) = (0, 0);
    for (i, shift) in shifts.iter().enumerate() {
        match channel.world.lists.wall.candidates(i).is_empty() {
            true => inside += usize::from(shift.norm() > 0.0),
            false => {
                beside += 1;
                assert_eq!(*shift, Vect::<2>::zeros());
            }
        }
    }
    assert!(beside > 0 && inside > 0, "{beside} and {inside}");
}

/// Beside a wall, too, a concentration that is c times as high has a gradient c times as large: an even arrangement of
/// any concentration is left alone. (With 1 for C at the wall, what is thin is pulled away from it.)
#[test]
fn beside_walls_the_shift_is_linear_in_the_concentration() {
    let shifting = Fickian {
        strength: 1e-3,
        tensile: 0.0,
        surface: 0.0,
        ..Fickian::default()
    };
    let with_volume = |share: f64| {
        let mut channel = Channel::closed(9);
        let cell = SPACING * SPACING;
        set(&mut channel.world, fields::VOLUME, |_| share * cell);
        channel.world.walls.points.volume.fill(share * cell);
        channel.world.walls.points.corners = channel.world.walls.points.position.len();
        set_velocity(&mut channel.world, |x| Vect::<2>::new(x[1], 0.0));
        shift(&mut channel.world, shifting)
    };
    let (full, thin) = (with_volume(1.0), with_volume(0.8));
    assert!(longest(&full) > 1e-6, "{:e}", longest(&full));
    for (full, thin) in full.iter().zip(&thin) {
        let apart = (full * 0.8 - thin).norm();
        assert!(apart < 1e-12 * SOUND, "{apart:e}");
    }
}

/// The density comes back to that of the arrangement as fast as this is rearranged: not at all in a rigid rotation.
#[test]
fn a_density_comes_back_where_particles_are_rearranged() {
    let back = |turn: bool| {
        let mut cloud = world(disorder::<2>(20, 0.2, 1), periodic(), 0.05, 2.0);
        let sense = if turn { -1.0 } else { 1.0 };
        set_velocity(&mut cloud, |x| Vect::<2>::new(sense * x[1], x[0]));
        cloud.free.add(fields::SHIFT_VELOCITY, Role::State);
        cloud.free.add(fields::VOID_FRACTION, Role::Derived);
        set(&mut cloud, fields::VOID_FRACTION, |_| 0.01);
        let rates = rates(&cloud, &offer(&cloud, Fickian::default(), true).terms).1;
        let positions = cloud.free.get(fields::POSITION).unwrap();
        let inner = |x: &Vect<2>| (0..2).all(|k| (x[k] - 0.5).abs() < 0.3);
        let inner = positions.iter().zip(rates).filter(|(x, _)| inner(x));
        inner.map(|(_, r)| r).collect::<Vec<_>>()
    };
    // Away from the edges, across which the velocity jumps.
    assert!(back(true).iter().all(|r| r.abs() < 1e-12));
    assert!(back(false).iter().all(|r| *r < 0.0));
}
