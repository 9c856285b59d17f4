//! Viscous operators as sums over pairs, and their friction at walls.

use sph_core::{Vect, fields};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, Pair, Particles, Rates, WallSet, World, add_scaled, dot, minus,
    pair_sum, pair_term, scaled, splat, vector,
};

use crate::viscosity::{BoundViscosity, OwnViscosity, ViscositySource};

mod choice;
mod coupling;
mod walls;

pub use choice::{Across, Choice, OnLattice, WallTerm};

/// A viscous operator as a sum over pairs: the force on a per volume is
/// 1/γ_a Σ_b θ_b η̄_ab f(V_a, V_b, u_ab, r_ab), plus the wall's.
pub trait PairFriction<const D: usize>: Copy + Send + Sync + 'static {
    /// Name in plans.
    const NAME: &'static str;
    /// True if a sheared layer's response depends on its direction: else β is skipped.
    const DIRECTIONAL: bool = true;
    /// True if any part of the force is along the relative velocity: else α is skipped.
    const EVEN: bool = true;
    /// Its [stiffness](crate::viscosity::ViscousOperator::stiffness).
    const STIFFNESS: f64;
    /// True if viscosities of pairs are weighed by density, (ρ_a η_b + ρ_b η_a)/(ρ_a + ρ_b); else their mean is the source's.
    const BY_DENSITY: bool = false;
    /// True if it [leaves rotations](crate::viscosity::ViscousOperator::leaves_rotations) alone.
    const LEAVES_ROTATIONS: bool = false;
    /// The choices of the scene.
    fn choice(self) -> Choice;
    /// α, 1/m², and β, 1/m⁴, of f(u) = α u + β (u·r) r, from the volumes here and there, r² and F.
    fn strengths<L: Lane>(self, volume: L, there: L, distance2: L, factor: L) -> [L; 2];
    /// f, 1/m² times the relative velocity u_ab, of several particles.
    #[inline(always)]
    fn forces<L: Lane>(self, volume: L, there: L, u: &[L; D], pair: &LanePair<D, L>) -> [L; D] {
        let [even, along] = self.strengths(volume, there, pair.distance2, pair.factor);
        let mut force = scaled(*u, even);
        if Self::DIRECTIONAL {
            let along = along * dot(u, &pair.separation);
            add_scaled(&mut force, &pair.separation, along);
        }
        force
    }
    /// ½ t·f(t) of several particles: the response to a unit velocity along t.
    #[inline(always)]
    fn shears<L: Lane>(self, volume: L, there: L, along: &[L; D], pair: &LanePair<D, L>) -> L {
        let half = L::splat(0.5);
        match Self::DIRECTIONAL {
            true => half * dot(&self.forces(volume, there, along, pair), along),
            false => half * self.strengths(volume, there, pair.distance2, pair.factor)[0],
        }
    }
    /// f of one particle.
    #[inline(always)]
    fn force(self, volume: f64, there: f64, relative: &Vect<D>, pair: &Pair<D>) -> Vect<D> {
        let force = self.forces(volume, there, &splat(relative), &pair.into());
        vector(&force, 0)
    }
    /// ½ t·f(t) of one particle.
    #[inline(always)]
    fn shear(self, volume: f64, there: f64, along: &Vect<D>, pair: &Pair<D>) -> f64 {
        self.shears(volume, there, &splat(along), &pair.into())
    }
    /// Factor of the literal friction on an element, from the volumes of particle and element.
    #[inline(always)]
    fn at_element(self, _volume: f64, _there: f64) -> f64 {
        1.0
    }
}

/// The term of a pair formula with a source of viscosities.
#[derive(Clone, Copy, Debug)]
pub struct ViscousTerm<F>(pub F, pub ViscositySource);

/// Numbers of the walls that fluid passes.
fn open<const D: usize>(world: &World<D>) -> Vec<u32> {
    let mut open: Vec<u32> = world.walls.passed.iter().map(|p| p.wall).collect();
    open.dedup();
    open
}

/// True if the fluid rubs any wall: all may be free-slip.
fn rubs<const D: usize>(world: &World<D>) -> bool {
    let (points, elements) = (&world.walls.points, &world.walls.elements);
    let rubs = |factors: &[f64]| factors.iter().any(|factor| *factor != 0.0);
    rubs(&points.friction_factor)
        || rubs(&elements.friction_factor)
        || elements.wall_function.contains(&true)
}

