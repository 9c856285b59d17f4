//! `#[pair_term(…)]`: a pair term, its columns and constants declared once.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Data, DeriveInput, Error, Expr, Field, GenericParam, Token, Type};

use crate::fields::optional;

const FORM: &str = "expected `Term, \"name in plans\"`: the type of the parameters, and the name";
const NAMED: &str = "a bound term is a struct with named fields";
const WORDS: &str = "a field has one of `#[here(FIELD)]`, `#[both(FIELD)]`, `#[neighbours(FIELD)]`, `#[where_there(FIELD)]`, \
     `#[rate(FIELD)]` and `#[value(expression)]`; a column may say when it is read: `#[both(FIELD, if condition)]`";

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
        let condition = match input.parse::<Option<Token![,]>>()? {
            Some(_) if !input.is_empty() => {
                input.parse::<Token![if]>()?;
                Some(input.parse()?)
            }
            _ => None,
        };
        Ok(Column { field, condition })
    }
}

/// Access and initial value of a field of the bound term.
struct Entry {
    access: TokenStream,
    value: TokenStream,
}

impl Entry {
    fn new(field: &Field, attribute: &Attribute) -> syn::Result<Self> {
        let word = attribute.path().get_ident().map(ToString::to_string);
        let word = word.unwrap_or_default();
        if word == "value" {
            let value: TokenStream = attribute.parse_args()?;
            return Ok(Entry {
                access: TokenStream::new(),
                value: quote!(#value),
            });
        }
        if word == "rate" {
            let rate: TokenStream = attribute.parse_args()?;
            return Ok(Entry {
                access: quote!(access = access.writes(#rate);),
                value: quote!(world.slot(#rate)?),
            });
        }
        let Column {
            field: column,
            condition,
        } = attribute.parse_args()?;
        let method = format_ident!("{word}");
        let add = quote!(access = access.#method(#column););
        let get = quote!(world.free.get(#column));
        let optional = optional(&field.ty).is_some();
        Ok(match (condition, word == "where_there") {
            (_, true) => Entry {
                access: add,
                value: quote!(#get.ok()),
            },
            (None, _) => Entry {
                access: add,
                value: quote!(#get?),
            },
            (Some(condition), _) if optional => Entry {
                access: quote!(if #condition { #add }),
                value: quote!(if #condition { Some(#get?) } else { None }),
            },
            (Some(condition), _) => Entry {
                access: quote!(if #condition { #add }),
                value: quote!(if #condition { #get? } else { &[] }),
            },
        })
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
        let known = |a: &Attribute| {
            let words = ["here", "both", "neighbours", "where_there", "rate", "value"];
            words.iter().any(|word| a.path().is_ident(word))
        };
        let words: Vec<Attribute> = field.attrs.extract_if(.., |a| known(a)).collect();
        let [word] = &words[..] else {
            return Err(Error::new_spanned(name, WORDS));
        };
        let entry = Entry::new(field, word)?;
        access.extend(entry.access);
        let value = entry.value;
        fields.extend(quote!(#name: #value,));
    }
    let Term { of, name } = term;
    let bound = &item.ident;
    let generics = item.generics.params.iter();
    // All but the lifetime: dimension and formulas, which the term has, too.
    let own: Punctuated<GenericParam, Token![,]> = generics
        .filter(|p| !matches!(p, GenericParam::Lifetime(_)))
        .cloned()
        .collect();
    let names = own.iter().map(|p| match p {
        GenericParam::Type(t) => t.ident.clone(),
        GenericParam::Const(c) => c.ident.clone(),
        GenericParam::Lifetime(l) => l.lifetime.ident.clone(),
    });
    let has_dimension = own
        .iter()
        .any(|p| matches!(p, GenericParam::Const(c) if c.ident == "D"));
    let dimension = (!has_dimension).then(|| quote!(const D: usize,));
    let names: Vec<_> = names.collect();
    let bounds = &item.generics.where_clause;
    Ok(quote! {
        #item

        impl<#dimension #own> ::sph_neighbours::PairTerm<D> for #of #bounds {
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
             #[value(self.c)] c: f64, #[rate(R)] slot: usize }",
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
