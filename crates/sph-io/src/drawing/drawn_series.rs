//! A series of a plot: its points, and how they are drawn.

/// One set of points of a [`Plot`](crate::Plot).
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; empty for none.
    pub name: String,
    /// Abscissa and ordinate. A line is broken at points that are not finite.
    pub points: Vec<[f64; 2]>,
    /// Marks of the points.
    pub style: Style,
}

/// Style of a [`Series`].
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Style {
    /// A line through the points.
    #[default]
    Line,
    /// A dashed line through the points.
    Dashes,
    /// A marker at every point.
    Markers,
    /// Both line and markers.
    LineAndMarkers,
    /// Grey line and dots behind all others, not in the legend: the background of the others.
    Background,
    /// A broad pale line behind the others: which points stand out.
    Highlight,
    /// A shaded area between the points and as many upper ordinates.
    Band(
        /// The upper edge at the abscissae of the points.
        Vec<f64>,
    ),
}

impl Series {
    /// A line.
    pub fn line(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::styled(name, points, Style::Line)
    }

    /// Markers, for measurements and reference data.
    pub fn markers(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::styled(name, points, Style::Markers)
    }

    /// A band between the points and the ordinates `upper`.
    pub fn band(name: impl Into<String>, points: Vec<[f64; 2]>, upper: Vec<f64>) -> Self {
        Self::styled(name, points, Style::Band(upper))
    }

    /// Any style.
    pub fn styled(name: impl Into<String>, points: Vec<[f64; 2]>, style: Style) -> Self {
        Self {
            name: name.into(),
            points,
            style,
        }
    }

    /// All points that must fit into the frame.
    pub(crate) fn spots(&self) -> impl Iterator<Item = [f64; 2]> {
        let upper: &[f64] = match &self.style {
            Style::Band(upper) => upper,
            _ => &[],
        };
        let above = self.points.iter().zip(upper).map(|(p, &y)| [p[0], y]);
        self.points.iter().copied().chain(above)
    }
}
