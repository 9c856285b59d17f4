//! A heavy elastic line that hangs from its body to its anchor, perhaps with a part of it on the bed.

/// A line at rest under its weight (Irvine 1981; Jonkman 2007, Eq. 2-35 to 2-38, without friction of the bed).
///
/// With H the horizontal tension, V the vertical one at the body, T² = H² + V², and index a at the anchor, V_a = V − w L,
///
/// ```text
/// x = H/w (asinh V/H − asinh V_a/H) + H L/EA      z = (T − T_a)/w + (V L − w L²/2)/EA
/// ```
///
/// and where a part of the line lies on the bed, V < w L,
///
/// ```text
/// x = L − V/w + H/w asinh V/H + H L/EA            z = (T − H)/w + V²/(2 EA w)
/// ```
///
/// Both are the gradient of the convex energy U(H, V) = ∫ T + T²/(2 EA) ds. So H and V are where U − H x − V z is least, and
/// damped Newton steps find them from anywhere; the tangent stiffness is the inverse of the Hessian of U.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Catenary {
    /// Weight w in the fluid per length, N/m.
    pub weight: f64,
    /// Axial stiffness EA, N.
    pub axial: f64,
    /// Length L without tension, m.
    pub length: f64,
    /// True if there is a bed at the height of the anchor.
    pub bed: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hang {
    /// Horizontal tension H, N.
    pub across: f64,
    /// Vertical tension V at the body, N: the weight of the line that it carries.
    pub up: f64,
    /// ∂(H, V)/∂(x, z), N/m.
    pub stiffness: [[f64; 2]; 2],
}

/// Energy, its gradient (x, z), and its Hessian.
struct Energy {
    value: f64,
    place: [f64; 2],
    hessian: [[f64; 2]; 2],
}

/// Newton steps at most; a dozen are usual.
const STEPS: usize = 200;
/// Relative to the length, how far from its place the end may be.
const CLOSE: f64 = 1e-13;

impl Catenary {
    /// Vertical tension at the anchor; zero where the line lies on the bed.
    pub fn at_anchor(&self, up: f64) -> f64 {
        let below = up - self.weight * self.length;
        if self.bed { below.max(0.0) } else { below }
    }

    fn length_on_bed(&self, up: f64) -> f64 {
        match self.bed {
            true => (self.length - up / self.weight).max(0.0),
            false => 0.0,
        }
    }

    /// Shape of the line with its end x beside and z above the anchor, m; below the bed counts as on it.
    pub fn hang(&self, x: f64, z: f64) -> Hang {
        let z = if self.bed { z.max(0.0) } else { z };
        if let Some(slack) = self.slack(x, z) {
            return slack;
        }
        // Straight above the anchor H is none, but its stiffness is not: a nearby place has both.
        let target = [x.max(1e-7 * self.length), z];
        let [mut across, mut up] = self.guess(target);
        let mut energy = self.energy([across, up]);
        for _ in 0..STEPS {
            let missing = [0, 1].map(|k| target[k] - energy.place[k]);
            if missing.iter().all(|m| m.abs() <= CLOSE * self.length) {
                break;
            }
            let step = solved(&energy.hessian, missing);
            // H stays positive, and V of a line on a bed not negative.
            let mut share = 1.0_f64;
            if step[0] < 0.0 {
                share = share.min(-0.9 * across / step[0]);
            }
            if self.bed && up + share * step[1] < 0.0 && step[1] < 0.0 {
                share = share.min(-0.9 * up / step[1]);
            }
            let slope = missing[0] * step[0] + missing[1] * step[1];
            let merit = |e: &Energy, [h, v]: [f64; 2]| e.value - h * target[0] - v * target[1];
            let at = |share: f64| [across + share * step[0], up + share * step[1]];
            let before = merit(&energy, [across, up]);
            let mut next = self.energy(at(share));
            // Armijo, with room for rounding: near the end differences of energies are noise.
            let room = 1e-12 * before.abs();
            while share > 1e-10 && merit(&next, at(share)) > before - 1e-4 * share * slope + room {
                share *= 0.5;
                next = self.energy(at(share));
            }
            [across, up] = at(share);
            energy = next;
        }
        let [[a, b], [_, d]] = energy.hessian;
        let determinant = a * d - b * b;
        Hang {
            across,
            up,
            stiffness: [
                [d / determinant, -b / determinant],
                [-b / determinant, a / determinant],
            ],
        }
    }

