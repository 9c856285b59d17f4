//! The words of `#[parameter(…)]`.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Error, Token};

/// Words, and the keys of the schema that they become.
const WORDS: [(&str, &str); 10] = [
    ("unit", "unit"),
    ("min", "minimum"),
    ("max", "maximum"),
    ("above", "exclusiveMinimum"),
    ("below", "exclusiveMaximum"),
    ("min_items", "minItems"),
    ("max_items", "maxItems"),
    ("quantity", "quantity"),
    ("examples", "examples"),
    ("source", "source"),
];

/// Value of the word `default`.
pub enum Fallback {
    /// The default of the type.
    OfType,
    /// The value of an expression.
    Value(TokenStream),
}

/// The words of one parameter.
#[derive(Default)]
pub struct Parameter {
    /// Its default, if it has one.
    pub fallback: Option<Fallback>,
    /// Keys and values of its schema.
    entries: Vec<TokenStream>,
}

impl Parameter {
    /// Those of the attribute `parameter`, which is taken out of the list; none without it.
    pub fn take_from(attributes: &mut Vec<Attribute>) -> syn::Result<Self> {
        let mut all = attributes.iter();
        match all.position(|a| a.path().is_ident("parameter")) {
            Some(place) => attributes.remove(place).parse_args(),
            None => Ok(Self::default()),
        }
    }

    /// The attribute that adds the entries to the schema.
    pub fn schema(&self) -> Option<TokenStream> {
        let entries = &self.entries;
        (!entries.is_empty()).then(|| quote!(#[schemars(extend(#(#entries),*))]))
    }
}

impl Parse for Parameter {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let mut parameter = Self::default();
        let mut seen = Vec::new();
        while !input.is_empty() {
            let word = input.call(Ident::parse_any)?;
            if seen.contains(&word) {
                return Err(Error::new_spanned(&word, format!("`{word}` is said twice")));
            }
            if word == "default" {
                parameter.fallback = Some(match input.peek(Token![:]) {
                    true => Fallback::Value(owned(value(&word, input)?)),
                    false => Fallback::OfType,
                });
            } else {
                let Some((_, key)) = WORDS.iter().find(|(known, _)| word == known) else {
                    return Err(unknown(&word));
                };
                let value = value(&word, input)?;
                parameter.entries.push(quote!(#key = #value));
            }
            seen.push(word);
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        Ok(parameter)
    }
}

fn unknown(word: &Ident) -> Error {
    let known = WORDS.map(|(known, _)| known).join("`, `");
    let message = format!("unknown word `{word}`: a parameter has `default`, `{known}`");
    Error::new_spanned(word, message)
}

/// Tokens after a colon, up to the next comma.
pub fn value(word: &Ident, input: ParseStream<'_>) -> syn::Result<TokenStream> {
    let missing = |at| Error::new(at, format!("expected a value: `{word}: …`"));
    input.parse::<Token![:]>().map_err(|e| missing(e.span()))?;
    let mut value = TokenStream::new();
    while !input.is_empty() && !input.peek(Token![,]) {
        input.parse::<TokenTree>()?.to_tokens(&mut value);
    }
    match value.is_empty() {
        true => Err(missing(input.span())),
        false => Ok(value),
    }
}

/// A text becomes the text type of the field.
fn owned(value: TokenStream) -> TokenStream {
    match syn::parse2::<syn::LitStr>(value.clone()) {
        Ok(text) => quote!(#text.into()),
        Err(_) => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem(words: &str) -> String {
        let read = syn::parse_str::<Parameter>(words);
        read.err().map(|e| e.to_string()).unwrap_or_default()
    }

    #[test]
    fn words_become_keys_of_the_schema() {
        let words =
            r#"default: -1.0, unit: "1", above: -1.0, max: 2.0, examples: [0.5], source: "a, b""#;
        let read: Parameter = syn::parse_str(words).expect("words");
        let Some(Fallback::Value(value)) = &read.fallback else {
            panic!("no default");
        };
        assert_eq!(value.to_string(), "- 1.0");
        let schema = read.schema().expect("a schema").to_string();
        let expected = r#"#[schemars(extend("unit"="1","exclusiveMinimum"=-1.0,"maximum"=2.0,"examples"=[0.5],"source"="a, b"))]"#;
        assert_eq!(schema.replace(' ', ""), expected.replace(' ', ""));
    }

    #[test]
    fn the_word_default_alone_is_that_of_the_type() {
        let read: Parameter = syn::parse_str("default").expect("a word");
        assert!(matches!(read.fallback, Some(Fallback::OfType)));
        assert!(read.schema().is_none());
    }

    #[test]
    fn mistakes_name_what_is_valid() {
        let unknown = problem(r#"units: "m""#);
        assert!(unknown.contains("unknown word `units`"), "{unknown}");
        for word in WORDS.map(|(word, _)| word).into_iter().chain(["default"]) {
            assert!(unknown.contains(&format!("`{word}`")), "{word}: {unknown}");
        }
        assert!(problem(r#"unit = "m""#).contains("`unit: …`"));
        assert!(problem("min:").contains("`min: …`"));
        assert!(problem("min: 0.0, min: 1.0").contains("`min` is said twice"));
    }
}
