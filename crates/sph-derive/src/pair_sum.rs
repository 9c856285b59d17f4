//! `#[pair_sum]`: the formula of a sum over pairs, its walls and its helpers in one block.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Error, FnArg, ImplItem, ItemImpl, ReturnType, Signature, Type, parse_quote};

const FORM: &str = "expected `fn pair<L: Lane>(&self, own: &O, j: usize, pair: &LanePair<D, L>, sum: &mut S)`, and \
     `fn own<L: Lane>(&self, all: Particles) -> O` unless `O` is `()`";

/// The `PairSum` of a block, its `finish` as `BoundTerm`, and its other functions as they are.
pub fn expand(mut item: ItemImpl) -> syn::Result<TokenStream> {
    let missing = Error::new_spanned(&item.self_ty, FORM);
    let (mut sum, mut finish, mut helpers) = (TokenStream::new(), None, TokenStream::new());
    let (mut own, mut types) = (None, None);
    for mut part in std::mem::take(&mut item.items) {
        let name = match &mut part {
            ImplItem::Fn(function) => {
                function.attrs.push(parse_quote!(#[inline(always)]));
                let signature = &function.sig;
                match signature.ident.to_string().as_str() {
                    "own" => own = Some(output(signature)),
                    "pair" => types = total(signature).map(|ty| (signature.generics.clone(), ty)),
                    _ => {}
                }
                signature.ident.to_string()
            }
            _ => String::new(),
        };
        match name.as_str() {
            "" | "own" | "pair" | "pair_at_walls" => sum.extend(quote!(#part)),
            "finish" => finish = Some(part),
            _ => helpers.extend(quote!(#part)),
        }
    }
    let (lanes, total) = types.ok_or(missing)?;
    if own.is_none() {
        sum.extend(quote! {
            #[inline(always)]
            fn own #lanes (&self, _: ::sph_neighbours::Particles) {}
        });
    }
    let own = own.unwrap_or_else(|| quote!(()));
    let ItemImpl {
        generics, self_ty, ..
    } = &item;
    let conditions = &generics.where_clause;
    let finish = finish.map(|finish| {
        quote!(impl #generics ::sph_neighbours::BoundTerm<D> for #self_ty #conditions { #finish })
    });
    let helpers =
        (!helpers.is_empty()).then(|| quote!(impl #generics #self_ty #conditions { #helpers }));
    Ok(quote! {
        impl #generics ::sph_neighbours::PairSum<D> for #self_ty #conditions {
            type Own #lanes = #own;
            type Sum #lanes = #total;
            #sum
        }
        #finish
        #helpers
    })
}

fn output(signature: &Signature) -> TokenStream {
    match &signature.output {
        ReturnType::Default => quote!(()),
        ReturnType::Type(_, own) => quote!(#own),
    }
}

/// S of the last argument, `&mut S`.
fn total(signature: &Signature) -> Option<Type> {
    let FnArg::Typed(last) = signature.inputs.last()? else {
        return None;
    };
    match &*last.ty {
        Type::Reference(sum) => Some((*sum.elem).clone()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(parts: &str) -> Result<String, String> {
        let item = syn::parse_str(&format!("impl<const D: usize> Bound<'_, D> {{ {parts} }}"));
        let tokens = expand(item.expect("a block")).map_err(|e| e.to_string())?;
        Ok(tokens.to_string().replace(' ', ""))
    }

    #[test]
    fn types_are_those_of_the_functions() {
        let all = expanded(
            "fn own<L: Lane>(&self, all: Particles) -> [L; D] {} fn weight(&self) {} fn finish(&self, sum: f64) {} fn \
             pair<L: Lane>(&self, own: &[L; D], j: usize, pair: &LanePair<D, L>, sum: &mut L) {}",
        );
        let all = all.expect("a sum");
        for part in [
            "typeOwn<L:Lane>=[L;D];typeSum<L:Lane>=L;#[inline(always)]fnown",
            "::sph_neighbours::BoundTerm<D>forBound<'_,D>{#[inline(always)]fnfinish",
            "impl<constD:usize>Bound<'_,D>{#[inline(always)]fnweight",
        ] {
            assert!(all.contains(part), "no `{part}` in {all}");
        }
        assert!(expanded("fn own(&self) {}").is_err_and(|told| told.contains("`fn pair<L: Lane>")));
    }
}
