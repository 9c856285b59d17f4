//! Segments sorted by the rays that may meet them.

use std::sync::OnceLock;

use crate::geometry::periodic::PeriodicBox;

/// What the question on which side a point is needs of a mesh, for its present position: made when it is first asked.
///
/// Two meshes that are equal have equal sides, asked or not.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sides(pub OnceLock<Columns>);

impl PartialEq for Sides {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Segments by the columns, along the ray, that they reach into.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    lower: f64,
    per_metre: f64,
    /// Where the segments of a column begin in `segments`.
    starts: Vec<u32>,
    segments: Vec<u32>,
    /// Whether the fluid lies beyond all walls along the ray.
    pub beyond: bool,
    /// First and last vertex of every edge where some end freely.
    pub edges: Vec<[usize; 2]>,
}

impl Columns {
    /// Of what every segment covers of the axis across the ray.
    pub fn new(spans: &[(f64, f64)], domain: &PeriodicBox, across: usize, beyond: bool) -> Self {
        let all = || spans.iter().copied();
        let [lower, upper] = match domain.periodic[across] {
            true => [domain.lower[across], domain.upper[across]],
            false => [
                all().fold(f64::INFINITY, |low, (a, _)| low.min(a)),
                all().fold(f64::NEG_INFINITY, |high, (_, b)| high.max(b)),
            ],
        };
        // As many as segments, and fewer if many lie over each other: a segment is in some four columns in the mean.
        let segments = spans.len() as f64;
        let width: f64 = all().map(|(a, b)| b - a).sum();
        let share = ((upper - lower) / width).min(1.0);
        let count = (segments * share).clamp(1.0, 1e6) as usize;
        let per_metre = match upper > lower {
            true => count as f64 / (upper - lower),
            false => 0.0,
        };
        let mut columns = Columns {
            lower,
            per_metre,
            starts: vec![0; count + 1],
            segments: Vec::new(),
            beyond,
            edges: Vec::new(),
        };
        // A column more on either side, for what rounding may do.
        let wraps = domain.periodic[across];
        let reached = |(a, b): (f64, f64)| {
            let [first, last] = [a, b].map(|x| ((x - lower) * per_metre).floor() as i64);
            let (first, last) = (first - 1, last + 1);
            let most = count as i64 - 1;
            let range = match wraps {
                // At most all of them once.
                true => first..=last.min(first + most),
                false => first.max(0)..=last.min(most),
            };
            range.map(move |k| k.rem_euclid(count as i64) as usize)
        };
        for span in all() {
            reached(span).for_each(|k| columns.starts[k + 1] += 1);
        }
        for k in 0..count {
            columns.starts[k + 1] += columns.starts[k];
        }
        let mut next = columns.starts.clone();
        columns.segments = vec![0; columns.starts[count] as usize];
        for (s, span) in all().enumerate() {
            for k in reached(span) {
                columns.segments[next[k] as usize] = s as u32;
                next[k] += 1;
            }
        }
        columns
    }

    /// Segments, in the order of their numbers, that a ray from a place across may meet.
    pub fn column(&self, x: f64, domain: &PeriodicBox, across: usize) -> &[u32] {
        let count = self.starts.len() - 1;
        let x = match domain.periodic[across] {
            true => self.lower + (x - self.lower).rem_euclid(domain.periods()[across]),
            false => x,
        };
        let k = ((x - self.lower) * self.per_metre).floor();
        if !(-1.0..=count as f64).contains(&k) {
            return &[];
        }
        let k = (k.max(0.0) as usize).min(count - 1);
        &self.segments[self.starts[k] as usize..self.starts[k + 1] as usize]
    }
}
