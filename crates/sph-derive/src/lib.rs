//! Attributes that declare a plugin and its parameters in one place; use them as `sph_core::plugin`,
//! `sph_core::parameters` and, for pair terms, `sph_neighbours::pair_term` and `sph_neighbours::pair_sum`.
//!
//! ```text
//! /// τ = 2 η γ̇ with constant η.
//! #[plugin(RheologyEntry, "newtonian", "constant viscosity", source: "Newton 1687")]
//! pub struct Newtonian {
//!     /// Dynamic viscosity η.
//!     #[parameter(default: 1e-3, unit: "Pa s", min: 0.0, source: "Newton 1687")]
//!     pub viscosity: f64,
//! }
//! ```
//!
//! Both attributes derive `Clone`, `Debug`, `Deserialize` and `JsonSchema`, deny unknown keys, and derive `Copy` for
//! plain numbers. Where every field has a default or is an `Option`, the type has `Default`. A plugin with a field that
//! `#[serde(skip)]` keeps is neither cloned nor printed, unless it is plain numbers. A trait that an author derives is
//! not derived twice; further attributes of `serde` and `schemars` stay possible.

mod defaults;
mod pair_sum;
mod pair_term;
mod parameter;
mod registration;
mod table;

use proc_macro::TokenStream;
use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::parse::Nothing;
use syn::{DeriveInput, parse_macro_input};

/// A plugin: the parameters of [`macro@parameters`], offered to scenes under a name.
///
/// `#[plugin(Entry [dimensions], "name", "one sentence", source: "author year, Eq. n")]`. The dimensions are `[2]`,
/// `[3]`, `[2, 3]` or, with a type for each, `[2 => Planar, 3 => Spatial]`; kinds without a dimension of their own have
/// no brackets. Two words may follow the source:
///
/// * `within: Wrapper`: an expression that is called with the parameters and makes the plugin from them;
/// * `cfg(not(test))`: the condition under which it is registered.
#[proc_macro_attribute]
pub fn plugin(arguments: TokenStream, item: TokenStream) -> TokenStream {
    let registration = parse_macro_input!(arguments as registration::Registration);
    let item = parse_macro_input!(item as DeriveInput);
    let registered = registration.expand(&item.ident);
    expanded(item, Some(registered))
}

/// A table of parameters, or a choice between variants in kebab case, that is a part of a plugin or of a scene.
///
/// A field takes `#[parameter(…)]` with any of `default` (that of its type), `default: value`, `unit`, `min`, `max`,
/// `above` and `below` (bounds that are not reached), `min_items`, `max_items`, `quantity`, `examples`, `source`. Its doc
/// comment is its meaning.
#[proc_macro_attribute]
pub fn parameters(arguments: TokenStream, item: TokenStream) -> TokenStream {
    parse_macro_input!(arguments as Nothing);
    expanded(parse_macro_input!(item as DeriveInput), None)
}

/// The type that [`macro@plugin`] makes, without scenes: its derives of the standard library, and its `Default`. For
/// crates whose plugins are a feature: the same attributes with the feature and without it.
#[proc_macro_attribute]
pub fn plain_plugin(arguments: TokenStream, item: TokenStream) -> TokenStream {
    parse_macro_input!(arguments as registration::Registration);
    plain(parse_macro_input!(item as DeriveInput), true)
}

/// The type that [`macro@parameters`] makes, without scenes.
#[proc_macro_attribute]
pub fn plain_parameters(arguments: TokenStream, item: TokenStream) -> TokenStream {
    parse_macro_input!(arguments as Nothing);
    plain(parse_macro_input!(item as DeriveInput), false)
}

fn plain(item: DeriveInput, is_plugin: bool) -> TokenStream {
    let code = table::expand(item, false, is_plugin);
    code.unwrap_or_else(syn::Error::into_compile_error).into()
}

/// A pair term: its columns and constants, declared once in the struct that holds them while a sweep goes on.
///
/// `#[pair_term(Term, "name in plans")]` on the bound struct implements `PairTerm` for `Term`. Every field has one word:
///
/// * `#[here(FIELD)]`, `#[neighbours(FIELD)]`, `#[both(FIELD)]`: a column of the particle, of its neighbours, of both;
/// * `#[both(FIELD, if condition)]`: a column that is read in some scenes only, an `Option` or else an empty slice;
/// * `#[where_there(FIELD)]`: a column that not every scene has, an `Option`;
/// * `#[rate(FIELD)]`: the slot of a rate that the term adds to;
/// * `#[bound(expression)]`: columns of a source with `access` and `bind` of its own;
/// * `#[value(expression)]`: a constant of the sweep.
///
/// Expressions may use `self`, the term, and `world`.
#[proc_macro_attribute]
pub fn pair_term(arguments: TokenStream, item: TokenStream) -> TokenStream {
    let term = parse_macro_input!(arguments as pair_term::Term);
    let code = pair_term::expand(&term, parse_macro_input!(item as DeriveInput));
    code.unwrap_or_else(syn::Error::into_compile_error).into()
}

/// The sum of a pair term, written as one block of functions of the bound struct.
///
/// `own` and `pair` make its `PairSum`, with the types that they return and add to; `pair_at_walls` and the constants
/// of the trait may be beside them. `finish` makes the `BoundTerm`, other functions stay with the struct. All are
/// `#[inline(always)]`.
#[proc_macro_attribute]
pub fn pair_sum(_: TokenStream, item: TokenStream) -> TokenStream {
    let code = pair_sum::expand(parse_macro_input!(item as syn::ItemImpl));
    code.unwrap_or_else(syn::Error::into_compile_error).into()
}

/// The table, and the registration of a plugin. After a mistake in the words of a parameter all goes on without them, so
/// that the uses of the type are no further errors.
fn expanded(mut item: DeriveInput, registered: Option<Tokens>) -> TokenStream {
    let error = match table::expand(item.clone(), true, registered.is_some()) {
        Ok(table) => return quote!(#table #registered).into(),
        Err(error) => error.into_compile_error(),
    };
    table::take(&mut item, &["parameter"]);
    let table = table::expand(item, true, registered.is_some()).ok();
    let registered = table.is_some().then_some(registered);
    quote!(#error #table #registered).into()
}
