//! `sph plugins kernel NAME… --picture FILE`: kernels and their slopes.

use std::path::Path;

use sph_core::PluginInfo;
use sph_io::{Panels, Plot, Series};
use sph_solver::kernels::{self, Kernel};

use super::picture;
use crate::terminal::Trouble;
use crate::tool_arguments::PluginArguments;

/// Points of a curve.
const POINTS: usize = 200;
/// The pictures are of the kernels of the plane.
const DIMENSION: usize = 2;

/// Draws w h² and −w' h³ over r/h in two dimensions.
pub fn draw(
    arguments: &PluginArguments,
    plugins: &[PluginInfo],
    file: &Path,
) -> Result<(), Trouble> {
    let of_laws = [
        ("--set", arguments.set.is_empty()),
        ("--vary", arguments.vary.is_none()),
        ("--pressure", arguments.pressure.is_empty()),
        ("--strain-rates", arguments.strain_rates.is_empty()),
        ("--strain", arguments.strain.is_none()),
    ];
    if let Some((option, _)) = of_laws.iter().find(|(_, left_out)| !left_out) {
        return Err(format!("{option} is for laws, not kernels").into());
    }
    let kernels = plugins.iter().map(|p| kernels::kernel(p.name));
    let kernels = kernels.collect::<Result<Vec<_>, _>>();
    picture::save(&panels(&kernels.map_err(|e| e.to_string())?), file)
}

fn panels(kernels: &[Box<dyn Kernel>]) -> Panels {
    let panel = |label: &str, of: &dyn Fn(&dyn Kernel, f64) -> f64| Plot {
        x_label: "r/h [1]".into(),
        y_label: label.into(),
        series: kernels.iter().map(|k| curve(&**k, of)).collect(),
        ..Plot::default()
    };
    Panels(vec![
        panel("w h² [1]", &|k, q| k.normalisation(DIMENSION) * k.value(q)),
        panel("−∂w/∂r h³ [1]", &|k, q| {
            -k.normalisation(DIMENSION) * k.derivative(q)
        }),
    ])
}

fn curve(kernel: &dyn Kernel, of: &dyn Fn(&dyn Kernel, f64) -> f64) -> Series {
    let end = kernel.support();
    let along = (0..=POINTS).map(|k| end * k as f64 / POINTS as f64);
    Series::line(kernel.name(), along.map(|q| [q, of(kernel, q)]).collect())
}
