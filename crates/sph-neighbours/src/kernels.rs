//! Kernels as plugins. The kernels themselves live in `sph-kernels`, which knows no registry.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::{PluginInfo, contract, schema_of, typed};
use sph_kernels::{
    Kernel, cubic_spline, quartic_spline, quintic_spline, wendland_c2, wendland_c4, wendland_c6,
};

contract!(
    /// A kernel that a scene may name.
    pub KernelEntry, "kernel", "the smoothing function w(r, h)", Kernel
);

/// The table of a kernel without parameters.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct NoParameters {}

macro_rules! built_in {
    ($($kernel:path, $name:literal, $summary:literal, $source:literal;)+) => {
        $(sph_core::reexport::inventory::submit! {
            KernelEntry {
                info: PluginInfo {
                    name: $name,
                    summary: $summary,
                    source: $source,
                    provider: concat!("sph-kernels ", env!("CARGO_PKG_VERSION")),
                    dimensions: &[2, 3],
                    schema: schema_of::<NoParameters>,
                },
                build: |table| {
                    typed::<NoParameters>(table)?;
                    Ok(Box::new($kernel()))
                },
            }
        })+
    };
}

built_in! {
    wendland_c2, "wendland-c2", "Wendland C2, support 2h: no pairing",
        "Wendland 1995; Ghaïtanellis 2017, Eq. 2.17";
    wendland_c4, "wendland-c4", "Wendland C4, support 2h: smoother, wants more neighbours",
        "Wendland 1995; Dehnen & Aly 2012, Table 1";
    wendland_c6, "wendland-c6", "Wendland C6, support 2h: smoothest, wants most neighbours",
        "Wendland 1995; Dehnen & Aly 2012, Table 1";
    cubic_spline, "cubic-spline", "cubic B-spline, support 2h",
        "Monaghan & Lattanzio 1985";
    quartic_spline, "quartic-spline", "quartic B-spline, support 2.5h",
        "Morris 1996";
    quintic_spline, "quintic-spline", "quintic B-spline, support 3h",
        "Morris et al. 1997";
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_core::Registry;

    #[test]
    fn every_built_in_kernel_is_registered_under_its_own_name() {
        let registry = Registry::<KernelEntry>::discovered().unwrap();
        for kernel in sph_kernels::builtin() {
            let entry = registry.find(kernel.name()).unwrap();
            let built = (entry.build)(&toml::Table::new()).unwrap();
            assert_eq!(built.name(), kernel.name());
            assert_eq!(built.support(), kernel.support());
        }
        assert_eq!(registry.entries().len(), sph_kernels::builtin().len());
    }
}
