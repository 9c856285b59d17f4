//! A pair term in lanes from outside, and the bits of all widths of lanes.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError, Vect, fields, register};
use sph_lanes::{Width, force_width};
use sph_neighbours::{
    BoundTerm, Lane, LanePair, LanePairTerm, LaneTerm, Lanewise, Pair, PairTerm, Rates, Term,
    TermEntry, There, World, add_scaled, dot, minus, set, splat, vector,
};
use sph_scene::{Override, parse};
use sph_solver::{RunOptions, Start, run};
use sph_tests::{DAM_BREAK, FinalState, PERIODIC, SOAK, STIRRER};

/// a = α c h Σ_b m_b µ_ab/ρ̄ ∇w_ab where particles approach, µ_ab = u_ab·r_ab/(r² + h²/100).
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ArtificialViscosity {
    /// α c, a share of the speed of sound.
    #[schemars(range(min = 0.0), extend("unit" = "m/s"))]
    speed: f64,
}

/// The term with its columns.
struct Bound<'a, const D: usize> {
    velocity: &'a [Vect<D>],
    density: &'a [f64],
    strength: f64,
    softening: f64,
}

impl<const D: usize> LanePairTerm<D> for ArtificialViscosity {
    type Bound<'a> = Bound<'a, D>;
    fn name(&self) -> String {
        "artificial viscosity".into()
    }
    fn access(&self) -> Access {
        let access = Access::none().both(fields::VELOCITY).both(fields::DENSITY);
        access.neighbours(fields::VOLUME)
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let h = world.kernel.smoothing_length();
        Ok(Bound {
            velocity: world.free.get(fields::VELOCITY)?,
            density: world.free.get(fields::DENSITY)?,
            strength: 2.0 * self.speed * h,
            softening: 0.01 * h * h,
        })
    }
}

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    type Side<L: Lane> = ([L; D], L);
    type Sums<L: Lane> = [L; D];

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[(Vect<D>, f64)]) -> Self::Side<L> {
        let (mut velocity, mut density) = ([L::splat(0.0); D], L::splat(0.0));
        for (lane, own) in here.iter().enumerate() {
            set(&mut velocity, lane, &own.0);
            density.set(lane, own.1);
        }
        (velocity, density)
    }
    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Vect<D>) -> [L; D] {
        splat(sum)
    }
    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &[L; D], lane: usize) -> Vect<D> {
        vector(sums, lane)
    }
    #[inline(always)]
    fn add<L: Lane>(
        &self,
        here: &Self::Side<L>,
        _neighbour: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut [L; D],
    ) {
        let parting = dot(&minus(&here.0, &there.velocity), &pair.separation);
        let zero = L::splat(0.0);
        let approach = (-parting).where_positive(parting, zero);
        let rate = approach / (pair.distance2 + L::splat(self.softening));
        let mass = L::splat(self.strength * there.density * there.volume);
        let weight = mass / (here.1 + L::splat(there.density));
        add_scaled(sums, &pair.separation, weight * rate * pair.factor);
    }
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    /// Velocity and density.
    type Here = (Vect<D>, f64);
    type Sum = Vect<D>;
    #[inline(always)]
    fn here(&self, i: usize) -> Self::Here {
        (self.velocity[i], self.density[i])
    }
    #[inline(always)]
    fn zero(&self) -> Vect<D> {
        Vect::zeros()
    }
    #[inline(always)]
    fn free(
        &self,
        here: &Self::Here,
        j: usize,
        there: &There<D>,
        pair: &Pair<D>,
        sum: &mut Vect<D>,
    ) {
        self.add_one(here, j, there, pair, sum);
    }
    #[inline(always)]
    fn finish(&self, _: &Self::Here, sum: &Vect<D>, _: f64, rates: &mut Rates<D>) {
        rates.acceleration += sum;
    }
}

register!(
    TermEntry [2, 3],
    Lanewise<ArtificialViscosity>,
    "artificial-viscosity",
    "friction of particles that approach each other",
    "Monaghan 1992, Eq. 4.1 with β = 0"
);

/// The same term for one particle at a time.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(transparent)]
struct OneByOne(ArtificialViscosity);

impl<const D: usize> PairTerm<D> for OneByOne {
    type Bound<'a> = Bound<'a, D>;
    fn name(&self) -> String {
        LanePairTerm::<D>::name(&self.0)
    }
    fn access(&self) -> Access {
        LanePairTerm::<D>::access(&self.0)
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        LanePairTerm::bind(&self.0, world)
    }
}

register!(
    TermEntry [2, 3],
    Term<OneByOne>,
    "artificial-viscosity-one-by-one",
    "the same for one particle at a time",
    "Monaghan 1992, Eq. 4.1 with β = 0"
);

/// The end of a run of some steps.
fn end_of(scene: &str, steps: usize) -> FinalState {
    let most = Override::parse(&format!("run.max_steps={steps}")).expect("a number");
    let loaded = parse(scene, "scene.toml", &[most]).unwrap_or_else(|e| panic!("{e}"));
    let folder = tempfile::tempdir().expect("a folder");
    let options = RunOptions {
        out: folder.path().to_path_buf(),
        start: Start::Afresh,
        threads: Some(2),
        identity: sph_solver::Identity::of_text(scene),
    };
    run(&loaded.scene, &options, &mut ()).unwrap_or_else(|e| panic!("{e}"));
    FinalState::of(folder.path())
}

const TERM: &str = "[term.artificial-viscosity]\nspeed = 0.3\n";

/// Walls of both kinds, three dimensions, periodic faces, several phases and a soil.
#[test]
fn two_four_and_eight_lanes_end_with_the_same_bits() {
    let dummy = DAM_BREAK.replace("[walls.usaw]", "[walls.dummy-particles]");
    let scenes = [
        ("dam break", DAM_BREAK, 60),
        ("dummy particles", &dummy, 60),
        ("stirrer", STIRRER, 12),
        ("periodic", PERIODIC, 40),
        ("soak", SOAK, 12),
    ];
    for (name, scene, steps) in scenes {
        let scene = format!("{scene}\n{TERM}");
        let mut ends = Vec::new();
        for width in [Width::Two, Width::Four, Width::Eight] {
            force_width(Some(width));
            ends.push(end_of(&scene, steps));
        }
        force_width(None);
        ends[0].assert_same(&ends[1], &format!("{name}, 2 and 4 lanes"));
        ends[0].assert_same(&ends[2], &format!("{name}, 2 and 8 lanes"));
    }
}

#[test]
fn a_term_in_lanes_has_the_bits_of_one_particle_at_a_time() {
    for scene in [DAM_BREAK, PERIODIC] {
        let lanes = end_of(&format!("{scene}\n{TERM}"), 60);
        let term = TERM.replace("viscosity]", "viscosity-one-by-one]");
        let one = end_of(&format!("{scene}\n{term}"), 60);
        assert_eq!(lanes.columns, one.columns);
        let without = end_of(scene, 60);
        assert_ne!(lanes.columns, without.columns, "the term does something");
    }
}
