//! Elements near a point.

/// An element and the whole periods to add to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NearElement<const D: usize> {
    /// Index of the element.
    pub element: u32,
    /// Whole periods.
    pub image: [i8; D],
}

/// Elements near several points, each point's behind those of the one before.
#[derive(Clone, Debug, Default)]
pub struct NearRows<const D: usize> {
    /// Number of elements of every point.
    pub counts: Vec<u32>,
    /// All of them.
    pub elements: Vec<NearElement<D>>,
}

impl<const D: usize> NearElement<D> {
    /// Of an image that a byte can count; others are of a wall drawn far outside the box.
    pub(crate) fn new(element: usize, image: [i32; D]) -> Option<Self> {
        let image = image.map(i8::try_from);
        let counted = image.iter().all(Result::is_ok);
        counted.then(|| NearElement {
            element: element as u32,
            image: image.map(Result::unwrap_or_default),
        })
    }

    /// Index of the element.
    pub fn index(self) -> usize {
        self.element as usize
    }
}