    /// With enough of it on the bed it hangs straight down.
    fn slack(&self, x: f64, z: f64) -> Option<Hang> {
        let (w, axial) = (self.weight, self.axial);
        // z = V/w + V²/(2 EA w); written so that nothing cancels in stiff lines.
        let up = 2.0 * w * z / (1.0 + (1.0 + 2.0 * w * z / axial).sqrt());
        let hangs = self.bed && up <= w * self.length && self.length_on_bed(up) >= x;
        hangs.then(|| Hang {
            across: 0.0,
            up,
            stiffness: [[0.0, 0.0], [0.0, w / (1.0 + up / axial)]],
        })
    }

    /// Start of the search (Jonkman 2007, Eq. 2-39 and 2-40).
    fn guess(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let (w, length) = (self.weight, self.length);
        let lambda = if x * x + z * z >= length * length {
            0.2
        } else {
            (3.0 * ((length * length - z * z) / (x * x) - 1.0)).sqrt()
        };
        let up = 0.5 * w * (z / lambda.tanh() + length);
        let least = 1e-6 * w * length;
        let up = if self.bed { up.max(least) } else { up };
        [(0.5 * w * x / lambda).max(least), up]
    }

    fn energy(&self, [h, v]: [f64; 2]) -> Energy {
        let (w, axial, length) = (self.weight, self.axial, self.length);
        let lies = self.length_on_bed(v);
        // From where it leaves the bed, or from the anchor.
        let low = self.at_anchor(v);
        let [t, t_low] = [v, low].map(|v| h.hypot(v));
        let [angle, angle_low] = [v, low].map(|v| (v / h).asinh());
        let turn = angle - angle_low;
        // T − T_a without cancelling: V² − V_a² over their sum.
        let rise = (v - low) * (v + low) / (t + t_low);
        let hanging = length - lies;
        let stretch = hanging * 0.5 * (v + low);
        let cubes = (v * v + v * low + low * low) * hanging / 3.0;
        let value = (0.5 * (v * t - low * t_low + h * h * turn) / w + h * lies)
            + (h * h * length + cubes) / (2.0 * axial);
        let of_both = if lies > 0.0 {
            (h / t - 1.0) / w
        } else {
            -h * rise / (w * t * t_low)
        };
        let bend = (v / t - low / t_low) / w;
        Energy {
            value,
            place: [
                lies + h * turn / w + h * length / axial,
                rise / w + stretch / axial,
            ],
            hessian: [
                [turn / w - bend + length / axial, of_both],
                [of_both, bend + hanging / axial],
            ],
        }
    }

    /// Places of the line from the anchor to the end, (across, up) from the anchor, m.
    pub fn shape(&self, hang: &Hang, x: f64, pieces: usize) -> Vec<[f64; 2]> {
        let (w, axial, h) = (self.weight, self.axial, hang.across);
        let lies = self.length_on_bed(hang.up);
        let low = self.at_anchor(hang.up);
        let start = if h > 0.0 { lies * (1.0 + h / axial) } else { x };
        let t_low = h.hypot(low);
        let hanging = self.length - lies;
        let at = |k: usize| {
            let s = hanging * k as f64 / pieces as f64;
            let v = low + w * s;
            let rise = (v - low) * (v + low) / (h.hypot(v) + t_low).max(f64::MIN_POSITIVE);
            let across = match h > 0.0 {
                true => h * ((v / h).asinh() - (low / h).asinh()) / w + h * s / axial,
                false => 0.0,
            };
            [start + across, rise / w + s * (low + 0.5 * w * s) / axial]
        };
        let mut places = vec![[0.0, 0.0]];
        let first = usize::from(start <= 0.0);
        places.extend((first..=pieces).map(at));
        places
    }
}

fn solved([[a, b], [_, d]]: &[[f64; 2]; 2], [r, s]: [f64; 2]) -> [f64; 2] {
    let determinant = a * d - b * b;
    [(d * r - b * s) / determinant, (a * s - b * r) / determinant]
}

#[cfg(test)]
pub(crate) mod tests;
