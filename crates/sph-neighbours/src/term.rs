//! Pair terms: a scalar formula, written once, for free neighbours, wall points and elements.

use std::any::Any;

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{Access, StepError, Vect, contract};

use crate::{Cluster, Contact, Neighbourhood, Row, There, World};

/// What the interaction sweep sums per particle.
#[derive(Clone, Copy, Debug)]
pub struct Rates<const D: usize> {
    /// Acceleration, m/s².
    pub acceleration: Vect<D>,
    /// Rate of the scalar that the formulation evolves (density diffusion), its unit per s.
    pub scalar: f64,
    /// Rates of further scalars, each where [`World::slot`] says, their units per s.
    pub more: [f64; TRANSPORTED],
}

/// Most scalars whose rates one sweep sums besides the formulation's own.
pub const TRANSPORTED: usize = 7;

impl<const D: usize> Rates<D> {
    /// An acceleration, and scalars at rest.
    #[inline(always)]
    pub fn of(acceleration: Vect<D>) -> Self {
        Rates {
            acceleration,
            scalar: 0.0,
            more: [0.0; TRANSPORTED],
        }
    }
}

/// One pair as a term sees it.
#[derive(Clone, Copy, Debug)]
pub struct Pair<const D: usize> {
    /// r_i − r_j, m.
    pub separation: Vect<D>,
    /// |r_i − r_j|², m².
    pub distance2: f64,
    /// F = w'(r)/r ≤ 0: ∇w = F · separation.
    pub factor: f64,
}

/// A term with its columns at hand.
pub trait BoundTerm<const D: usize>: Sync {
    /// What is read once per particle.
    type Here: Copy;
    /// What is summed.
    type Sum: Copy;
    /// Reads the particle's own values.
    fn here(&self, particle: usize) -> Self::Here;
    /// The empty sum.
    fn zero(&self) -> Self::Sum;
    /// Adds a free neighbour; `there` is its packed state.
    fn free(
        &self,
        here: &Self::Here,
        neighbour: usize,
        there: &There<D>,
        pair: &Pair<D>,
        sum: &mut Self::Sum,
    );
    /// Adds a wall point.
    fn wall(&self, _here: &Self::Here, _point: usize, _pair: &Pair<D>, _sum: &mut Self::Sum) {}
    /// Adds a wall element.
    fn element(&self, _here: &Self::Here, _contact: &Contact<D>, _sum: &mut Self::Sum) {}
    /// Turns the sum into rates; `inverse_renormalisation` is 1/γ.
    fn finish(
        &self,
        here: &Self::Here,
        sum: &Self::Sum,
        inverse_renormalisation: f64,
        rates: &mut Rates<D>,
    );
}

/// A term that finds its columns in the world.
pub trait PairTerm<const D: usize>: Send + Sync + 'static {
    /// The term with its columns.
    type Bound<'a>: BoundTerm<D> + 'a;
    /// Name in plans.
    fn name(&self) -> String;
    /// Columns read, and written rates of scalars of its own ([`Rates::more`]); accelerations are the sweep's.
    fn access(&self) -> Access;
    /// Looks the columns up, once per sweep.
    ///
    /// # Errors
    /// If a column is missing.
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError>;
    /// The terms that this one is fused of, each on its own; for those who ask what a term does, not for the sweep.
    ///
    /// # Errors
    /// If a column is missing.
    fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
        let row: Box<dyn RowTerm<D> + 'a> = Box::new(Fused(self.bind(world)?));
        Ok(vec![(self.name(), row)])
    }
}

/// A term called once per particle with its whole neighbourhood.
pub trait RowTerm<const D: usize>: Sync {
    /// Adds the term's rates for one particle.
    fn row(&self, neighbourhood: &Neighbourhood<'_, D>, rates: &mut Rates<D>);
    /// Adds the rates of all particles of a cluster, row by row unless the term knows better.
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        cluster.rows(|k, neighbourhood| self.row(neighbourhood, &mut rates[k]));
    }
}

impl<const D: usize, T: RowTerm<D> + ?Sized> RowTerm<D> for &T {
    fn row(&self, neighbourhood: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        (**self).row(neighbourhood, rates);
    }
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        (**self).cluster(cluster, rates);
    }
}

impl<const D: usize, T: RowTerm<D> + ?Sized> RowTerm<D> for Box<T> {
    fn row(&self, neighbourhood: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        (**self).row(neighbourhood, rates);
    }
    fn cluster(&self, cluster: &mut Cluster<'_, D>, rates: &mut [Rates<D>]) {
        (**self).cluster(cluster, rates);
    }
}

/// What is done with a term that has its columns.
pub type WithTerm<'w, const D: usize> = dyn FnMut(&dyn RowTerm<D>) -> Result<(), StepError> + 'w;

/// A term on its own: its name, and the term with its columns.
pub type Part<'a, const D: usize> = (String, Box<dyn RowTerm<D> + 'a>);

/// A term as the assembler holds it. Implement [`PairTerm`] and wrap it in [`Term`], or
/// implement this to work on whole rows.
pub trait Interaction<const D: usize>: Send + Sync {
    /// Name in plans.
    fn name(&self) -> String;
    /// Columns read, and written rates of scalars of its own ([`Rates::more`]); accelerations are the sweep's.
    fn access(&self) -> Access;
    /// Looks the columns up, once per sweep.
    ///
    /// # Errors
    /// If a column is missing.
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Box<dyn RowTerm<D> + 'a>, StepError>;
    /// Lends the term with its columns to `with`, once. The sweep asks for it in this way: [`Term`] and
    /// [`Lanewise`](crate::Lanewise) have it on the stack, and no step asks for memory.
    ///
    /// # Errors
    /// If a column is missing, and those of `with`.
    fn lend(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&*self.bind(world)?)
    }
    /// The terms that this one is fused of, each on its own.
    ///
    /// # Errors
    /// If a column is missing.
    fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
        Ok(vec![(self.name(), self.bind(world)?)])
    }
    /// The concrete term, so that known terms can be fused.
    fn as_any_ref(&self) -> &dyn Any;
    /// The concrete term, to be taken apart.
    fn into_any(self: Box<Self>) -> Box<dyn Any>;
}

