//! What shifted particles take up where they go.

use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::{
    BoundTerm, Contact, Elements, Lane, LanePair, LanePairTerm, LaneTerm, Pair, Rates, There,
    World, add_scaled, dot, set, splat, unlike, vector,
};

/// du/dt += (s·∇)u and dρ/dt += s·∇ρ with the shift velocity s, the gradients from differences:
/// s·∇f = 1/γ_a [Σ_b θ_b V_b (f_b − f_a) s_a·∇w_ab − Σ_s (f_s − f_a) s_a·∇γ_as].
///
/// From neighbours of the same phase, u also from walls that rub: a heavy particle that took up the velocity of light ones
/// would take momentum from nowhere. Where the density is a sum
/// over positions (ρ = (K + mΣθw)/γ), the move changes the sum by
/// 1/γ_a [m_a Σ_b θ_b (s_a − s_b)·∇w_ab − ρ_a s_a·Σ_s ∇γ_as], which is taken back.
///
/// A density that takes no notice of shifts counts what brings particles together and not the shifts that
/// part them again: it drifts, up to 5000 ρU² in a channel. It is therefore led back to that of the arrangement as
/// fast as this is rearranged, dρ/dt += −α ρ_a (1 − C_a) 1/γ_a Σ_b V_b |u_ab·r_ab| |F_ab|, which is 0 at rest
/// and in a rigid rotation. C is the concentration ΣθVw/γ. Within reach of a free surface, where C
/// says nothing, and of wall points, which rearrange what passes, no density is taken up.
///
/// Source: Sun et al. 2019, with differences instead of products; the sum and the way back are ours.
#[derive(Clone, Copy, Debug)]
pub struct ShiftTransport {
    /// Whether the velocity is taken up, besides the density.
    pub velocity: bool,
    /// α.
    pub relaxation: f64,
    /// Whether the density is a sum over positions.
    pub summed: bool,
}

impl<const D: usize> LanePairTerm<D> for ShiftTransport {
    type Bound<'a> = Bound<'a, D>;

    fn name(&self) -> String {
        "transport by shifting".into()
    }

    fn access(&self) -> Access {
        Access::none()
            .both(fields::SHIFT_VELOCITY)
            .both(fields::VELOCITY)
            .both(fields::DENSITY)
            .where_there(fields::PHASE)
            .here(fields::EMPTINESS)
            .neighbours(fields::VOLUME)
            .here(fields::MASS)
    }

    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Bound<'a, D>, StepError> {
        let points = &world.walls.points;
        Ok(Bound {
            which: *self,
            shift: world.free.get(fields::SHIFT_VELOCITY)?,
            velocity: world.free.get(fields::VELOCITY)?,
            density: world.free.get(fields::DENSITY)?,
            emptiness: world.free.get(fields::EMPTINESS)?,
            mass: world.free.get(fields::MASS)?,
            phase: world.free.get(fields::PHASE).ok(),
            wall_velocity: &points.velocity,
            wall_share: &points.share,
            wall_volume: &points.volume,
            wall_grip: &points.grip,
            elements: &world.walls.elements,
        })
    }
}

/// [`ShiftTransport`] with its columns.
pub struct Bound<'a, const D: usize> {
    which: ShiftTransport,
    shift: &'a [Vect<D>],
    velocity: &'a [Vect<D>],
    density: &'a [f64],
    emptiness: &'a [f64],
    mass: &'a [f64],
    phase: Option<&'a [u32]>,
    wall_velocity: &'a [Vect<D>],
    wall_share: &'a [f64],
    wall_volume: &'a [f64],
    wall_grip: &'a [f64],
    elements: &'a Elements<D>,
}

/// What is read once per particle.
#[derive(Clone, Copy)]
pub struct Own<const D: usize> {
    shift: Vect<D>,
    velocity: Vect<D>,
    density: f64,
    /// 1 − C.
    emptiness: f64,
    /// m where the density is a sum, 0 otherwise.
    summed: f64,
    phase: u32,
}

