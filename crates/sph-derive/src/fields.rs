//! Fields that are plain numbers or no parameters, and attributes of `serde` and `schemars` that an author adds.

use proc_macro2::TokenTree;
use syn::{Attribute, Field, GenericArgument, PathArguments, Type};

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
