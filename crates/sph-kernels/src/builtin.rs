//! The kernels that come with the crate: name, summary, source and shape of each in one place.

use crate::algebra::{power, product, scaled, sum};
use crate::{Kernel, PiecewisePolynomial, PolynomialKernel};

/// Declares kernels: `function, "name", "one sentence", "source", shape;`.
macro_rules! kernels {
    ($($(#[$doc:meta])* $kernel:ident, $name:literal, $summary:literal, $source:literal, $shape:expr;)+) => {
        $($(#[$doc])*
        pub fn $kernel() -> PolynomialKernel {
            PolynomialKernel::new($name, $shape)
        })+

        /// All kernels of this crate, ready to be registered under their names.
        ///
        /// ```
        /// use sph_kernels::{Kernel, builtin};
        /// let names: Vec<_> = builtin().iter().map(|kernel| kernel.name().to_owned()).collect();
        /// assert_eq!(names[0], "wendland-c2");
        /// assert_eq!(names.len(), 6);
        /// ```
        pub fn builtin() -> Vec<PolynomialKernel> {
            vec![$($kernel()),+]
        }

        /// Calls a macro with the function, name, summary and source of every kernel of this crate.
        #[macro_export]
        macro_rules! each_builtin {
            ($register:ident) => {
                $($register! { $crate::$kernel, $name, $summary, $source })+
            };
        }
    };
}

/// The built-in kernel of that name in scene files, for example `"quintic-spline"`.
pub fn by_name(name: &str) -> Option<PolynomialKernel> {
    builtin().into_iter().find(|kernel| kernel.name() == name)
}

kernels! {
    /// Wendland C2, the kernel of "fifth order" in USAW work.
    ///
    /// f(q) = (1 − q/2)⁴ (1 + 2q) for q < 2, twice continuously differentiable;
    /// f'(q) = −5q (1 − q/2)³. σ_d = 3/4, 7/(4π), 21/(16π) for d = 1, 2, 3.
    ///
    /// Its Fourier transform is positive in one to three dimensions: no pairing instability.
    /// This is the function of d = 2, 3 and it is used in 1D too; the field also knows
    /// (1 − q/2)³ (1 + 3q/2), which is C2 and of lower degree but positive definite in 1D only.
    ///
    /// Source: Wendland (1995), doi:10.1007/BF02123482; Ghaïtanellis (2017), eqs. (2.17)–(2.19).
    ///
    /// ```
    /// use sph_kernels::Kernel;
    /// assert_eq!(sph_kernels::wendland_c2().value(1.0), 3.0 / 16.0);
    /// ```
    wendland_c2, "wendland-c2", "Wendland C2, support 2h: no pairing",
        "Wendland 1995; Ghaïtanellis 2017, Eq. 2.17", wendland(4, &[1.0, 2.0]);

    /// Wendland C4.
    ///
    /// f(q) = (1 − q/2)⁶ (1 + 3q + 35/12 q²) for q < 2, four times continuously differentiable.
    /// 35/12 being no binary fraction, moments are good to 10⁻¹³ instead of the last bit.
    /// σ_d = 9/(4π), 495/(256π) for d = 2, 3, and 27/32 for the same function in 1D.
    ///
    /// Positive Fourier transform in one to three dimensions; see [`wendland_c2`] about 1D.
    ///
    /// Source: Wendland (1995), doi:10.1007/BF02123482; Dehnen & Aly (2012),
    /// doi:10.1111/j.1365-2966.2012.21439.x, table 1.
    ///
    /// ```
    /// use sph_kernels::Kernel;
    /// let value = sph_kernels::wendland_c4().value(1.0); // 83/768
    /// assert!((value - 83.0 / 768.0).abs() < 1e-15);
    /// ```
    wendland_c4, "wendland-c4", "Wendland C4, support 2h: smoother, needs more neighbours",
        "Wendland 1995; Dehnen & Aly 2012, Table 1", wendland(6, &[1.0, 3.0, 35.0 / 12.0]);

    /// Wendland C6.
    ///
    /// f(q) = (1 − q/2)⁸ (1 + 4q + 25/4 q² + 4q³) for q < 2, six times continuously differentiable. σ_d = 39/(14π),
    /// 1365/(512π) for d = 2, 3, and 15/16 for the same function in 1D.
    ///
    /// Positive Fourier transform in one to three dimensions; see [`wendland_c2`] about 1D.
    ///
    /// Source: Wendland (1995), doi:10.1007/BF02123482; Dehnen & Aly (2012),
    /// doi:10.1111/j.1365-2966.2012.21439.x, table 1.
    ///
    /// ```
    /// use sph_kernels::Kernel;
    /// assert_eq!(sph_kernels::wendland_c6().value(1.0), 61.0 / 1024.0);
    /// ```
    wendland_c6, "wendland-c6", "Wendland C6, support 2h: smoothest, needs most neighbours",
        "Wendland 1995; Dehnen & Aly 2012, Table 1", wendland(8, &[1.0, 4.0, 6.25, 4.0]);

    /// Cubic spline M4, support 2h.
    ///
    /// f(q) = ¼ (2 − q)₊³ − (1 − q)₊³, that is 1 − 3/2 q² + 3/4 q³ for q < 1; twice continuously
    /// differentiable. σ_d = 2/3, 10/(7π), 1/π for d = 1, 2, 3.
    ///
    /// The Fourier transform has negative lobes in two and three dimensions (lowest ŵ/ŵ(0): −6.4·10⁻⁴ at kh = 7.3 and
    /// −6.0·10⁻⁴ at 7.9): particles pair when they have too many neighbours.
    ///
    /// Source: Monaghan & Lattanzio (1985), A&A 149, 135, eq. (21); Price (2012), doi:10.1016/j.jcp.2010.12.011.
    ///
    /// ```
    /// use sph_kernels::Kernel;
    /// assert_eq!(sph_kernels::cubic_spline().value(1.0), 0.25);
    /// ```
    cubic_spline, "cubic-spline", "cubic B-spline, support 2h",
        "Monaghan & Lattanzio 1985", spline(3, &[(2.0, 0.25), (1.0, -1.0)]);

    /// Quartic spline M5, support 2.5h.
    ///
    /// f(q) = (5/2 − q)₊⁴ − 5 (3/2 − q)₊⁴ + 10 (1/2 − q)₊⁴; three times continuously
    /// differentiable. σ_d = 1/24, 96/(1199π), 1/(20π) for d = 1, 2, 3.
    ///
    /// Negative lobes of the Fourier transform, already in 1D (2D: −1.9·10⁻⁴ at kh = 9.5, 3D:
    /// −7.9·10⁻⁵ at 9.9), see [`cubic_spline`].
    ///
    /// Source: Schoenberg (1946), Q. Appl. Math. 4; Price (2012), doi:10.1016/j.jcp.2010.12.011.
    ///
    /// ```
    /// use sph_kernels::Kernel;
    /// assert_eq!(sph_kernels::quartic_spline().value(1.5), 1.0);
    /// ```
    quartic_spline, "quartic-spline", "quartic B-spline, support 2.5h",
        "Schoenberg 1946; Morris 1996", spline(4, &[(2.5, 1.0), (1.5, -5.0), (0.5, 10.0)]);

    /// Quintic spline M6, support 3h.
    ///
    /// f(q) = (3 − q)₊⁵ − 6 (2 − q)₊⁵ + 15 (1 − q)₊⁵; four times continuously differentiable.
    /// σ_d = 1/120, 7/(478π), 1/(120π) for d = 1, 2, 3.
    ///
    /// Negative lobes of the Fourier transform in two and three dimensions (−2.5·10⁻⁵ at
    /// kh = 7.6, −2.2·10⁻⁵ at 8.1), see [`cubic_spline`].
    ///
    /// Source: Schoenberg (1946), Q. Appl. Math. 4; Price (2012), doi:10.1016/j.jcp.2010.12.011.
    ///
    /// ```
    /// use sph_kernels::Kernel;
    /// assert_eq!(sph_kernels::quintic_spline().value(0.0), 66.0);
    /// ```
    quintic_spline, "quintic-spline", "quintic B-spline, support 3h",
        "Schoenberg 1946; Morris et al. 1997", spline(5, &[(3.0, 1.0), (2.0, -6.0), (1.0, 15.0)]);
}

/// Wendland functions, support 2h: (1 − q/2)ⁿ times a polynomial of least degree on [0, 2).
fn wendland(n: usize, factor: &[f64]) -> PiecewisePolynomial {
    PiecewisePolynomial {
        breaks: vec![0.0, 2.0],
        pieces: vec![product(&power(&[1.0, -0.5], n), factor)],
    }
}

/// Schoenberg's B-splines: Σ weight (edge − q)₊ⁿ over the (edge, weight) list, edges descending.
fn spline(n: usize, terms: &[(f64, f64)]) -> PiecewisePolynomial {
    let mut breaks = vec![0.0];
    let mut pieces = Vec::new();
    for k in (0..terms.len()).rev() {
        let add = |total: Vec<f64>, (edge, weight): &(f64, f64)| {
            sum(&total, &scaled(&power(&[*edge, -1.0], n), *weight))
        };
        breaks.push(terms[k].0);
        pieces.push(terms[..=k].iter().fold(Vec::new(), add));
    }
    PiecewisePolynomial { breaks, pieces }
}
