//! The arguments of `#[plugin(…)]`, and the entry that they register.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, LitInt, LitStr, Path, Token, Type, bracketed, parenthesized};

use crate::parameter::value;

/// A dimension, and the type of the plugin in it where that is not the one with the attribute.
struct Form {
    dimension: LitInt,
    of: Option<Type>,
}

impl Parse for Form {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let dimension: LitInt = input.parse()?;
        if !matches!(dimension.base10_digits(), "2" | "3") {
            let message = "a plugin has 2 or 3 dimensions";
            return Err(Error::new_spanned(dimension, message));
        }
        let arrow = input.parse::<Option<Token![=>]>>()?;
        let of = arrow.map(|_| input.parse()).transpose()?;
        Ok(Self { dimension, of })
    }
}

/// Arguments of a plugin's registration.
pub struct Registration {
    entry: Path,
    /// Nothing for a kind without a dimension of its own.
    forms: Option<Vec<Form>>,
    name: LitStr,
    summary: LitStr,
    source: TokenStream,
    within: Option<TokenStream>,
    condition: Option<TokenStream>,
}

const FORM: &str = "expected `Entry [2, 3], \"name\", \"one sentence\", source: \"author year, Eq. n\"`, without \
     brackets for kinds without a dimension of their own";

impl Parse for Registration {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let wrong = |e: Error| Error::new(e.span(), FORM);
        let entry = input.call(Path::parse_mod_style).map_err(wrong)?;
        let mut forms = None;
        if input.peek(syn::token::Bracket) {
            let inside;
            bracketed!(inside in input);
            let each = inside.parse_terminated(Form::parse, Token![,])?;
            forms = Some(each.into_iter().collect());
        }
        input.parse::<Token![,]>().map_err(wrong)?;
        let name = input.parse().map_err(wrong)?;
        input.parse::<Token![,]>().map_err(wrong)?;
        let summary = input.parse().map_err(wrong)?;
        let (mut source, mut within, mut condition) = (None, None, None);
        while !input.is_empty() {
            input.parse::<Token![,]>().map_err(wrong)?;
            if input.is_empty() {
                break;
            }
            let word = input.call(Ident::parse_any).map_err(wrong)?;
            match word.to_string().as_str() {
                "source" => source = Some(value(&word, input)?),
                "within" => within = Some(value(&word, input)?),
                "cfg" => {
                    let inside;
                    parenthesized!(inside in input);
                    let condition_of: TokenStream = inside.parse()?;
                    condition = Some(quote!(#[cfg(#condition_of)]));
                }
                _ => {
                    let known = "a plugin has `source`, `within` and `cfg`";
                    let message = format!("unknown word `{word}`: {known}");
                    return Err(Error::new_spanned(word, message));
                }
            }
        }
        let source = source.ok_or_else(|| Error::new(input.span(), FORM))?;
        Ok(Self {
            entry,
            forms,
            name,
            summary,
            source,
            within,
            condition,
        })
    }
}

impl Registration {
    /// The entry of a type with these parameters.
    pub fn expand(&self, parameters: &Ident) -> TokenStream {
        let Self {
            entry,
            name,
            summary,
            source,
            condition,
            ..
        } = self;
        let own = parameters.to_token_stream();
        let of = |form: &Form| {
            let other = form.of.as_ref();
            other.map_or(own.clone(), ToTokens::to_token_stream)
        };
        let forms = self.forms.as_deref();
        let described = forms.and_then(<[Form]>::first).map_or(own.clone(), of);
        let (dimensions, build) = match forms {
            None => {
                let made = self.constructor(&own);
                let of_kind = quote!(<#entry as ::sph_core::Contract>::KIND.dimensions);
                (of_kind, quote!(build: #made))
            }
            Some(forms) => {
                let [planar, spatial] = ["2", "3"].map(|digits| {
                    let form = forms.iter().find(|f| f.dimension.base10_digits() == digits);
                    match form.map(|form| self.constructor(&of(form))) {
                        Some(made) => quote!(::core::option::Option::Some(#made)),
                        None => quote!(::core::option::Option::None),
                    }
                });
                let all = forms.iter().map(|f| &f.dimension);
                (
                    quote!(&[#(#all),*]),
                    quote!(build_2d: #planar, build_3d: #spatial),
                )
            }
        };
        quote! {
            #condition
            ::sph_core::reexport::inventory::submit! {
                #entry {
                    info: ::sph_core::PluginInfo {
                        name: #name,
                        summary: #summary,
                        source: #source,
                        provider: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")),
                        dimensions: #dimensions,
                        schema: ::sph_core::schema_of::<#described>,
                    },
                    #build
                }
            }
        }
    }

    /// A function from a table of parameters to the plugin.
    fn constructor(&self, parameters: &TokenStream) -> TokenStream {
        let read = quote!(::sph_core::typed::<#parameters>(table)?);
        let made = match &self.within {
            Some(within) => quote!((#within)(#read)),
            None => read,
        };
        quote!(|table| Ok(Box::new(#made)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails unless the registration has all of some parts.
    fn assert_parts(arguments: &str, parts: &[&str]) {
        let registration: Registration = syn::parse_str(arguments).expect("arguments");
        let name = Ident::new("Mine", proc_macro2::Span::call_site());
        let code = registration.expand(&name).to_string().replace(' ', "");
        for part in parts {
            assert!(code.contains(part), "{part}: {code}");
        }
    }

    fn problem(arguments: &str) -> String {
        let read = syn::parse_str::<Registration>(arguments);
        read.err().map(|e| e.to_string()).unwrap_or_default()
    }

    #[test]
    fn every_dimension_is_built_from_its_own_type() {
        let made = ["(Lanes)(::sph_core::typed::<Flat<2>>", "typed::<Deep>"];
        let described = [
            "#[cfg(not(test))]::sph_core",
            "&[2,3]",
            "schema_of::<Flat<2>>",
        ];
        assert_parts(
            r#"Entry [2 => Flat<2>, 3 => Deep], "n", "s", source: "p", within: Lanes, cfg(not(test))"#,
            &[&made[..], &described].concat(),
        );
    }

    #[test]
    fn a_form_that_is_missing_is_not_built() {
        let parts = ["build_2d:::core::option::Option::None", "typed::<Mine>"];
        assert_parts(r#"Entry [3], "n", "s", source: "p""#, &parts);
        assert_parts(r#"Entry, "n", "s", source: "p""#, &["build:|table|"]);
    }

    #[test]
    fn mistakes_name_what_is_valid() {
        assert!(problem(r#"Entry [4], "n", "s", source: "p""#).contains("2 or 3 dimensions"));
        assert!(problem(r#"Entry [2, 3], "n", "s""#).contains("source: "));
        assert!(problem(r#"Entry [2, 3] "n""#).contains("expected `Entry [2, 3],"));
        let told = problem(r#"Entry, "n", "s", sauce: "p""#);
        let unknown = "unknown word `sauce`: a plugin has `source`, `within` and `cfg`";
        assert!(told.contains(unknown), "{told}");
    }
}
