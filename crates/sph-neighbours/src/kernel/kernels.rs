//! Kernels as plugins. The kernels themselves are in `sph-kernels`, which has no registry.

use sph_core::{PluginInfo, contract, parameters, schema_of, typed};
use sph_kernels::Kernel;

contract!(
    /// A kernel that a scene may name.
    pub KernelEntry, "kernel", One, "the smoothing function w(r, h)", Kernel, .by_default("wendland-c2")
);

#[parameters]
struct NoParameters {}

macro_rules! register {
    ($kernel:path, $name:literal, $summary:literal, $source:literal) => {
        sph_core::reexport::inventory::submit! {
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
        }
    };
}
sph_kernels::each_builtin!(register);

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