/// [`ViscousTerm`] with its columns.
#[pair_term(ViscousTerm<F>, F::NAME)]
pub struct BoundFriction<'a, const D: usize, F: PairFriction<D>> {
    #[value(self.0)]
    friction: F,
    #[both(fields::VELOCITY)]
    velocity: &'a [Vect<D>],
    #[both(fields::VOLUME)]
    volume: &'a [f64],
    #[both(fields::DENSITY)]
    density: &'a [f64],
    #[here(fields::MASS)]
    mass: &'a [f64],
    #[bound(self.1)]
    viscosity: BoundViscosity<'a>,
    /// Of wall functions.
    #[where_there(fields::WALL_FRICTION)]
    wall_friction: Option<&'a [f64]>,
    #[value(&world.walls)]
    walls: &'a WallSet<D>,
    /// True if any wall does: else walls are skipped.
    #[value(rubs(world))]
    rubs: bool,
    /// Walls that fluid passes: nothing of them is corrected.
    #[value(open(world))]
    open: Vec<u32>,
    #[value(self.0.choice().wall_term == WallTerm::Corrected)]
    corrected: bool,
    #[value(self.0.choice().on_lattice.scale(self.0, world))]
    scale: f64,
    #[value(world.spacing)]
    spacing: f64,
}

/// The particle's own values.
#[derive(Clone, Copy)]
pub struct OwnValues<const D: usize> {
    velocity: Vect<D>,
    viscosity: OwnViscosity<f64>,
    volume: f64,
    /// V/m, which a formulation may keep apart from 1/ρ.
    specific_volume: f64,
    /// Shear stress of a wall function over the speed along the wall.
    wall_friction: f64,
    /// Unit vector along the slip past the nearest wall.
    along: Vect<D>,
    /// Normal and distance of the nearest element, where the wall term is to be corrected.
    nearest: Option<(Vect<D>, f64)>,
}

/// The own values of particles in lanes.
#[derive(Clone, Copy)]
pub struct Own<const D: usize, L> {
    velocity: [L; D],
    viscosity: OwnViscosity<L>,
    volume: L,
    density: L,
    along: [L; D],
    /// True if any has an element at which the wall term is to be corrected.
    near: bool,
}

#[pair_sum]
impl<const D: usize, F: PairFriction<D>> BoundFriction<'_, D, F> {
    fn own<L: Lane>(&self, all: Particles) -> Own<D, L> {
        let (mut along, mut near) = ([L::splat(0.0); D], false);
        if self.rubs && self.corrected {
            along = all.each(|i| {
                let nearest = self.nearest(i);
                near |= nearest.is_some();
                self.slip(i, nearest.as_ref()).into()
            });
        }
        Own {
            velocity: all.vectors(self.velocity),
            viscosity: self.viscosity.own(all),
            volume: all.numbers(self.volume),
            density: all.numbers(self.density),
            along,
            near,
        }
    }

    /// Σ θ η̄ f, and Σ θ ½ t·f(t) r_ab, of V F r_ab where the direction does not matter.
    fn pair<L: Lane>(
        &self,
        own: &Own<D, L>,
        j: usize,
        pair: &LanePair<D, L>,
        [force, discrete]: &mut [[L; D]; 2],
    ) {
        let (friction, volume) = (self.friction, L::splat(self.volume[j]));
        let mean = self.means(&own.viscosity, own.density, j);
        let relative = minus(&own.velocity, &self.velocity[j]);
        let of_pair = friction.forces(own.volume, volume, &relative, pair);
        add_scaled(force, &of_pair, mean);
        if own.near {
            let shear = friction.shears(own.volume, volume, &own.along, pair);
            add_scaled(discrete, &pair.separation, shear);
        }
    }

    fn finish(&self, sums: [[f64; D]; 2], at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let here = self.own_values(at.particle);
        let [mut force, discrete] = sums.map(Vect::from);
        // 2 Σ η u_t/δr |∇γ_as|.
        let mut flux = Vect::zeros();
        if self.rubs {
            for (v, pair) in at.wall.pairs() {
                let volume = self.walls.points.volume[v];
                let rubbing = self.rubbing(v, &pair);
                let relative = here.velocity - self.walls.points.viscous_velocity[v];
                let of_pair = self.friction.force(here.volume, volume, &relative, &pair);
                force += of_pair * (rubbing * here.viscosity.eta);
            }
            for contact in at.contacts {
                let normal = &self.walls.elements.normal[contact.element as usize];
                let relative = here.velocity - self.walls.elements.velocity_at(&contact);
                flux += (relative - normal * relative.dot(normal)) * self.weight(&here, &contact);
            }
        }
        let total = force - flux * self.correction(&here, discrete, at);
        let scale = self.scale * at.inverse_renormalisation * here.specific_volume;
        rates.acceleration += total * scale;
    }

    /// η̄ of pairs with one neighbour.
    fn means<L: Lane>(&self, here: &OwnViscosity<L>, density: L, j: usize) -> L {
        if !F::BY_DENSITY {
            return self.viscosity.means(here, j);
        }
        let (there, eta) = (L::splat(self.density[j]), L::splat(self.viscosity.at(j)));
        (density * eta + there * here.eta) / (density + there)
    }
}
