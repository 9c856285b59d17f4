//! The same bits on any number of threads, and after a resumption.

use dem_pfv::grains::{
    ContactLaw, Control, Grain, GrainSystem, HertzMindlin, LinearElastic, Mesh, RollingResistance,
    Setup, State, Wall,
};

use crate::assert_same_on_threads;
use crate::grains::{RADIUS, kilogram, run};

fn laws() -> Vec<Box<dyn ContactLaw>> {
    let rolling = Some(RollingResistance {
        coefficient: 0.1,
        stiffness: 1.0,
    });
    let grains = HertzMindlin {
        damping: 0.1,
        rolling,
        ..HertzMindlin::new(1e7, 0.3, 0.4)
    };
    let walls = LinearElastic {
        damping: 0.1,
        rolling,
        ..LinearElastic::new(1e6, 0.5, 0.4)
    };
    vec![Box::new(grains), Box::new(walls)]
}

/// 1440 grains fall on a mesh between walls, one of them pressed, in a box that is periodic along y.
fn heap() -> GrainSystem {
    let grains = (0..1440).map(|i| {
        let at = |k: i32, n: i32| f64::from(i / k % n) * 2.02 * RADIUS + 1.01 * RADIUS;
        let jitter = 1e-3 * RADIUS * f64::from(i * 7919 % 17);
        let place = [at(1, 12) + jitter, at(12, 12), at(144, 10) + 0.02 * RADIUS];
        Grain::new(place, RADIUS, kilogram()).moving([0.3, -0.2, -0.5])
    });
    let side = 12.0 * 2.02 * RADIUS + 0.1 * RADIUS;
    let corners = [(-1.0, -1.0), (4.0, -1.0), (4.0, 4.0), (-1.0, 4.0)];
    let corners = corners.map(|(x, y)| [x, y, 0.0]).to_vec();
    let mut floor = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]);
    floor.law = 1;
    floor.spin.z = 0.1;
    let mut walls = [(0.0, 1.0), (side, -1.0)]
        .map(|(x, normal)| Wall::new([x, 0.0, 0.0], [normal, 0.0, 0.0]).with_law(1));
    walls[1].area = Some(side * side);
    walls[1].control = Control::Stress {
        stress: 100.0,
        largest_speed: 0.1,
    };
    let setup = Setup {
        grains: grains.collect(),
        laws: laws(),
        ..Setup::default()
    };
    let setup = setup.walls(walls).mesh(floor).damping(0.05);
    let setup = setup.periodic(1, 0.0, 12.0 * 2.02 * RADIUS);
    GrainSystem::new(setup.gravity([0.0, 0.0, -9.81])).expect("a heap")
}

fn bits(system: &GrainSystem) -> Vec<u64> {
    let g = &system.grains;
    let columns = [&g.position, &g.velocity, &g.spin, &g.contact_force];
    let vectors = columns.into_iter().flatten().flatten();
    let turns = g.orientation.iter().flatten();
    let walls = system.walls.iter().flat_map(|w| &w.point);
    let all = vectors.chain(turns).chain(walls);
    all.map(|x| x.to_bits()).collect()
}

const STEP: f64 = 5e-4;

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    assert_same_on_threads(|| {
        let mut system = heap();
        run(&mut system, STEP, 300);
        assert!(system.contacts().count() > 1000 && system.renewals > 2);
        bits(&system)
    });
}

#[test]
fn a_resumed_run_goes_on_to_the_same_bits() {
    let mut whole = heap();
    run(&mut whole, STEP, 300);
    let mut first = heap();
    run(&mut first, STEP, 157);
    let text = serde_json::to_string(&first.save()).expect("saved");
    drop(first);
    let state: State = serde_json::from_str(&text).expect("read");
    let mut second = GrainSystem::resume(state, laws()).expect("resumed");
    assert_eq!(second.steps, 157);
    run(&mut second, STEP, 143);
    assert_eq!(second.time, whole.time);
    assert_eq!(bits(&second), bits(&whole));
}

/// How long lists live changes no bit either: only what touches counts.
#[test]
fn the_skin_changes_no_bit() {
    let run_with = |skin: f64| {
        let grains = (0..216).map(|i| {
            let at = |k: i32| f64::from(i / k % 6) * 2.02 * RADIUS + 1.01 * RADIUS;
            let swirl = [at(6) - 0.6, 0.6 - at(1), 0.3 * f64::from(i % 3)];
            Grain::new([at(1), at(6), at(36)], RADIUS, kilogram()).moving(swirl)
        });
        let mut setup = Setup::new(grains.collect(), LinearElastic::new(1e6, 0.5, 0.4));
        setup.skin = Some(skin);
        let walls = Wall::cuboid([-0.1; 3], [1.4; 3]);
        let mut system = GrainSystem::new(setup.walls(walls)).expect("a cloud");
        run(&mut system, 5e-4, 1000);
        (bits(&system), system.renewals)
    };
    let (thin, often) = run_with(0.05 * RADIUS);
    let (thick, rarely) = run_with(RADIUS);
    assert!(often > rarely, "{often} {rarely}");
    assert_eq!(thin, thick);
}
