//! Numbers for people.

/// Four significant digits: `0.0125`, `1.23e-5`, `1682`.
pub fn plain(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    if !(1e-3..1e6).contains(&size) {
        let text = format!("{x:.3e}");
        // 1.000e-3 → 1e-3
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", shortened(digits));
    }
    let before = size.log10().floor() as i32;
    let decimals = usize::try_from(3 - before).unwrap_or(0);
    shortened(&format!("{x:.decimals$}")).to_string()
}

fn shortened(digits: &str) -> &str {
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    }
}

/// A count with thin groups: `1 682 000`; from ten million on with an exponent.
pub fn count(x: f64) -> String {
    if !x.is_finite() || x.abs() >= 1e10 {
        return plain(x);
    }
    let digits = format!("{x:.0}");
    let mut grouped = String::new();
    for (k, c) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) && grouped != "-" {
            grouped.push(' ');
        }
        grouped.push(c);
    }
    grouped
}

/// A rate per second or the like: `1.72 million`.
pub fn rate(x: f64) -> String {
    match x {
        x if x >= 1e6 => format!("{:.2} million", x / 1e6),
        x => count(x),
    }
}

/// Bytes with a decimal prefix.
pub fn bytes(x: f64) -> String {
    match x {
        x if x < 1e3 => format!("{x:.0} B"),
        x if x < 1e6 => format!("{:.1} kB", x / 1e3),
        x if x < 1e9 => format!("{:.1} MB", x / 1e6),
        x if x < 1e12 => format!("{:.1} GB", x / 1e9),
        x => format!("{} TB", plain(x / 1e12)),
    }
}

/// A duration given in seconds: `4.2 s`, `12 min 5 s`, `3 h 20 min`, `2 d 4 h`.
pub fn duration(seconds: f64) -> String {
    if !seconds.is_finite() {
        return "unknown".into();
    }
    let whole = |x: f64| x.round() as u64;
    let two = |big: u64, small: u64, names: [&str; 2]| match small {
        0 => format!("{big} {}", names[0]),
        _ => format!("{big} {} {small} {}", names[0], names[1]),
    };
    match seconds {
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 59.5 => format!("{} s", whole(s)),
        s if s < 3600.0 => two(whole(s) / 60, whole(s) % 60, ["min", "s"]),
        s if s < 86400.0 => two(whole(s / 60.0) / 60, whole(s / 60.0) % 60, ["h", "min"]),
        s => two(whole(s / 3600.0) / 24, whole(s / 3600.0) % 24, ["d", "h"]),
    }
}

/// A share as a percentage; a share above zero is never printed as zero.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        p if p > 0.0 && p < 0.05 => "<0.1 %".into(),
        p => format!("{p:.1} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        let plains = [0.0, 0.0125, 1.23457e-5, 1682.0, 0.5, -3.0, 2.5e9, 99_999.6];
        let texts = [
            "0", "0.0125", "1.235e-5", "1682", "0.5", "-3", "2.5e9", "100000",
        ];
        assert_eq!(plains.map(plain), texts);
        let counts = [12.0, 1682.0, -1682.0, 1e6].map(count);
        assert_eq!(counts, ["12", "1 682", "-1 682", "1 000 000"]);
        let durations = [5.0, 59.7, 60.0, 3725.0].map(duration);
        assert_eq!(durations, ["5.0 s", "1 min", "1 min", "1 h 2 min"]);
        assert_eq!(duration(200_000.0), "2 d 8 h");
        assert_eq!([12.0, 2e6, 3e13].map(bytes), ["12 B", "2.0 MB", "30 TB"]);
        let percents = [1.0, 1e-5, 0.0].map(percent);
        assert_eq!(percents, ["100.0 %", "<0.1 %", "0.0 %"]);
    }
}
