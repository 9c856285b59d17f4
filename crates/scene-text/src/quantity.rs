//! Numbers with units in strings: "10 kPa", "1e-3 Pa s", "35 deg", "9.81 m/s^2".

use std::f64::consts::PI;

/// Exponents of metre, kilogram and second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimensions(pub [i32; 3]);

/// Units that may carry a prefix, with their value in SI.
const BASE: [(&str, f64, Dimensions); 8] = [
    ("m", 1.0, Dimensions([1, 0, 0])),
    ("g", 1e-3, Dimensions([0, 1, 0])),
    ("s", 1.0, Dimensions([0, 0, 1])),
    ("N", 1.0, Dimensions([1, 1, -2])),
    ("Pa", 1.0, Dimensions([-1, 1, -2])),
    ("J", 1.0, Dimensions([2, 1, -2])),
    ("W", 1.0, Dimensions([2, 1, -3])),
    ("Hz", 1.0, Dimensions([0, 0, -1])),
];

/// Units that stand alone.
const PLAIN: [(&str, f64, Dimensions); 10] = [
    ("1", 1.0, Dimensions([0, 0, 0])),
    ("%", 0.01, Dimensions([0, 0, 0])),
    ("rad", 1.0, Dimensions([0, 0, 0])),
    ("deg", PI / 180.0, Dimensions([0, 0, 0])),
    ("°", PI / 180.0, Dimensions([0, 0, 0])),
    ("bar", 1e5, Dimensions([-1, 1, -2])),
    ("min", 60.0, Dimensions([0, 0, 1])),
    ("h", 3600.0, Dimensions([0, 0, 1])),
    ("t", 1e3, Dimensions([0, 1, 0])),
    ("rpm", PI / 30.0, Dimensions([0, 0, -1])),
];

/// Larger exponents than this occur in no unit; they must not overflow the sums.
const LARGEST_POWER: i32 = 12;

