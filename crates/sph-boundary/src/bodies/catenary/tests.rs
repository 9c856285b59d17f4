//! Against closed forms.

use super::*;

const BED: Catenary = Catenary {
    weight: 1000.0,
    axial: 1e12,
    length: 250.0,
    bed: true,
};

/// A light chain that stretches.
pub(crate) const CHAIN: Catenary = Catenary {
    weight: 30.0,
    axial: 2e4,
    length: 2.0,
    bed: true,
};

/// For a line that does not stretch, hanging l_s = √(z² + 2 z H/w) of its length (Faltinsen 1990, Eq. 8.11 to 8.24):
/// x = L − l_s + H/w acosh(1 + w z/H), T = H + w z, and ∂H/∂x = w [acosh(1 + w z/H) − 2/√(1 + 2H/(w z))]⁻¹.
#[test]
fn tension_and_stiffness_of_a_line_partly_on_the_bed_are_those_of_the_closed_form() {
    let (w, z) = (BED.weight, 80.0);
    for h in [2e3, 2e4, 1e5, 2.5e5] {
        let hanging = (z * z + 2.0 * z * h / w).sqrt();
        assert!(hanging < BED.length);
        let x = BED.length - hanging + h / w * (1.0 + w * z / h).acosh();
        let hang = BED.hang(x, z);
        let off = (hang.across / h - 1.0).abs();
        // EA is a million times the tension.
        assert!(off < 1e-4, "H = {h}: off by {off:e}");
        let tension = hang.across.hypot(hang.up);
        let off = (tension / (h + w * z) - 1.0).abs();
        assert!(off < 1e-4, "T at H = {h}: off by {off:e}");
        // At constant z: the first number of the tangent.
        let stiffness = w / ((1.0 + w * z / h).acosh() - 2.0 / (1.0 + 2.0 * h / (w * z)).sqrt());
        let off = (hang.stiffness[0][0] / stiffness - 1.0).abs();
        assert!(off < 1e-3, "stiffness at H = {h}: off by {off:e}");
        assert_eq!(BED.at_anchor(hang.up), 0.0);
    }
}

/// Between two points of one height: L = 2 H/w sinh(w x/2H), and V = w L/2.
#[test]
fn a_chain_between_two_points_of_one_height_is_galileis() {
    let chain = Catenary { bed: false, ..BED };
    let (w, h) = (chain.weight, 5e4);
    let x = 2.0 * h / w * (w * chain.length / (2.0 * h)).asinh();
    let hang = chain.hang(x, 0.0);
    let off = (hang.across / h - 1.0).abs();
    assert!(off < 1e-5, "off by {off:e}");
    let off = (hang.up / (0.5 * w * chain.length) - 1.0).abs();
    assert!(off < 1e-9, "V off by {off:e}");
}

/// Without weight to speak of it is a spring of EA/L along the way between its ends.
#[test]
fn a_taut_light_line_is_a_spring() {
    let line = Catenary {
        weight: 1e-6,
        axial: 500.0,
        length: 4.0,
        bed: false,
    };
    let hang = line.hang(3.3, 4.4);
    let tension = 500.0 / 4.0 * 1.5;
    for (found, share) in [(hang.across, 0.6), (hang.up, 0.8)] {
        let off = (found / (tension * share) - 1.0).abs();
        assert!(off < 1e-6, "{found}: off by {off:e}");
    }
}

/// From straight down to pulled taut, on a bed and without: the end is where it was asked for, and the stiffness is the
/// slope of the tensions.
#[test]
fn the_end_is_where_it_is_held_and_the_stiffness_is_the_slope() {
    let mut worst = (0.0_f64, 0.0_f64);
    for bed in [true, false] {
        let chain = Catenary { bed, ..CHAIN };
        for x in [0.0, 0.3, 1.0, 1.7, 1.9, 2.05] {
            for z in [0.001, 0.2, 0.6, 1.2, 1.9] {
                let hang = chain.hang(x, z);
                if hang.across > 0.0 {
                    let place = chain.energy([hang.across, hang.up]).place;
                    let missed = (place[0] - x.max(2e-7)).hypot(place[1] - z);
                    worst.0 = worst.0.max(missed);
                }
                let step = 1e-6;
                let slopes = [(step, 0.0), (0.0, step)].map(|(dx, dz)| {
                    let [there, back] = [1.0, -1.0].map(|s| chain.hang(x + s * dx, z + s * dz));
                    [
                        (there.across - back.across) / (2.0 * step),
                        (there.up - back.up) / (2.0 * step),
                    ]
                });
                // At x = 0 the slope has a kink, and where the line leaves the bed the stiffness a jump.
                if x > 0.0 && hang.across > 1e-3 {
                    let scale = hang.stiffness[0][0].abs() + hang.stiffness[1][1].abs();
                    for (i, slope) in slopes.iter().enumerate() {
                        for (k, s) in slope.iter().enumerate() {
                            worst.1 = worst.1.max((s - hang.stiffness[k][i]).abs() / scale);
                        }
                    }
                }
            }
        }
    }
    println!("{worst:?}");
    assert!(worst.0 < 1e-11, "ends are {:e} m off", worst.0);
    // Differences over 1e-6 m of a stiffness that changes over centimetres.
    assert!(worst.1 < 1e-4, "slopes are off by {:e}", worst.1);
}

/// A line that hangs straight down carries its own weight: z = V/w + V²/(2 EA w).
#[test]
fn a_slack_line_carries_what_hangs() {
    let hang = CHAIN.hang(0.5, 0.6);
    assert_eq!(hang.across, 0.0);
    let (w, v) = (30.0, hang.up);
    assert!((v / w + v * v / (2.0 * 2e4 * w) - 0.6).abs() < 1e-12);
}

#[test]
fn the_shape_ends_at_its_end_and_never_goes_below_the_bed() {
    let chain = Catenary {
        axial: 2e3,
        ..CHAIN
    };
    for (x, z) in [(1.0, 0.6), (1.8, 0.6), (1.95, 0.6), (0.2, 0.6)] {
        let shape = chain.shape(&chain.hang(x, z), x, 32);
        let end = shape.last().expect("places");
        let missed = (end[0] - x).hypot(end[1] - z);
        assert!(missed < 1e-10, "({x}, {z}): {missed:e}");
        assert!(shape.iter().all(|p| p[1] >= -1e-15));
    }
}
