//! Shear and lubrication between neighbours (6.29, 6.30): values, what is conserved, and the step.

use std::f64::consts::PI;

use dem_pfv::coupled::{CoupledSystem, FlowSetup, Fluid, Lubrication, Vector, WallBoundary};
use dem_pfv::grains::{Grain, GrainSystem};

use crate::coupled::{boxed, packed, packing, sticking};
use crate::{BOX200, assert_says};

const VISCOSITY: f64 = 3.0;
const LUBRICATION: Lubrication = Lubrication {
    roughness: 0.01,
    range: 4.0,
};

/// Numbers in −½ to ½ that follow no pattern of a packing.
fn noise(i: usize, salt: u32) -> f64 {
    f64::from(((i + 1) as u32).wrapping_mul(salt) >> 12) / f64::from(1 << 20) - 0.5
}

fn noisy(i: usize, salt: u32) -> Vector {
    Vector::from_fn(|k, _| noise(3 * i + k, salt))
}

/// Forces and moments on all grains, forces on the walls, that `fluid` has on top of one without edges, at the first
/// step: no volume has changed yet, so that there are no pressures.
struct Between {
    system: CoupledSystem,
    forces: Vec<Vector>,
    torques: Vec<Vector>,
    walls: Vec<Vector>,
}

fn between(
    grains: &[Grain],
    fluid: Fluid,
    stuck: bool,
    motion: impl Fn(usize, &Grain) -> [Vector; 2],
) -> Between {
    let mut system = GrainSystem::new(boxed(grains.to_vec())).expect("grains");
    for (i, grain) in grains.iter().enumerate() {
        let [velocity, spin] = motion(i, grain);
        system.grains.velocity[i] = velocity;
        system.grains.spin[i] = spin;
    }
    let mut setup = FlowSetup::new(fluid).side(5, WallBoundary::drained(0.0));
    if stuck {
        setup = sticking(setup);
    }
    let mut system = CoupledSystem::new(system, setup).expect("a system");
    system.step_unchecked(1e-9).expect("a step");
    let (grains, walls) = (&system.grains().grains, system.grains().walls.iter());
    Between {
        forces: grains.external_force.to_vec(),
        torques: grains.external_torque.to_vec(),
        walls: walls.map(|w| w.external_force).collect(),
        system,
    }
}

fn near(found: Vector, wanted: Vector) {
    let error = (found - wanted).norm() / wanted.norm();
    assert!(error < 1e-12, "{found:?} for {wanted:?}: {error:e}");
}

fn sheared(mut fluid: Fluid) -> Fluid {
    fluid.shear = true;
    fluid
}

fn lubricated(mut fluid: Fluid) -> Fluid {
    fluid.lubrication = Some(LUBRICATION);
    fluid
}

/// Two spheres of 0.1 m across the middle of a unit box: the face between them is the section, 1 m².
#[test]
fn two_spheres_feel_the_formulas() {
    let (radius, gap) = (0.1, 0.1);
    let pair = [0.35, 0.65].map(|x| Grain::new([x, 0.5, 0.5], radius, 2600.0));
    let moves = [Vector::new(0.3, 0.2, 0.0), Vector::new(-0.1, 0.0, 0.5)];
    let spins = [Vector::new(1.0, 0.0, 2.0), Vector::new(0.0, 3.0, 0.0)];
    let fluid = lubricated(sheared(Fluid::new(VISCOSITY, 0.0)));
    let found = between(&pair, fluid, false, |i, _| [moves[i], spins[i]]);
    let lever = Vector::new(radius + 0.5 * gap, 0.0, 0.0);
    let difference = moves[1] - spins[1].cross(&lever) - moves[0] - spins[0].cross(&lever);
    let (along, reduced) = (Vector::new(difference.x, 0.0, 0.0), 0.5 * radius);
    let shear = VISCOSITY / (gap + 0.45 * radius) * (difference - along);
    let excess = 1.0 / gap - 1.0 / (LUBRICATION.range * reduced);
    let wanted = shear + 6.0 * PI * VISCOSITY * reduced * reduced * excess * along;
    near(found.forces[0], wanted);
    near(found.forces[1], -wanted);
    near(found.torques[0], lever.cross(&wanted));
    near(found.torques[1], lever.cross(&wanted));
}