contract!(
    /// A pair term that a scene may add to the built-in ones.
    pub TermEntry, "term", "an additional term of the interaction sweep", Interaction<D>
);

/// Makes a [`PairTerm`] an [`Interaction`], with its parameters.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Term<T>(pub T);

impl<const D: usize, T: PairTerm<D>> Interaction<D> for Term<T> {
    fn name(&self) -> String {
        self.0.name()
    }
    fn access(&self) -> Access {
        self.0.access()
    }
    fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Box<dyn RowTerm<D> + 'a>, StepError> {
        Ok(Box::new(Fused(self.0.bind(world)?)))
    }
    fn lend(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&Fused(self.0.bind(world)?))
    }
    fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
        self.0.parts(world)
    }
    fn as_any_ref(&self) -> &dyn Any {
        self
    }
    fn into_any(self: Box<Self>) -> Box<dyn Any> {
        self
    }
}

/// The one loop over a neighbourhood, compiled for the term (or tuple of terms) inside.
pub struct Fused<B>(pub B);

impl<const D: usize, B: BoundTerm<D>> RowTerm<D> for Fused<B> {
    #[inline]
    fn row(&self, n: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        free_then_walls(&self.0, n, rates);
    }
}

/// What a term sums over a whole neighbourhood: the free neighbours, then wall points, then elements.
#[inline(always)]
pub(crate) fn free_then_walls<const D: usize, B: BoundTerm<D>>(
    term: &B,
    n: &Neighbourhood<'_, D>,
    rates: &mut Rates<D>,
) {
    let here = term.here(n.particle);
    let mut sum = term.zero();
    each(&n.free, |j, pair| {
        term.free(&here, j, &n.states[j], pair, &mut sum)
    });
    if !n.wall.index.is_empty() {
        each(&n.wall, |v, pair| term.wall(&here, v, pair, &mut sum));
    }
    for contact in n.contacts {
        term.element(&here, &contact, &mut sum);
    }
    term.finish(&here, &sum, n.inverse_renormalisation, rates);
}

#[inline(always)]
pub(crate) fn each<const D: usize>(row: &Row<'_, D>, mut visit: impl FnMut(usize, &Pair<D>)) {
    let pairs = row.index.iter().zip(row.separation);
    for ((&j, &separation), (&factor, &distance2)) in
        pairs.zip(row.factor.iter().zip(row.distance2))
    {
        let pair = Pair {
            separation,
            distance2,
            factor,
        };
        visit(j as usize, &pair);
    }
}

macro_rules! fused_tuple {
    ($($t:ident $k:tt),+) => {
        impl<const D: usize, $($t: BoundTerm<D>),+> BoundTerm<D> for ($($t,)+) {
            type Here = ($($t::Here,)+);
            type Sum = ($($t::Sum,)+);
            #[inline(always)]
            fn here(&self, particle: usize) -> Self::Here {
                ($(self.$k.here(particle),)+)
            }
            #[inline(always)]
            fn zero(&self) -> Self::Sum {
                ($(self.$k.zero(),)+)
            }
            #[inline(always)]
            fn free(&self, here: &Self::Here, j: usize, there: &There<D>, pair: &Pair<D>, sum: &mut Self::Sum) {
                $(self.$k.free(&here.$k, j, there, pair, &mut sum.$k);)+
            }
            #[inline(always)]
            fn wall(&self, here: &Self::Here, v: usize, pair: &Pair<D>, sum: &mut Self::Sum) {
                $(self.$k.wall(&here.$k, v, pair, &mut sum.$k);)+
            }
            #[inline(always)]
            fn element(&self, here: &Self::Here, contact: &Contact<D>, sum: &mut Self::Sum) {
                $(self.$k.element(&here.$k, contact, &mut sum.$k);)+
            }
            #[inline(always)]
            fn finish(&self, here: &Self::Here, sum: &Self::Sum, inverse: f64, rates: &mut Rates<D>) {
                $(self.$k.finish(&here.$k, &sum.$k, inverse, rates);)+
            }
        }
        impl<const D: usize, $($t: PairTerm<D>),+> PairTerm<D> for ($($t,)+) {
            type Bound<'a> = ($($t::Bound<'a>,)+);
            fn name(&self) -> String {
                [$(self.$k.name()),+].join(" + ")
            }
            fn access(&self) -> Access {
                Access::none()$(.and(self.$k.access()))+
            }
            fn bind<'a>(&'a self, world: &'a World<D>) -> Result<Self::Bound<'a>, StepError> {
                Ok(($(self.$k.bind(world)?,)+))
            }
            fn parts<'a>(&'a self, world: &'a World<D>) -> Result<Vec<Part<'a, D>>, StepError> {
                let mut parts = Vec::new();
                $(parts.extend(self.$k.parts(world)?);)+
                Ok(parts)
            }
        }
    };
}
fused_tuple!(A 0, B 1);
fused_tuple!(A 0, B 1, C 2);
fused_tuple!(A 0, B 1, C 2, E 3);
