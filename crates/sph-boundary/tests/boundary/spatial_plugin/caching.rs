//! Geometry is found once for a state of particles and walls, and anew for every other state.

use sph_boundary::RigidMotion;
use sph_core::{Vect, fields};

use crate::bench::{Bench, Random, moving, wide};
use crate::spatial_plugin::shapes::{block, wall};

const SPACING: f64 = 0.4;
/// No γ is this.
const MARK: f64 = -7.0;

/// A block that begins to rise after one second, among particles.
fn bench() -> Bench<3> {
    let mut random = Random::new(9);
    let places = (0..800).map(|_| random.point(-2.5, 2.5));
    around(places.filter(|x: &Vect<3>| x.amax() > 1.0).collect())
}

fn around(places: Vec<Vect<3>>) -> Bench<3> {
    let motion = RigidMotion {
        start: 1.0,
        ..RigidMotion::steady([0.0, 0.0, 0.05])
    };
    let solid = block("block", [-0.8; 3], [0.8; 3]);
    Bench::new(
        "usaw",
        &[moving(wall(solid), motion)],
        SPACING,
        wide(),
        places,
    )
}

/// Element, gradient and distance of every contact.
fn contacts(bench: &Bench<3>) -> Vec<(u32, Vect<3>, f64)> {
    let all = bench.world.walls.contacts.all();
    all.map(|c| (c.element, c.gradient, c.distance)).collect()
}

/// Marks γ; whoever finds it anew wipes the marks off.
fn mark(bench: &mut Bench<3>) {
    let gamma = bench.world.free.get_mut(fields::RENORMALISATION).unwrap();
    gamma.fill(MARK);
}

#[test]
fn where_nothing_moved_gamma_and_contacts_are_not_touched() {
    let mut bench = bench();
    let before = contacts(&bench);
    assert!(before.len() > 1000);
    mark(&mut bench);
    bench.refresh();
    // The clock alone is no motion.
    bench.move_to(0.7);
    assert!(bench.gamma().iter().all(|g| *g == MARK));
    assert_eq!(contacts(&bench), before);
}

#[test]
fn one_particle_that_moves_by_a_millionth_refreshes_it() {
    let mut bench = bench();
    let (before, gamma) = (contacts(&bench), bench.gamma().to_vec());
    mark(&mut bench);
    let i = bench.at(Vect::from([1.1, 0.0, 0.0]));
    bench.world.free.get_mut(fields::POSITION).unwrap()[i][0] += 1e-6;
    bench.refresh();
    assert!(bench.gamma().iter().all(|g| *g != MARK));
    assert_ne!(contacts(&bench), before);
    let change = bench.gamma()[i] - gamma[i];
    let expected = 1e-6 * bench.gradient(i)[0];
    assert!(expected.abs() > 1e-9 && (change - expected).abs() < 1e-11);
    let others = bench.gamma().iter().zip(&gamma).enumerate();
    assert_eq!(others.filter(|(_, (a, b))| a != b).count(), 1);
}

#[test]
fn a_wall_that_moves_by_a_millionth_refreshes_it() {
    let mut bench = bench();
    let (before, gamma) = (contacts(&bench), bench.gamma().to_vec());
    mark(&mut bench);
    bench.move_to(1.0 + 2e-5);
    assert!(bench.gamma().iter().all(|g| *g != MARK));
    assert_ne!(contacts(&bench), before);
    let i = bench.at(Vect::from([0.0, 0.0, 1.1]));
    let (change, expected) = (bench.gamma()[i] - gamma[i], -1e-6 * bench.gradient(i)[2]);
    assert!(expected.abs() > 1e-9 && (change - expected).abs() < 1e-11);
    // And rests again where the wall does.
    mark(&mut bench);
    bench.refresh();
    assert!(bench.gamma().iter().all(|g| *g == MARK));
}

