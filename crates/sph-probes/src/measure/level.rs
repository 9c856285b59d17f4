//! Height up to which a quantity reaches a value.

/// Parts of a spacing between the heights at which the quantity is looked at.
const PARTS: f64 = 4.0;

/// Height, weight and value of a particle.
pub(crate) type HeightSample = [f64; 3];

/// The highest place at which the mean over the particles within a spacing, weighed with their weight and 1 − |Δz|/δr,
/// comes up to a value, m; between heights a quarter of a spacing apart it is linear. NaN where it does not.
pub(crate) fn highest_place(mut samples: Vec<HeightSample>, spacing: f64, wanted: f64) -> f64 {
    samples.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]));
    let (Some(top), Some(bottom)) = (samples.first(), samples.last()) else {
        return f64::NAN;
    };
    let step = spacing / PARTS;
    let mut first = 0;
    let mut above: Option<[f64; 2]> = None;
    let count = ((top[0] - bottom[0]) / step).floor() as usize;
    for k in 0..=count {
        let z = top[0] - step * k as f64;
        first += samples[first..].partition_point(|sample| sample[0] > z + spacing);
        let near = samples[first..]
            .iter()
            .take_while(|sample| sample[0] > z - spacing);
        let (mut whole, mut weight) = (0.0, 0.0);
        for [height, own, value] in near {
            let share = own * (1.0 - (height - z).abs() / spacing);
            whole += share * value;
            weight += share;
        }
        if weight <= 0.0 {
            continue;
        }
        let here = whole / weight;
        if here >= wanted {
            return match above {
                Some([before, height]) => {
                    height + (z - height) * (wanted - before) / (here - before)
                }
                None => z,
            };
        }
        above = Some([here, z]);
    }
    f64::NAN
}
