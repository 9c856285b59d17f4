//! Fusing: known combinations of terms become one compiled loop.
//!
//! A scene's terms arrive as objects. Where a crate registered their combination as a
//! [`FusionEntry`], they are replaced by the tuple; all others stay separate calls per particle.

use std::any::Any;

use sph_core::reexport::inventory;

use crate::lane_term::{LanePairTerm, Lanewise};
use crate::term::{Interaction, PairTerm, Term};

/// Terms on their way into the sweep.
pub type Terms<const D: usize> = Vec<Box<dyn Interaction<D>>>;

/// A fusion: replaces the terms it knows by their fused form, leaves all others.
pub struct FusionEntry {
    /// How many terms it joins; larger fusions are tried first.
    pub terms: usize,
    /// For two dimensions.
    pub fuse_2d: fn(Terms<2>) -> Terms<2>,
    /// For three dimensions.
    pub fuse_3d: fn(Terms<3>) -> Terms<3>,
}
inventory::collect!(FusionEntry);

/// Applies every registered fusion, those of most terms first.
pub fn fuse_all<const D: usize>(mut terms: Terms<D>) -> Terms<D> {
    let mut fusions: Vec<_> = inventory::iter::<FusionEntry>.into_iter().collect();
    fusions.sort_by_key(|f| std::cmp::Reverse(f.terms));
    for fusion in fusions {
        let any: &mut dyn Any = &mut terms;
        if let Some(terms) = any.downcast_mut::<Terms<2>>() {
            *terms = (fusion.fuse_2d)(std::mem::take(terms));
        } else if let Some(terms) = any.downcast_mut::<Terms<3>>() {
            *terms = (fusion.fuse_3d)(std::mem::take(terms));
        }
    }
    terms
}

/// The functions that join terms of one kind: the trait that they have, and what makes an interaction of them.
macro_rules! joined {
    ($term:ident, $wrapper:ident, $extract:ident, $restore:ident, $two:ident, $three:ident, $what:literal) => {
        #[doc = concat!("Replaces the ", $what, " of the types A and B by their tuple, if both are there.")]
        pub fn $two<const D: usize, A: $term<D>, B: $term<D>>(mut terms: Terms<D>) -> Terms<D> {
            match ($extract::<D, A>(&mut terms), $extract::<D, B>(&mut terms)) {
                (Some(a), Some(b)) => terms.insert(0, Box::new($wrapper((a, b)))),
                (a, b) => {
                    $restore(&mut terms, b);
                    $restore(&mut terms, a);
                }
            }
            terms
        }

        #[doc = concat!("Replaces the ", $what, " of the types A, B and C by their tuple, if all are there.")]
        pub fn $three<const D: usize, A: $term<D>, B: $term<D>, C: $term<D>>(
            mut terms: Terms<D>,
        ) -> Terms<D> {
            let a = $extract::<D, A>(&mut terms);
            let b = $extract::<D, B>(&mut terms);
            let c = $extract::<D, C>(&mut terms);
            match (a, b, c) {
                (Some(a), Some(b), Some(c)) => terms.insert(0, Box::new($wrapper((a, b, c)))),
                (a, b, c) => {
                    $restore(&mut terms, c);
                    $restore(&mut terms, b);
                    $restore(&mut terms, a);
                }
            }
            terms
        }

        fn $extract<const D: usize, T: $term<D>>(terms: &mut Terms<D>) -> Option<T> {
            let is = |term: &Box<dyn Interaction<D>>| term.as_any_ref().is::<$wrapper<T>>();
            let term = terms.remove(terms.iter().position(is)?);
            term.into_any().downcast::<$wrapper<T>>().ok().map(|t| t.0)
        }

        fn $restore<const D: usize, T: $term<D>>(terms: &mut Terms<D>, term: Option<T>) {
            if let Some(term) = term {
                terms.insert(0, Box::new($wrapper(term)));
            }
        }
    };
}
joined!(
    PairTerm,
    Term,
    scalar,
    restore_scalar,
    fuse_two,
    fuse_three,
    "scalar terms"
);
joined!(
    LanePairTerm,
    Lanewise,
    lanes,
    restore_lanes,
    fuse_two_lanes,
    fuse_three_lanes,
    "terms in lanes"
);
