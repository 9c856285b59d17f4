//! Degrees of freedom of a body, and the springs that hold it.

use sph_core::parameters;

/// A degree of freedom: along an axis, or about one through the centre.
#[parameters]
#[serde(rename_all = "lowercase")]
pub enum Freedom {
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along z; three dimensions only.
    Z,
    /// About x; three dimensions only.
    Rx,
    /// About y; three dimensions only.
    Ry,
    /// About z: the only turn in two dimensions.
    Rz,
}

impl Freedom {
    /// Its place among the six.
    pub fn index(self) -> usize {
        self as usize
    }

    /// Those that there are in D dimensions.
    pub fn in_dimension(dimension: usize) -> &'static [Freedom] {
        match dimension {
            2 => &[Self::X, Self::Y, Self::Rz],
            _ => &[Self::X, Self::Y, Self::Z, Self::Rx, Self::Ry, Self::Rz],
        }
    }

    /// Name in scene files.
    pub fn name(self) -> &'static str {
        ["x", "y", "z", "rx", "ry", "rz"][self.index()]
    }
}

/// A spring and a damper on a displacement from where the body is drawn.
#[parameters]
pub struct Hold {
    /// Stiffness, N/m (per metre of depth in two dimensions).
    #[parameter(default, unit: "N/m", min: 0.0)]
    pub stiffness: f64,
    /// Damping, N s/m (per metre of depth in two dimensions).
    #[parameter(default, unit: "N s/m", min: 0.0)]
    pub damping: f64,
}

/// A spring and a damper on an angle from how the body is drawn.
#[parameters]
pub struct HoldTurn {
    /// Stiffness, N m/rad (per metre of depth in two dimensions).
    #[parameter(default, unit: "N m", min: 0.0)]
    pub stiffness: f64,
    /// Damping, N m s/rad (per metre of depth in two dimensions).
    #[parameter(default, unit: "N m s", min: 0.0)]
    pub damping: f64,
}

/// Springs and dampers on degrees of freedom.
#[parameters]
#[derive(Copy)]
pub struct Holds {
    /// Along x.
    #[parameter(default)]
    pub x: Option<Hold>,
    /// Along y.
    #[parameter(default)]
    pub y: Option<Hold>,
    /// Along z; three dimensions only.
    #[parameter(default)]
    pub z: Option<Hold>,
    /// About x; three dimensions only.
    #[parameter(default)]
    pub rx: Option<HoldTurn>,
    /// About y; three dimensions only.
    #[parameter(default)]
    pub ry: Option<HoldTurn>,
    /// About z.
    #[parameter(default)]
    pub rz: Option<HoldTurn>,
}

impl Holds {
    /// Stiffness and damping of those that are given, by their degree of freedom.
    pub fn all(&self) -> impl Iterator<Item = (Freedom, f64, f64)> {
        let along = [self.x, self.y, self.z].map(|h| h.map(|h| [h.stiffness, h.damping]));
        let about = [self.rx, self.ry, self.rz].map(|h| h.map(|h| [h.stiffness, h.damping]));
        let all = along.into_iter().chain(about);
        let named = Freedom::in_dimension(3).iter().zip(all);
        named.filter_map(|(f, h)| h.map(|[stiffness, damping]| (*f, stiffness, damping)))
    }
}
