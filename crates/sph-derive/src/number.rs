//! Types that are plain numbers.

use syn::{GenericArgument, PathArguments, Type};

/// True if a type is a number, a truth, or an array or `Option` of one.
pub fn is_number(of: &Type) -> bool {
    const NUMBERS: [&str; 8] = ["f64", "bool", "usize", "u64", "u32", "u8", "i64", "i32"];
    match of {
        Type::Array(array) => is_number(&array.elem),
        Type::Path(_) => match optional(of) {
            Some(value) => is_number(value),
            None => NUMBERS
                .iter()
                .any(|name| matches!(of, Type::Path(path) if path.path.is_ident(name))),
        },
        _ => false,
    }
}

/// The type of the value, if it is an `Option`.
pub fn optional(of: &Type) -> Option<&Type> {
    let Type::Path(path) = of else { return None };
    let last = path
        .path
        .segments
        .last()
        .filter(|last| last.ident == "Option")?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else {
        return None;
    };
    match arguments.args.first()? {
        GenericArgument::Type(value) => Some(value),
        _ => None,
    }
}
