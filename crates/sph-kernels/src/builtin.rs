//! The catalogue of kernels that come with the crate.

use crate::{
    Kernel, PolynomialKernel, cubic_spline, quartic_spline, quintic_spline, wendland_c2,
    wendland_c4, wendland_c6,
};

/// All kernels of this crate, ready to be registered under their names.
///
/// ```
/// use sph_kernels::{Kernel, builtin};
/// let names: Vec<_> = builtin().iter().map(|kernel| kernel.name().to_owned()).collect();
/// assert_eq!(names[0], "wendland-c2");
/// assert_eq!(names.len(), 6);
/// ```
pub fn builtin() -> Vec<PolynomialKernel> {
    vec![
        wendland_c2(),
        wendland_c4(),
        wendland_c6(),
        cubic_spline(),
        quartic_spline(),
        quintic_spline(),
    ]
}

/// The built-in kernel of that name in scene files, for example `"quintic-spline"`.
pub fn by_name(name: &str) -> Option<PolynomialKernel> {
    builtin().into_iter().find(|kernel| kernel.name() == name)
}
