//! Length of eddies by their distance from a wall.

/// L = κz, at most `longest`; L = κz√(1 − z/H) where there is a depth. Source: Issa 2004, Eq. 6.14 and 6.19.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Length {
    /// Von Kármán's κ.
    pub karman: f64,
    /// Depth H of an open channel, m.
    pub depth: Option<f64>,
    /// L is not larger, m.
    pub longest: Option<f64>,
}

impl Length {
    /// L at a distance, m.
    pub fn at(&self, distance: f64) -> f64 {
        let share = self.depth.map_or(1.0, |h| (1.0 - distance / h).max(0.0));
        let length = self.karman * distance * share.sqrt();
        length.min(self.longest.unwrap_or(f64::INFINITY))
    }

    /// The distance beyond which L is the same everywhere, m.
    pub fn farthest(&self) -> f64 {
        let of_longest = self.longest.map(|l| l / self.karman);
        match self.depth {
            Some(depth) => depth,
            None => of_longest.unwrap_or(f64::INFINITY),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_grows_from_the_wall_and_ends_at_the_surface_or_at_the_longest() {
        let plain = Length {
            karman: 0.4,
            depth: None,
            longest: Some(0.1),
        };
        assert!((plain.at(0.1) - 0.04).abs() < 1e-15);
        assert_eq!(plain.at(5.0), 0.1);
        assert!((plain.farthest() - 0.25).abs() < 1e-15);
        let channel = Length {
            depth: Some(2.0),
            longest: None,
            ..plain
        };
        assert!((channel.at(1.5) - 0.4 * 1.5 * 0.5).abs() < 1e-15);
        assert_eq!([channel.at(2.0), channel.at(3.0)], [0.0; 2]);
        assert_eq!(channel.farthest(), 2.0);
    }
}
