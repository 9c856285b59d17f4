//! Several fields at a time.

use crate::field::AnyField;
use crate::{Field, FieldError, Kind, Store};

/// A field, or a tuple of fields.
pub trait FieldList {
    /// The entries of their columns.
    type Items<'a, const D: usize>;
    /// Calls `each` for every field, in order.
    fn for_each(self, each: impl FnMut(AnyField));
    /// Looks their columns up, in the same order.
    ///
    /// # Errors
    /// If a column was not declared, or it has another type.
    fn items<const D: usize>(self, store: &Store<D>) -> Result<Self::Items<'_, D>, FieldError>;
}

impl<K: Kind> FieldList for Field<K> {
    type Items<'a, const D: usize> = &'a [K::Item<D>];
    fn for_each(self, mut each: impl FnMut(AnyField)) {
        each(self.any());
    }
    fn items<const D: usize>(self, store: &Store<D>) -> Result<Self::Items<'_, D>, FieldError> {
        store.get(self)
    }
}

macro_rules! tuple {
    ($($kind:ident $field:ident),+) => {
        impl<$($kind: Kind),+> FieldList for ($(Field<$kind>),+) {
            type Items<'a, const D: usize> = ($(&'a [$kind::Item<D>]),+);
            fn for_each(self, mut each: impl FnMut(AnyField)) {
                let ($($field),+) = self;
                $(each($field.any());)+
            }
            fn items<const D: usize>(
                self,
                store: &Store<D>,
            ) -> Result<Self::Items<'_, D>, FieldError> {
                let ($($field),+) = self;
                Ok(($(store.get($field)?),+))
            }
        }
    };
}

tuple!(A a, B b);
tuple!(A a, B b, C c);
tuple!(A a, B b, C c, H h);