/// A dense packing in motion: forces of neighbours are opposite, with walls that stick as well; their moments cancel
/// about any point; they take energy.
#[test]
fn neighbours_conserve_momentum_and_its_moment_and_take_energy() {
    let grains = packing(BOX200);
    let motion = |i: usize, _: &Grain| [noisy(i, 2_654_435_761), 30.0 * noisy(i, 2_246_822_519)];
    let plain = Fluid::new(VISCOSITY, 0.0);
    for fluid in [sheared(plain), lubricated(plain)] {
        let free = between(&grains, fluid, false, motion);
        let size: f64 = free.forces.iter().map(|f| f.norm()).sum();
        let total: Vector = free.forces.iter().sum();
        let moments = grains.iter().zip(&free.forces).zip(&free.torques);
        let moment: Vector = moments.map(|((g, f), t)| g.position.cross(f) + t).sum();
        let (total, moment) = (total.norm() / size, moment.norm() / size);
        println!("sum of forces {total:e}, of moments {moment:e} of {size:.3} N");
        assert!(total < 1e-13 && moment < 1e-13);
        let power = |of: &Between| -> f64 {
            let each = grains.iter().enumerate().map(|(i, g)| {
                let [v, w] = motion(i, g);
                v.dot(&of.forces[i]) + w.dot(&of.torques[i])
            });
            each.sum()
        };
        let stuck = between(&grains, fluid, true, motion);
        let total = stuck.forces.iter().chain(&stuck.walls).sum::<Vector>();
        assert!(total.norm() < 1e-13 * size, "with walls {total:?}");
        let powers = [power(&free), power(&stuck)];
        println!("power {powers:?} W");
        assert!(powers[1] < powers[0] && powers[0] < 0.0, "walls take more");
    }
}

/// A packing that turns as one body, or drifts, is not sheared.
#[test]
fn a_rigid_motion_gives_no_force() {
    let turn = Vector::new(1.0, -2.0, 3.0);
    let fluid = lubricated(sheared(Fluid::new(VISCOSITY, 0.0)));
    let grains = packing(BOX200);
    let largest = |drift: Vector, spin: Vector| {
        let motion = |_: usize, g: &Grain| [drift + turn.cross(&g.position), spin];
        let forces = between(&grains, fluid, false, motion).forces;
        forces.iter().map(|f| f.amax()).fold(0.0, f64::max)
    };
    let (rigid, sliding) = (largest(turn, turn), largest(Vector::zeros(), -turn));
    println!("largest force {rigid:e} N, {sliding:.3} N if all turn against each other");
    assert!(rigid < 1e-12 * sliding);
}

/// λ of what is between neighbours is a bound: at 0.9 of the limit a packing loses its energy, as it does without.
#[test]
fn a_step_below_the_limit_is_stable_with_shear_and_lubrication() {
    let plain = Fluid::new(1000.0, 0.0);
    let limits = [plain, sheared(plain), lubricated(plain)].map(|fluid| {
        let velocity = |i: usize| 1e-4 * noisy(i, 2_654_435_761);
        let spin = |i: usize| 1e-3 * noisy(i, 2_246_822_519);
        let motion = |i: usize, _: &Grain| [velocity(i), spin(i)];
        let mut found = between(&packing(BOX200), fluid, true, motion);
        let system = &mut found.system;
        let step = 0.9 * system.step_limit().expect("a limit").step;
        let mut highest = [0.0_f64; 4];
        // The same time for all, since contacts first give back what the packing has stored.
        let end = 0.011;
        while system.time() < end {
            system.step_unchecked(step).expect("a step");
            let quarter = (4.0 * system.time() / end).min(3.0) as usize;
            highest[quarter] = highest[quarter].max(system.grains().kinetic_energy());
        }
        let growth = highest[3] / highest[0];
        println!(
            "step {step:.3e} s, kinetic energy of the last quarter over the first {growth:.3e}"
        );
        assert!(growth < 1.0, "grew by {growth}");
        step
    });
    assert!(limits[1] < limits[0] && limits[2] < limits[0]);
}

#[test]
fn lubrication_without_roughness_or_range_is_refused() {
    for (roughness, range) in [
        (0.0, 1.0),
        (0.1, 0.1),
        (f64::NAN, 1.0),
        (0.1, f64::INFINITY),
    ] {
        let mut fluid = Fluid::new(1.0, 0.0);
        fluid.lubrication = Some(Lubrication { roughness, range });
        let setup = FlowSetup::new(fluid).side(5, WallBoundary::drained(0.0));
        let refused = CoupledSystem::new(packed(BOX200), setup).err();
        assert_says(refused.expect("refused"), "lubrication");
    }
}
