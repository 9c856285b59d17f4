//! What texts must have and numbers must be, and scenes with a change that is refused.

use std::fmt::Debug;
use std::ops::RangeBounds;

use serde_json::Value as Json;

use crate::refusal;

/// What must be said.
pub trait Says {
    /// All of these words must be in it; ` | ` stands between two.
    fn says(&self, words: &str);
    /// None of these words may be in it; ` | ` stands between two.
    fn lacks(&self, words: &str);
}

impl Says for str {
    #[track_caller]
    fn says(&self, words: &str) {
        for word in words.split(" | ") {
            assert!(self.contains(word), "no `{word}` in\n{self}");
        }
    }
    #[track_caller]
    fn lacks(&self, words: &str) {
        for word in words.split(" | ") {
            assert!(!self.contains(word), "`{word}` in\n{self}");
        }
    }
}

/// As it is written.
impl Says for Json {
    #[track_caller]
    fn says(&self, words: &str) {
        self.to_string().says(words);
    }
    #[track_caller]
    fn lacks(&self, words: &str) {
        self.to_string().lacks(words);
    }
}

/// A text whose lines are broken anywhere, in one line.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The number of the first line that has these words.
#[track_caller]
pub fn line_of(text: &str, words: &str) -> usize {
    let line = text.lines().position(|line| line.contains(words));
    1 + line.unwrap_or_else(|| panic!("no line has `{words}`"))
}

/// A text with a part of it, which must be there, exchanged.
#[track_caller]
pub fn exchanged(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "the text lost `{from}`");
    text.replacen(from, to, 1)
}

/// A change of a scene with what is said of it.
#[derive(Default)]
pub struct Refusal {
    from: Vec<&'static str>,
    to: Vec<&'static str>,
    /// Words of the line, or the key, that is told.
    pub at: &'static str,
    /// Words that are said.
    pub said: Vec<&'static str>,
}

/// The refusals of a file: lines that begin with `-` are exchanged by those with `+`, which come last in the scene
/// without them; `@` tells the place, `!` what is said. A blank line stands between two; `#` begins a comment.
pub fn refusals(file: &'static str) -> Vec<Refusal> {
    let one = |lines: &'static str| {
        let mut refusal = Refusal::default();
        for line in lines.lines() {
            let (mark, rest) = line.split_at(line.len().min(2));
            match mark.trim_end() {
                "-" => refusal.from.push(rest),
                "+" => refusal.to.push(rest),
                "@" => refusal.at = rest,
                "!" => refusal.said.push(rest),
                _ => assert!(mark.starts_with('#'), "{line}"),
            }
        }
        refusal
    };
    let all: Vec<_> = file.trim_end().split("\n\n").map(one).collect();
    all.into_iter().filter(|r| !r.said.is_empty()).collect()
}

impl Refusal {
    /// A scene with the change.
    #[track_caller]
    pub fn of(&self, scene: &str) -> String {
        let to = self.to.join("\n");
        match self.from.is_empty() {
            true => format!("{scene}\n{to}\n"),
            false => exchanged(scene, &self.from.join("\n"), &to),
        }
    }

    /// All that is said must be in a text, and its place in the changed file if there is one. Lines may be broken.
    #[track_caller]
    pub fn is_told(&self, told: &str, file: &str, changed: &str) {
        let told = one_line(told);
        told.says(&self.said.join(" | "));
        if !self.at.is_empty() {
            told.says(&format!("{file}:{}:", line_of(changed, self.at)));
        }
    }
}

/// Assembly refuses a scene in the plane with the changes of a file.
pub fn assembly_refuses(scene: &str, file: &'static str) {
    for case in refusals(file) {
        let text = case.of(scene);
        // Without gravity there is no pressure at rest.
        let text = match text.contains("gravity = [") {
            true => text,
            false => text.replace("pressure = \"hydrostatic\"", ""),
        };
        refusal::<2>(&text).says(&case.said.join(" | "));
    }
}

/// A number must be within a share of another one.
#[track_caller]
pub fn near(found: f64, wanted: f64, share: f64, what: &str) {
    let off = (found / wanted - 1.0).abs();
    assert!(off < share, "{what}: {found} for {wanted}, off by {off:e}");
}

/// A number must be within a distance of another one.
#[track_caller]
pub fn close(found: f64, wanted: f64, distance: f64, what: &str) {
    let off = (found - wanted).abs();
    assert!(
        off < distance,
        "{what}: {found} for {wanted}, off by {off:e}"
    );
}

/// The size of a number must be below a bound.
#[track_caller]
pub fn below(found: f64, bound: f64, what: &str) {
    assert!(found.abs() < bound, "{what}: {found:e}, bound {bound:e}");
}

/// A number must be in a range.
#[track_caller]
pub fn within(found: f64, range: impl RangeBounds<f64> + Debug, what: &str) {
    assert!(
        range.contains(&found),
        "{what}: {found} is not in {range:?}"
    );
}

/// A binary STL file of triangles; normals are left zero.
pub fn binary_stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        let corners = triangle.iter().flatten();
        bytes.extend(corners.flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}
