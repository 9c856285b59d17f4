//! Triangulated packings, grains, the flow in their pores, and both together.

/// The error is of a kind.
macro_rules! assert_kind {
    ($error:expr, $kind:pat) => {{
        let error = $error;
        assert!(matches!(error, $kind), "{error}");
    }};
}

mod coupled;
mod flow;
mod grains;
mod triangulation;

use dem_pfv::triangulation::Sphere;

/// Packings of YADE in a unit box.
const BOX25: &str = include_str!("../packings/box25.txt");
const BOX200: &str = include_str!("../packings/box200.txt");
const BOX1000: &str = include_str!("../packings/box1000_mono.txt");

/// Lines of numbers.
fn table(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    let number = |word: &str| word.parse().expect("a number");
    let numbers = |l: &str| l.split_whitespace().map(number).collect();
    lines.map(numbers).collect()
}

/// Spheres of a packing: lines of x y z r.
fn spheres(text: &str) -> Vec<Sphere> {
    let rows = table(text).into_iter();
    rows.map(|n| Sphere::new([n[0], n[1], n[2]], n[3]))
        .collect()
}

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} is not {expected} within {tolerance:e}"
    );
}

/// The message of an error has these words.
#[track_caller]
fn assert_says(error: impl std::fmt::Display, words: &str) {
    let message = error.to_string();
    assert!(message.contains(words), "{message}");
}

/// One, two and four threads give the same bits.
fn assert_same_on_threads(bits: impl Fn() -> Vec<u64> + Sync) {
    let [one, two, four] = [1, 2, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(&bits)
    });
    assert_eq!(one, two);
    assert_eq!(one, four);
}
