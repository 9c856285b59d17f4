//! Values of parameters that a scene leaves out, and what the type and attributes of a field say.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};
use syn::ext::IdentExt;
use syn::{
    Attribute, DeriveInput, Field, GenericArgument, Generics, PathArguments, Type, parse_quote,
};

use crate::parameter::{Fallback, Parameter};

/// The type whose parameters are read, with the functions that make their defaults.
pub struct Defaults {
    name: Ident,
    generics: Generics,
    functions: TokenStream,
}

impl Defaults {
    /// None yet, of an item.
    pub fn new(item: &DeriveInput) -> Self {
        Self {
            name: item.ident.clone(),
            generics: item.generics.clone(),
            functions: TokenStream::new(),
        }
    }

    /// Puts the attributes of `schemars` and `serde` in the place of the words of a field. Returns the value that the
    /// field has in the default of the type, if it has one; names of functions begin with the prefix.
    ///
    /// # Errors
    /// Unknown words.
    pub fn prepare(&mut self, field: &mut Field, prefix: &str) -> syn::Result<Option<TokenStream>> {
        let parameter = Parameter::take_from(&mut field.attrs)?;
        if let Some(schema) = parameter.schema() {
            field.attrs.push(parse_quote!(#schema));
        }
        let of_type = quote!(::core::default::Default::default());
        match parameter.fallback {
            None => Ok((optional(&field.ty).is_some() || is_skipped(field)).then_some(of_type)),
            Some(Fallback::OfType) => {
                field.attrs.push(parse_quote!(#[serde(default)]));
                Ok(Some(of_type))
            }
            Some(Fallback::Value(value)) => {
                let key = field.ident.as_ref().map(|key| key.unraw().to_string());
                let function = format_ident!("default_{prefix}{}", key.unwrap_or_default());
                let (name, (_, arguments, _)) = (&self.name, self.generics.split_for_impl());
                let turbofish = arguments.as_turbofish();
                let path = quote!(#name #turbofish::#function);
                let text = path.to_string().replace(' ', "");
                field.attrs.push(parse_quote!(#[serde(default = #text)]));
                let of = &field.ty;
                quote!(fn #function() -> #of { #value }).to_tokens(&mut self.functions);
                Ok(Some(quote!(#path())))
            }
        }
    }

    /// `Default` of the type with a value for each of these keys.
    pub fn of_all(&self, keys: &[Option<Ident>], values: &[TokenStream]) -> TokenStream {
        let (generics, arguments, conditions) = self.generics.split_for_impl();
        let name = &self.name;
        quote! {
            #[automatically_derived]
            impl #generics ::core::default::Default for #name #arguments #conditions {
                fn default() -> Self {
                    Self { #(#keys: #values),* }
                }
            }
        }
    }
}

impl ToTokens for Defaults {
    /// The functions that `prepare` named.
    fn to_tokens(&self, tokens: &mut TokenStream) {
        let (generics, arguments, conditions) = self.generics.split_for_impl();
        let (name, functions) = (&self.name, &self.functions);
        if !functions.is_empty() {
            quote!(impl #generics #name #arguments #conditions { #functions }).to_tokens(tokens);
        }
    }
}

/// True if a field is no parameter but state of a plugin.
pub fn is_skipped(field: &Field) -> bool {
    let said = words(&field.attrs, "serde");
    said.iter().any(|word| word == "skip")
}

/// The words within the attributes of a name: further derives and attributes of `serde`.
pub fn words(attributes: &[Attribute], name: &str) -> Vec<String> {
    let named = attributes.iter().filter(|a| a.path().is_ident(name));
    let lists = named.filter_map(|a| a.meta.require_list().ok());
    let word = |token| match token {
        TokenTree::Ident(word) => Some(word.to_string()),
        _ => None,
    };
    let tokens = lists.flat_map(|list| list.tokens.clone());
    tokens.filter_map(word).collect()
}

/// True if a type is a number, a truth, or an array or `Option` of one.
pub fn is_number(of: &Type) -> bool {
    const NUMBERS: [&str; 8] = ["f64", "bool", "usize", "u64", "u32", "u8", "i64", "i32"];
    match of {
        Type::Array(array) => is_number(&array.elem),
        Type::Path(path) => match optional(of) {
            Some(value) => is_number(value),
            None => NUMBERS.iter().any(|name| path.path.is_ident(name)),
        },
        _ => false,
    }
}

/// The type of the value, if it is an `Option`.
pub fn optional(of: &Type) -> Option<&Type> {
    let Type::Path(path) = of else { return None };
    let last = path.path.segments.last();
    let last = last.filter(|last| last.ident == "Option")?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else {
        return None;
    };
    match arguments.args.first()? {
        GenericArgument::Type(value) => Some(value),
        _ => None,
    }
}
