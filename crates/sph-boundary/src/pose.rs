//! Rigid displacement of a wall from its reference position.

/// x = c + R(φ) (X − c) + b, with X the reference position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// b, m.
    pub translation: [f64; 2],
    /// φ, counter-clockwise, rad.
    pub angle: f64,
    /// c, in the reference position, m.
    pub centre: [f64; 2],
}

impl Pose {
    /// A displacement without rotation, m.
    pub fn translated(translation: [f64; 2]) -> Self {
        Self {
            translation,
            ..Self::default()
        }
    }

    /// A rotation by `angle` rad about `centre`.
    pub fn rotated(angle: f64, centre: [f64; 2]) -> Self {
        Self {
            translation: [0.0; 2],
            angle,
            centre,
        }
    }

    /// The map as a function, sine and cosine taken once; exact where there is no rotation.
    pub fn map(&self) -> impl Fn([f64; 2]) -> [f64; 2] + use<> {
        let Self {
            translation: [bx, by],
            angle,
            centre: [cx, cy],
        } = *self;
        let (sine, cosine) = angle.sin_cos();
        move |[x, y]| {
            if angle == 0.0 {
                return [x + bx, y + by];
            }
            let (dx, dy) = (x - cx, y - cy);
            [
                cx + cosine * dx - sine * dy + bx,
                cy + sine * dx + cosine * dy + by,
            ]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turn_about_a_centre() {
        let pose = Pose {
            translation: [1.0, 0.0],
            ..Pose::rotated(0.5 * std::f64::consts::PI, [2.0, 0.0])
        };
        let [x, y] = pose.map()([3.0, 0.0]);
        assert!((x - 3.0).abs() < 1e-15 && (y - 1.0).abs() < 1e-15);
        assert_eq!(Pose::translated([0.1, 0.2]).map()([0.0, 0.0]), [0.1, 0.2]);
    }
}
