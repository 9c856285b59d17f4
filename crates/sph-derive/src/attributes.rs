//! Attributes of `serde` and `schemars` that an author adds.

use proc_macro2::TokenTree;
use syn::{Attribute, Field};

/// True if a field is no parameter but state of a plugin.
pub fn is_skipped(field: &Field) -> bool {
    words(&field.attrs, "serde")
        .iter()
        .any(|word| word == "skip")
}

/// The words within the attributes of a name: further derives and attributes of `serde`.
pub fn words(attributes: &[Attribute], name: &str) -> Vec<String> {
    let named = attributes.iter().filter(|a| a.path().is_ident(name));
    let lists = named.filter_map(|a| a.meta.require_list().ok());
    let word = |token| match token {
        TokenTree::Ident(word) => Some(word.to_string()),
        _ => None,
    };
    lists
        .flat_map(|list| list.tokens.clone())
        .filter_map(word)
        .collect()
}