impl<const D: usize> BoundTerm<D> for Bound<'_, D> {
    type Here = Own<D>;
    /// (s·∇)u, dρ/dt and ΣV|u·r||F|.
    type Sum = (Vect<D>, f64, f64);

    #[inline(always)]
    fn here(&self, i: usize) -> Own<D> {
        Own {
            shift: self.shift[i],
            velocity: self.velocity[i],
            density: self.density[i],
            emptiness: self.emptiness[i],
            summed: if self.which.summed { self.mass[i] } else { 0.0 },
            phase: self.phase.map_or(0, |p| p[i]),
        }
    }

    #[inline(always)]
    fn zero(&self) -> Self::Sum {
        (Vect::zeros(), 0.0, 0.0)
    }

    #[inline(always)]
    fn free(&self, own: &Own<D>, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Self::Sum) {
        self.add_one(own, j, there, pair, sum);
    }

    #[inline(always)]
    fn wall(&self, own: &Own<D>, v: usize, pair: &Pair<D>, sum: &mut Self::Sum) {
        let along = own.shift.dot(&pair.separation) * self.wall_share[v] * pair.factor;
        let apart = self.wall_velocity[v] - own.velocity;
        sum.0 += apart * (self.wall_volume[v] * self.wall_grip[v] * along);
        sum.1 -= own.summed * along;
    }

    #[inline(always)]
    fn element(&self, own: &Own<D>, contact: &Contact<D>, sum: &mut Self::Sum) {
        let s = contact.element as usize;
        let along = own.shift.dot(&contact.gradient);
        sum.0 -= (self.elements.velocity[s] - own.velocity) * (self.elements.grip[s] * along);
        if self.which.summed {
            sum.1 += own.density * along;
        }
    }

    #[inline(always)]
    fn finish(&self, own: &Own<D>, sum: &Self::Sum, inverse_gamma: f64, rates: &mut Rates<D>) {
        if own.emptiness == 0.0 {
            return;
        }
        if self.which.velocity {
            rates.acceleration += sum.0 * inverse_gamma;
        }
        {
            let back = self.which.relaxation * own.density * own.emptiness * sum.2;
            rates.scalar += (sum.1 - back) * inverse_gamma;
        }
    }
}

/// [`Own`] of several particles; phases are small whole numbers, exact as any.
#[derive(Clone, Copy)]
pub struct Side<const D: usize, L> {
    shift: [L; D],
    velocity: [L; D],
    density: L,
    summed: L,
    phase: L,
}

impl<const D: usize> LaneTerm<D> for Bound<'_, D> {
    type Side<L: Lane> = Side<D, L>;
    type Sums<L: Lane> = ([L; D], L, L);

    #[inline(always)]
    fn side<L: Lane>(&self, here: &[Own<D>]) -> Side<D, L> {
        let zero = L::splat(0.0);
        let mut side = Side {
            shift: [zero; D],
            velocity: [zero; D],
            density: zero,
            summed: zero,
            phase: zero,
        };
        for (lane, own) in here.iter().enumerate() {
            set(&mut side.shift, lane, &own.shift);
            set(&mut side.velocity, lane, &own.velocity);
            side.density.set(lane, own.density);
            side.summed.set(lane, own.summed);
            side.phase.set(lane, f64::from(own.phase));
        }
        side
    }

    #[inline(always)]
    fn sums<L: Lane>(&self, sum: &Self::Sum) -> Self::Sums<L> {
        (splat(&sum.0), L::splat(sum.1), L::splat(sum.2))
    }

    #[inline(always)]
    fn lane<L: Lane>(&self, sums: &Self::Sums<L>, lane: usize) -> Self::Sum {
        (vector(&sums.0, lane), sums.1.at(lane), sums.2.at(lane))
    }

    #[inline(always)]
    fn add<L: Lane>(
        &self,
        own: &Side<D, L>,
        j: usize,
        there: &There<D>,
        pair: &LanePair<D, L>,
        sums: &mut Self::Sums<L>,
    ) {
        let volume = L::splat(there.volume);
        let along = dot(&own.shift, &pair.separation);
        let mut weight = volume * along * pair.factor;
        let mut relative = own.velocity;
        for (relative, other) in relative.iter_mut().zip(there.velocity.iter()) {
            *relative = L::splat(*other) - *relative;
        }
        sums.2 += volume * dot(&relative, &pair.separation).abs() * pair.factor.abs();
        if let Some(phase) = self.phase {
            weight = unlike(own.phase, phase[j]).where_positive(L::splat(0.0), weight);
        }
        add_scaled(&mut sums.0, &relative, weight);
        sums.1 += (L::splat(there.density) - own.density) * weight;
        let nearer = along - dot(&splat(&self.shift[j]), &pair.separation);
        sums.1 -= own.summed * nearer * pair.factor;
    }
}
