//! The derives and attributes of a table of parameters, or of a choice between variants.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::{Attribute, Data, DataEnum, DataStruct, DeriveInput, Error, Fields};

use crate::defaults::{Defaults, is_number, is_skipped, words};

/// The type with the words of its attribute, for scenes or as it is without: then its words and those for `serde` and
/// `schemars` are gone, and with them the traits of texts.
///
/// # Errors
/// Unknown words; a union; fields without names.
pub fn expand(
    mut item: DeriveInput,
    for_scenes: bool,
    is_plugin: bool,
) -> syn::Result<TokenStream> {
    let derived = words(&item.attrs, "derive");
    let said = words(&item.attrs, "serde");
    let plain = item.generics.params.is_empty() && is_plain(&item.data);
    let keeps = matches!(&item.data, Data::Struct(data) if data.fields.iter().any(is_skipped));
    let mut defaults = Defaults::new(&item);
    let (mut derives, mut default) = (vec!["Deserialize", "JsonSchema"], None);
    let mut serde = Vec::new();
    match &mut item.data {
        Data::Struct(data) => default = of_struct(data, &mut defaults, &mut serde)?,
        Data::Enum(data) => of_choice(data, &mut defaults, &said, (&mut derives, &mut serde))?,
        Data::Union(_) => return Err(Error::new_spanned(&item, "expected a struct or an enum")),
    }
    // A plugin that keeps more than its parameters is no value to copy or to print.
    if plain || !(is_plugin && keeps) {
        derives.extend(["Clone", "Debug"]);
    }
    if plain {
        derives.push("Copy");
    }
    derives.retain(|name| !derived.iter().any(|d| d == name));
    let default = default.filter(|_| !derived.iter().any(|d| d == "Default"));
    if !for_scenes {
        take(&mut item, &["serde", "schemars"]);
        derives.retain(|name| !["Deserialize", "JsonSchema", "Serialize"].contains(name));
        let derives = derives.into_iter().map(path_of);
        // The values of single fields are called by the whole alone.
        let defaults = default.is_some().then_some(defaults);
        return Ok(quote!(#[derive(#(#derives),*)] #item #defaults #default));
    }
    let derives = derives.into_iter().map(path_of);
    Ok(quote! {
        #[derive(#(#derives),*)]
        #[serde(crate = "::sph_core::reexport::serde", #(#serde),*)]
        #[schemars(crate = "::sph_core::reexport::schemars")]
        #item
        #defaults
        #default
    })
}

/// Takes the attributes of these names away.
pub fn take(item: &mut DeriveInput, names: &[&str]) {
    let mut lists = vec![&mut item.attrs];
    let fields: Vec<&mut Fields> = match &mut item.data {
        Data::Struct(data) => vec![&mut data.fields],
        Data::Enum(data) => {
            let variants = data.variants.iter_mut();
            let (attributes, fields): (Vec<_>, _) =
                variants.map(|v| (&mut v.attrs, &mut v.fields)).unzip();
            lists.extend(attributes);
            fields
        }
        Data::Union(_) => Vec::new(),
    };
    lists.extend(fields.into_iter().flatten().map(|field| &mut field.attrs));
    for list in lists {
        list.retain(|a| !names.iter().any(|name| a.path().is_ident(name)));
    }
}

fn path_of(name: &str) -> TokenStream {
    let of_trait = format_ident!("{name}");
    match name {
        "Deserialize" | "Serialize" => quote!(::sph_core::reexport::serde::#of_trait),
        "JsonSchema" => quote!(::sph_core::reexport::schemars::JsonSchema),
        _ => quote!(::core::prelude::v1::#of_trait),
    }
}

/// Prepares the fields of a table; returns its `Default` if every field has one. What has one field without a name has
/// the parameters of that.
fn of_struct(
    data: &mut DataStruct,
    defaults: &mut Defaults,
    serde: &mut Vec<TokenStream>,
) -> syn::Result<Option<TokenStream>> {
    let fields = match &mut data.fields {
        Fields::Named(fields) => &mut fields.named,
        Fields::Unnamed(fields) if fields.unnamed.len() == 1 => {
            serde.push(quote!(transparent));
            return Ok(None);
        }
        _ => {
            let message = "expected named fields, `{}` for none";
            return Err(Error::new(data.struct_token.span, message));
        }
    };
    serde.push(quote!(deny_unknown_fields));
    let each = fields.iter_mut().map(|field| defaults.prepare(field, ""));
    let values: Vec<Option<TokenStream>> = each.collect::<syn::Result<_>>()?;
    let keys: Vec<_> = fields.iter().map(|field| field.ident.clone()).collect();
    let all: Option<Vec<_>> = values.into_iter().collect();
    Ok(all.map(|values| defaults.of_all(&keys, &values)))
}

/// Prepares the variants of a choice. They are called in kebab case, and those without fields are compared and written.
fn of_choice(
    data: &mut DataEnum,
    defaults: &mut Defaults,
    said: &[String],
    (derives, serde): (&mut Vec<&'static str>, &mut Vec<TokenStream>),
) -> syn::Result<()> {
    let variants = &mut data.variants;
    if variants.iter().all(|variant| variant.fields.is_empty()) {
        derives.extend(["PartialEq", "Eq", "Serialize"]);
    }
    let is_default = |a: &Attribute| a.path().is_ident("default");
    let mut attributes = variants.iter().flat_map(|variant| &variant.attrs);
    if attributes.any(is_default) {
        derives.push("Default");
    }
    let is_said = |key: &str| said.iter().any(|s| s == key || s == "untagged");
    if !is_said("rename_all") {
        serde.push(quote!(rename_all = "kebab-case"));
    }
    let named = |fields: &Fields| matches!(fields, Fields::Named(_));
    if !is_said("deny_unknown_fields") && variants.iter().any(|variant| named(&variant.fields)) {
        serde.push(quote!(deny_unknown_fields));
    }
    for variant in variants {
        let prefix = format!("{}_", variant.ident.to_string().to_lowercase());
        for field in &mut variant.fields {
            defaults.prepare(field, &prefix)?;
        }
    }
    Ok(())
}

/// True if values are nothing but numbers.
fn is_plain(data: &Data) -> bool {
    let plain = |fields: &Fields| fields.iter().all(|field| is_number(&field.ty));
    match data {
        Data::Struct(data) => plain(&data.fields),
        Data::Enum(data) => data.variants.iter().all(|variant| plain(&variant.fields)),
        Data::Union(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(item: &str, is_plugin: bool) -> String {
        let item = syn::parse_str(item).expect("an item");
        let code = expand(item, true, is_plugin);
        let code = code.unwrap_or_else(Error::into_compile_error);
        code.to_string().replace(' ', "")
    }

    /// Fails unless the code has some parts and lacks others.
    fn assert_parts(code: &str, has: &[&str], lacks: &[&str]) {
        has.iter()
            .for_each(|part| assert!(code.contains(part), "no {part}: {code}"));
        lacks
            .iter()
            .for_each(|part| assert!(!code.contains(part), "{part}: {code}"));
    }

    #[test]
    fn numbers_are_copied_and_what_is_kept_is_not_cloned() {
        let numbers = "struct A { a: f64, b: Option<[u32; 2]> }";
        assert_parts(&expanded(numbers, true), &["v1::Copy"], &[]);
        let text = "struct A { a: String }";
        assert_parts(&expanded(text, true), &["v1::Clone"], &["v1::Copy"]);
        let keeps = "struct A { #[serde(skip)] a: Mutex<f64> }";
        assert_parts(&expanded(keeps, true), &[], &["v1::Clone"]);
        assert_parts(&expanded(keeps, false), &["v1::Clone"], &[]);
        let code = expanded("#[derive(Clone, Default)] struct A { a: f64 }", true);
        assert_eq!(code.matches("Clone").count(), 1, "{code}");
    }

    #[test]
    fn a_table_has_a_default_if_every_field_has_one() {
        let all = "struct A { #[parameter(default: 0.5)] a: f64, b: Option<f64> }";
        let call = r#"#[serde(default="A::default_a")]"#;
        assert_parts(&expanded(all, false), &["default::DefaultforA", call], &[]);
        let some = "struct A { #[parameter(default)] a: f64, b: f64 }";
        assert_parts(
            &expanded(some, false),
            &["#[serde(default)]"],
            &["DefaultforA"],
        );
    }

    #[test]
    fn choices_are_in_kebab_case_unless_an_author_says_otherwise() {
        let code = expanded("enum A { #[default] OneTwo, Three }", false);
        let kebab = r#"rename_all="kebab-case""#;
        assert_parts(&code, &[kebab, "v1::Eq", "v1::Default"], &[]);
        let own = r#"#[serde(rename_all = "lowercase")] enum A { One { a: f64 } }"#;
        assert_parts(
            &expanded(own, false),
            &["deny_unknown_fields"],
            &["kebab", "v1::Eq"],
        );
    }

    #[test]
    fn words_are_taken_away_from_structs_and_variants() {
        for item in [
            "struct A { #[parameter(sauce: 1)] a: f64 }",
            "enum A { B { #[parameter(sauce: 1)] a: f64 } }",
        ] {
            let mut item: DeriveInput = syn::parse_str(item).expect("an item");
            assert!(expand(item.clone(), true, true).is_err());
            take(&mut item, &["parameter"]);
            assert!(expand(item, true, true).is_ok());
        }
    }

    #[test]
    fn a_plain_type_has_its_default_and_nothing_of_texts() {
        let bare = |item: &str| {
            let code = expand(syn::parse_str(item).expect("an item"), false, true).expect("words");
            code.to_string().replace(' ', "")
        };
        let item =
            r#"struct A { #[parameter(default: 0.5, unit: "m")] #[serde(alias = "b")] a: f64 }"#;
        let has = ["default::DefaultforA", "v1::Copy"];
        assert_parts(&bare(item), &has, &["serde", "schema", "unit"]);
        // The function would have no call.
        let some = "struct A { #[parameter(default: 0.5)] a: f64, b: f64 }";
        assert_parts(&bare(some), &[], &["default_a"]);
        let choice = "enum A { #[default] #[serde(rename = \"b\")] B, C }";
        assert_parts(&bare(choice), &["#[default]B", "v1::Eq"], &["serde"]);
    }

    #[test]
    fn one_field_without_a_name_is_the_table_itself() {
        assert_parts(&expanded("struct A(B);", true), &["transparent"], &[]);
        for item in ["struct A(B, C);", "struct A;"] {
            assert_parts(&expanded(item, true), &["expectednamedfields"], &[]);
        }
    }
}