const PREFIXES: [(&str, f64); 9] = [
    ("n", 1e-9),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("d", 1e-1),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// Value in SI and dimensions of a unit such as "kPa", "m/s^2", "kg m^-3", "Pa·s".
///
/// # Errors
/// Says which symbol is not known.
pub fn parse_unit(text: &str) -> Result<(f64, Dimensions), String> {
    let mut factor = 1.0;
    let mut dimensions = Dimensions::default();
    let mut sign = 1;
    let mut symbol = String::new();
    let mut flush = |symbol: &mut String, sign: i32| -> Result<(), String> {
        if symbol.is_empty() {
            return Ok(());
        }
        let (value, dims, power) = one_symbol(symbol)?;
        factor *= value.powi(sign * power);
        for (sum, exponent) in dimensions.0.iter_mut().zip(dims.0) {
            *sum += sign * power * exponent;
        }
        symbol.clear();
        Ok(())
    };
    for c in text.chars() {
        match c {
            ' ' | '*' | '·' => flush(&mut symbol, sign)?,
            '/' => {
                flush(&mut symbol, sign)?;
                sign = -1;
            }
            c => symbol.push(c),
        }
    }
    flush(&mut symbol, sign)?;
    Ok((factor, dimensions))
}

/// Factor from a unit to the SI of one that it must be alike: "mm" to "m".
///
/// # Errors
/// The defect of the unit.
pub fn unit_factor(unit: &str, alike: &str) -> Result<f64, String> {
    let (factor, own) = parse_unit(unit)?;
    let kinds = [("m", "length"), ("s", "time"), ("rad", "angle")];
    let kind = kinds.iter().find(|(unit, _)| *unit == alike);
    let kind = kind.map_or(alike, |(_, kind)| kind);
    match parse_unit(alike) {
        Ok((_, wanted)) if wanted == own && !unit.trim().is_empty() => Ok(factor),
        _ => Err(format!("`{unit}` is no unit of {kind}")),
    }
}

fn one_symbol(symbol: &str) -> Result<(f64, Dimensions, i32), String> {
    let plain = symbol.replace('²', "^2").replace('³', "^3");
    let (name, power) = match plain.split_once('^') {
        Some((name, power)) => {
            let why = || format!("`{power}` is not an exponent in the unit `{symbol}`");
            let known = |p: &i32| p.abs() <= LARGEST_POWER;
            (name, power.parse().ok().filter(known).ok_or_else(why)?)
        }
        None => (plain.as_str(), 1),
    };
    if let Some((_, value, dims)) = PLAIN.iter().chain(&BASE).find(|u| u.0 == name) {
        return Ok((*value, *dims, power));
    }
    for (prefix, scale) in PREFIXES {
        let rest = name.strip_prefix(prefix);
        let base = rest.and_then(|rest| BASE.iter().find(|u| u.0 == rest));
        if let Some(base) = base {
            return Ok((scale * base.1, base.2, power));
        }
    }
    Err(format!("`{symbol}` is not a unit that is known"))
}

/// The SI value of "number unit"; the unit must have the dimensions of `expected`.
///
/// A bare number is taken as SI.
///
/// # Errors
/// Says what is wrong with the number, the unit or its dimensions.
pub fn parse_quantity(text: &str, expected: &str) -> Result<f64, String> {
    let text = text.trim();
    let end = number_end(text);
    let number = text[..end].parse::<f64>();
    let number = number.map_err(|_| format!("`{text}` does not start with a number"))?;
    if !number.is_finite() {
        return Err(format!("`{text}` is not finite"));
    }
    let unit = text[end..].trim();
    if unit.is_empty() {
        return Ok(number);
    }
    let like = |why| match expected {
        "1" => format!("{why}; this is a number without a unit"),
        unit => format!("{why}, expected one like `{unit}`"),
    };
    let (factor, dimensions) = parse_unit(unit).map_err(like)?;
    let (wanted_factor, wanted) = parse_unit(expected)?;
    if dimensions != wanted {
        return Err(format!(
            "`{unit}` does not measure what is asked for here, expected a unit like `{expected}`"
        ));
    }
    Ok(tidy(number * factor / wanted_factor))
}

/// The 15-digit decimal next to `x` if rounding alone separates them: 1 g/cm³ is 1000 kg/m³.
fn tidy(x: f64) -> f64 {
    let decimal = format!("{x:.14e}").parse().unwrap_or(x);
    let near = (x - decimal).abs() <= 4.0 * f64::EPSILON * x.abs();
    if near { decimal } else { x }
}

/// The end of the leading decimal number of a text.
fn number_end(text: &str) -> usize {
    let bytes = text.as_bytes();
    let follows = |k: usize| {
        let next = bytes.get(k + 1);
        next.is_some_and(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-'))
    };
    let belongs = |k: &usize| match bytes[*k] {
        b'e' | b'E' => follows(*k),
        b'+' | b'-' => *k == 0 || matches!(bytes[*k - 1], b'e' | b'E'),
        byte => byte.is_ascii_digit() || byte == b'.',
    };
    (0..bytes.len()).take_while(belongs).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_reach_si() {
        let cases = [
            ("10 kPa", "Pa", 1e4),
            ("1e-3 Pa s", "Pa s", 1e-3),
            ("1e-3Pa·s", "Pa s", 1e-3),
            ("2 mm", "m", 2e-3),
            ("180 deg", "rad", std::f64::consts::PI),
            ("9.81 m/s^2", "m/s²", 9.81),
            ("1 g/cm^3", "kg/m³", 1e3),
            ("-3", "m", -3.0),
            ("5 kg m^-3", "kg/m³", 5.0),
        ];
        for (text, unit, value) in cases {
            let got = parse_quantity(text, unit).unwrap();
            assert!((got - value).abs() <= 1e-12 * value.abs(), "{text}: {got}");
        }
    }

    #[test]
    fn wrong_units_are_named() {
        for (text, told) in [
            ("3 kPa", "like `m`"),
            ("3 parsec", "parsec"),
            ("abc", "number"),
            ("nan", ""),
            ("3 W^2000000000", "exponent"),
            ("1e999", "finite"),
        ] {
            let why = parse_quantity(text, "m").unwrap_err();
            assert!(why.contains(told), "{why}");
        }
    }
}
