//! `#[pair_term(…)]`: a pair term, its columns and constants declared once.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Data, DeriveInput, Error, Expr, Field, GenericParam, Token, Type};

use crate::defaults::optional;

const FORM: &str = "expected `Term, \"name in plans\"`: the type of the parameters, and the name";
const NAMED: &str = "a bound term is a struct with named fields";
const WORDS: &str = "a field has one of `#[here(FIELD)]`, `#[both(FIELD)]`, `#[neighbours(FIELD)]`, `#[where_there(FIELD)]`, \
     `#[rate(FIELD)]`, `#[bound(expression)]` and `#[value(expression)]`; a column may say when it is read: \
     `#[both(FIELD, if condition)]`";

/// The term and its name.
pub struct Term {
    of: Type,
    name: Expr,
}

impl Parse for Term {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let wrong = |e: Error| Error::new(e.span(), FORM);
        let of = input.parse().map_err(wrong)?;
        input.parse::<Token![,]>().map_err(wrong)?;
        let name = input.parse().map_err(wrong)?;
        input.parse::<Option<Token![,]>>()?;
        Ok(Term { of, name })
    }
}

/// A column, and the condition under which it is read.
struct Column {
    field: Expr,
    condition: Option<TokenStream>,
}

impl Parse for Column {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let field = input.parse()?;
        let comma = input.parse::<Option<Token![,]>>()?;
        if comma.is_none() || input.is_empty() {
            return Ok(Column {
                field,
                condition: None,
            });
        }
        input.parse::<Token![if]>()?;
        let condition = Some(input.parse()?);
        Ok(Column { field, condition })
    }
}

/// Access and initial value of a field of the bound term; `None` without one of the words.
fn entry(field: &Field, attribute: &Attribute) -> Option<syn::Result<(TokenStream, TokenStream)>> {
    let word = attribute.path().get_ident()?.to_string();
    let argument = || attribute.parse_args::<TokenStream>();
    Some(match word.as_str() {
        "value" => argument().map(|value| (TokenStream::new(), value)),
        "bound" => argument().map(|source| {
            let access = quote!(access = access.and((#source).access()););
            (access, quote!((#source).bind(world)?))
        }),
        "rate" => argument().map(|rate| {
            let access = quote!(access = access.writes(#rate););
            (access, quote!(world.slot(#rate)?))
        }),
        "here" | "both" | "neighbours" | "where_there" => attribute
            .parse_args()
            .map(|given| column(&word, field, given)),
        _ => return None,
    })
}

fn column(word: &str, field: &Field, column: Column) -> (TokenStream, TokenStream) {
    let (method, name) = (format_ident!("{word}"), column.field);
    let add = quote!(access = access.#method(#name););
    let get = quote!(world.free.get(#name));
    match column.condition {
        None if word == "where_there" => (add, quote!(#get.ok())),
        None => (add, quote!(#get?)),
        Some(condition) => {
            let (found, none) = match optional(&field.ty).is_some() {
                true => (quote!(Some(#get?)), quote!(None)),
                false => (quote!(#get?), quote!(&[])),
            };
            let access = quote!(if #condition { #add });
            (access, quote!(if #condition { #found } else { #none }))
        }
    }
}

/// The bound term without its words, and the `PairTerm`.
pub fn expand(term: &Term, mut item: DeriveInput) -> syn::Result<TokenStream> {
    let Data::Struct(data) = &mut item.data else {
        return Err(Error::new_spanned(&item.ident, NAMED));
    };
    let (mut access, mut fields) = (TokenStream::new(), TokenStream::new());
    for field in &mut data.fields {
        let Some(name) = field.ident.clone() else {
            return Err(Error::new_spanned(field, NAMED));
        };
        let mut entries = Vec::new();
        for attribute in std::mem::take(&mut field.attrs) {
            match entry(field, &attribute) {
                Some(found) => entries.push(found?),
                None => field.attrs.push(attribute),
            }
        }
        let [(read, value)] = &entries[..] else {
            return Err(Error::new_spanned(name, WORDS));
        };
        access.extend(read.clone());
        fields.extend(quote!(#name: #value,));
    }
    let Term { of, name } = term;
    let bound = &item.ident;
    // All but the lifetime: dimension and formulas, which the term has, too.
    let own = item.generics.params.iter();
    let own = own.filter(|p| !matches!(p, GenericParam::Lifetime(_)));
    let names = own.clone().map(|p| match p {
        GenericParam::Type(t) => &t.ident,
        GenericParam::Const(c) => &c.ident,
        GenericParam::Lifetime(l) => &l.lifetime.ident,
    });
    let names: Vec<_> = names.collect();
    let has_dimension = names.iter().any(|name| *name == "D");
    let dimension = (!has_dimension).then(|| quote!(const D: usize,));
    let bounds = &item.generics.where_clause;
    Ok(quote! {
        #item

        impl<#dimension #(#own),*> ::sph_neighbours::PairTerm<D> for #of #bounds {
            type Bound<'a> = #bound<'a, #(#names),*>;
            fn name(&self) -> String {
                ::std::string::String::from(#name)
            }
            fn access(&self) -> ::sph_core::Access {
                #[allow(unused_mut, reason = "a term may read no column")]
                let mut access = ::sph_core::Access::none();
                #access
                access
            }
            fn bind<'a>(
                &'a self,
                world: &'a ::sph_neighbours::World<D>,
            ) -> ::std::result::Result<Self::Bound<'a>, ::sph_core::StepError> {
                Ok(#bound { #fields })
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(item: &str) -> Result<String, String> {
        let term = syn::parse_str("Drag, \"drag\"").expect("a term");
        let item = syn::parse_str(item).expect("a struct");
        let tokens = expand(&term, item).map_err(|e| e.to_string())?;
        Ok(tokens.to_string().replace(' ', ""))
    }

    #[test]
    fn columns_are_declared_and_looked_up() {
        let all = expanded(
            "struct Bound<'a> { #[both(V)] v: &'a [f64], #[here(M, if self.m)] m: Option<&'a [f64]>, \
             #[value(self.c)] c: f64, #[rate(R)] slot: usize, #[bound(self.1)] source: Source<'a> }",
        );
        let all = all.expect("a term");
        for part in [
            "access=access.both(V);",
            "ifself.m{access=access.here(M);}",
            "v:world.free.get(V)?,",
            "m:ifself.m{Some(world.free.get(M)?)}else{None},",
            "c:self.c,",
            "access=access.writes(R);",
            "slot:world.slot(R)?,",
            "access=access.and((self.1).access());",
            "source:(self.1).bind(world)?,",
            "impl<constD:usize,>::sph_neighbours::PairTerm<D>forDrag",
        ] {
            assert!(all.contains(part), "no `{part}` in {all}");
        }
    }

    #[test]
    fn a_field_without_a_word_is_told_the_words() {
        for item in [
            "struct Bound<'a> { v: &'a [f64] }",
            "struct Bound<'a> { #[here(A)] #[both(B)] v: &'a [f64] }",
        ] {
            let told = expanded(item).expect_err("a mistake");
            assert!(told.contains("`#[both(FIELD)]`"), "{told}");
        }
    }
}
