//! Forces of which a share acts.

use sph_core::{Access, Field, Index, Scalar, StepError, Vect, fields};
use sph_neighbours::{
    ContactRow, Interaction, Neighbourhood, Rates, Row, RowTerm, WithTerm, World,
};

use crate::stress::Rheologies;

/// s_a times the force of a term on particle a: action is not reaction where shares differ.
///
/// Source: Ghaïtanellis 2017, Eq. 4.104.
pub struct Blended<const D: usize> {
    /// The whole force.
    pub term: Box<dyn Interaction<D>>,
    /// s.
    pub share: Field<Scalar>,
    /// Phases whose particles act with their whole force, by number; empty if there is none.
    pub apart: Vec<bool>,
}

impl<const D: usize> Blended<D> {
    /// Friction, of which the share ζ acts. What the phases rub off each other that do not blend stays whole, so that there action
    /// is reaction (ours).
    pub fn friction(term: Box<dyn Interaction<D>>, laws: &Rheologies) -> Self {
        let blends = |law: &dyn sph_rheology::Rheology| law.elastic().is_some_and(|e| e.blends());
        let mut apart: Vec<bool> = laws.iter().map(|law| !blends(&**law)).collect();
        if !apart.contains(&true) {
            apart.clear();
        }
        Blended {
            term,
            share: fields::FRICTION_SHARE,
            apart,
        }
    }

    /// An elastic force, of which the share 1 − ζ acts.
    pub fn solid(term: Box<dyn Interaction<D>>) -> Self {
        Blended {
            term,
            share: fields::SOLID_FRACTION,
            apart: Vec::new(),
        }
    }

    fn phase(&self) -> Option<Field<Index>> {
        (!self.apart.is_empty()).then_some(fields::PHASE)
    }
}

/// Phases of all particles, and which of them act wholly.
type ExemptPhases<'a> = (&'a [u32], &'a [bool]);

impl<const D: usize> Interaction<D> for Blended<D> {
    fn name(&self) -> String {
        format!("share of {}", self.term.name())
    }

    fn access(&self) -> Access {
        let access = self.term.access().here(self.share);
        access.both(self.phase())
    }

    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        let share = world.free.get(self.share)?;
        let phase = world.free.all(self.phase())?;
        let apart = phase.map(|phase| (phase, &self.apart[..]));
        self.term.with_columns(world, &mut |term| {
            with(&BoundBlended { term, share, apart })
        })
    }
}

struct BoundBlended<'a, const D: usize> {
    term: &'a dyn RowTerm<D>,
    share: &'a [f64],
    apart: Option<ExemptPhases<'a>>,
}

impl<const D: usize> RowTerm<D> for BoundBlended<'_, D> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        let share = self.share[at.particle];
        if share == 1.0 {
            return self.term.row(at, rates);
        }
        let mut whole = Rates::from_acceleration(Vect::zeros());
        self.term.row(at, &mut whole);
        let apart = self.of_others(at);
        rates.acceleration +=
            apart.acceleration + (whole.acceleration - apart.acceleration) * share;
        rates.scalar += apart.scalar + (whole.scalar - apart.scalar) * share;
        for (k, rate) in rates.more.iter_mut().enumerate() {
            *rate += apart.more[k] + (whole.more[k] - apart.more[k]) * share;
        }
    }
}

impl<const D: usize> BoundBlended<'_, D> {
    /// The part of neighbours that act wholly.
    fn of_others(&self, at: &Neighbourhood<'_, D>) -> Rates<D> {
        let mut rates = Rates::from_acceleration(Vect::zeros());
        let Some((phase, apart)) = self.apart else {
            return rates;
        };
        let acts = |k: &usize| apart[phase[at.free.index[*k] as usize] as usize];
        let kept: Vec<usize> = (0..at.free.index.len()).filter(acts).collect();
        if kept.is_empty() {
            return rates;
        }
        fn selected<T: Copy>(kept: &[usize], column: &[T]) -> Vec<T> {
            kept.iter().map(|k| column[*k]).collect()
        }
        let others = Neighbourhood {
            free: Row {
                index: &selected(&kept, at.free.index),
                separation: &selected(&kept, at.free.separation),
                distance2: &selected(&kept, at.free.distance2),
                factor: &selected(&kept, at.free.factor),
            },
            wall: Row {
                index: &[],
                separation: &[],
                distance2: &[],
                factor: &[],
            },
            contacts: ContactRow::NONE,
            ..*at
        };
        self.term.row(&others, &mut rates);
        rates
    }
}
