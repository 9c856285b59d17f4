//! Integrals of smooth functions.

/// Gauss–Legendre with ten points.
const RULE: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_22, 0.295_524_224_714_752_87],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_14],
];

/// ∫ f of one panel.
pub fn gauss<const N: usize>(f: &mut impl FnMut(f64) -> [f64; N], a: f64, b: f64) -> [f64; N] {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut sum = [0.0; N];
    for [x, w] in RULE {
        for x in [middle - half * x, middle + half * x] {
            for (sum, f) in sum.iter_mut().zip(f(x)) {
                *sum += w * half * f;
            }
        }
    }
    sum
}

/// ∫ f with panels halved until they agree to `tolerance`.
pub fn adaptive<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    [a, b]: [f64; 2],
    tolerance: f64,
) -> [f64; N] {
    let whole = gauss(f, a, b);
    refined(f, [a, b], whole, tolerance, 40)
}

fn refined<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    [a, b]: [f64; 2],
    whole: [f64; N],
    tolerance: f64,
    depth: u32,
) -> [f64; N] {
    let middle = 0.5 * (a + b);
    let (left, right) = (gauss(f, a, middle), gauss(f, middle, b));
    let agree = (0..N).all(|i| (left[i] + right[i] - whole[i]).abs() <= tolerance);
    if agree || depth == 0 {
        return std::array::from_fn(|i| left[i] + right[i]);
    }
    let left = refined(f, [a, middle], left, tolerance, depth - 1);
    let right = refined(f, [middle, b], right, tolerance, depth - 1);
    std::array::from_fn(|i| left[i] + right[i])
}

/// ∫ f over panels between ascending bounds, restricted to [a, b].
pub fn between(f: &mut impl FnMut(f64) -> f64, bounds: &[f64], a: f64, b: f64) -> f64 {
    let pieces = bounds.windows(2).map(|x| [x[0].max(a), x[1].min(b)]);
    let panels = pieces.filter(|[a, b]| a < b);
    panels.map(|[a, b]| gauss(&mut |x| [f(x)], a, b)[0]).sum()
}