#[test]
fn a_particle_out_of_reach_may_fly_without_anything_being_found_anew() {
    let mut bench = bench();
    let far = bench.at(Vect::repeat(2.5));
    let start = bench.positions()[far];
    assert!((start - Vect::repeat(0.8)).norm() > 2.0);
    mark(&mut bench);
    bench.world.free.get_mut(fields::POSITION).unwrap()[far][0] += 1e-3;
    bench.refresh();
    assert!(bench.gamma().iter().all(|g| *g == MARK));
}

/// A particle by the bits of its place, γ and its contacts.
type Known = ([u64; 3], f64, Vec<(u32, Vect<3>, f64)>);

fn known(bench: &Bench<3>) -> Vec<Known> {
    let of_particle = |(i, x): (usize, &Vect<3>)| {
        let contacts = bench.world.walls.contacts.of_particle(i).iter();
        let contacts = contacts.map(|c| (c.element, c.gradient, c.distance));
        let place = [0, 1, 2].map(|k| f64::to_bits(x[k]));
        (place, bench.gamma()[i], contacts.collect())
    };
    let particles = bench.positions().iter().enumerate();
    let mut known: Vec<Known> = particles.map(of_particle).collect();
    known.sort_by_key(|(place, ..)| *place);
    known
}

/// Particles go by nearly half a skin of 0.16 m, the wall by as much, forth and, after the lists are built anew there, back.
#[test]
fn lists_of_before_the_walls_moved_miss_nothing() {
    let mut bench = bench();
    let mut random = Random::new(4);
    for time in [2.5, 1.0] {
        let builds = bench.world.lists.builds;
        for x in bench.world.free.get_mut(fields::POSITION).unwrap() {
            let way = random.point::<3>(-1.0, 1.0);
            *x += way * (0.075 / way.norm().max(1.0));
        }
        bench.move_to(time);
        assert_eq!(bench.world.lists.builds, builds, "the lists stood");
        let found = known(&bench);
        bench.world.rebuild_lists().unwrap();
        bench.refresh();
        assert_eq!(bench.world.lists.builds, builds + 1);
        let (mut contacts, mut worst) = (0, 0.0_f64);
        for (old, new) in found.iter().zip(&known(&bench)) {
            assert_eq!(old.0, new.0);
            assert_eq!(old.2, new.2, "γ {} or {}", old.1, new.1);
            worst = worst.max((old.1 - new.1).abs());
            contacts += new.2.len();
        }
        println!("t = {time}: {contacts} contacts, γ to {worst:.1e}");
        assert!(contacts > 1000 && worst < 1e-15, "{contacts} {worst:e}");
    }
}

/// Lists are built anew again and again while particles stray, at most half a skin at a time, and the block rises past
/// them: rows that were kept give the bits of walls that have just been built.
#[test]
fn rows_that_are_kept_give_what_new_ones_would() {
    let mut bench = bench();
    let mut random = Random::new(21);
    let (mut contacts, mut sorted) = (0, 0);
    for step in 1..=24 {
        for x in bench.world.free.get_mut(fields::POSITION).unwrap() {
            let way = random.point::<3>(-1.0, 1.0);
            let moved = *x + way * (0.075 / way.norm().max(1.0));
            if moved.amax() > 1.0 {
                *x = moved;
            }
        }
        let before = bench.world.free.get(fields::IDENTITY).unwrap().to_vec();
        bench.world.rebuild_lists().unwrap();
        sorted += usize::from(*bench.world.free.get(fields::IDENTITY).unwrap() != before);
        let time = 1.0 + f64::from(step);
        bench.move_to(time);
        let mut new = around(bench.positions().to_vec());
        new.move_to(time);
        for (kept, new) in known(&bench).iter().zip(&known(&new)) {
            assert_eq!(kept, new);
            contacts += new.2.len();
        }
    }
    println!("{contacts} contacts in all, sorted {sorted} times");
    assert!(contacts > 24_000 && sorted > 10, "{contacts} {sorted}");
}
