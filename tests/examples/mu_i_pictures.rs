//! Draws the law μ(I) for docs/rheology/mu-i.md: shear stress over the strain rate, regularised in two
//! ways, and the run-out of the scenes `column-*` against the laws of Lube et al.
//!
//! ```sh
//! cargo run --release -p sph-tests --example mu_i_pictures [TABLE]
//! ```
//!
//! TABLE has an aspect ratio and a run-out per line; without it only the law is drawn.

use std::error::Error;
use std::path::Path;

use sph_io::{Plot, Series, Style};
use sph_rheology::{MuI, MuIRegularisation};

/// Sand of 0.32 mm, as in the scenes `column-*`.
fn sand(regularisation: MuIRegularisation) -> MuI {
    MuI {
        static_friction: 0.589045,
        limiting_friction: 1.248204,
        reference_inertial_number: 2.65,
        grain_diameter: 0.32e-3,
        grain_density: 2600.0,
        fluid_viscosity: 0.0,
        fluid_density: 0.0,
        drag_coefficient: 0.0,
        regularisation,
        largest_viscosity: None,
    }
}

/// Pressure of the picture, Pa.
const PRESSURE: f64 = 500.0;

fn main() -> Result<(), Box<dyn Error>> {
    let images = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/images");
    law(&images)?;
    match std::env::args().nth(1) {
        Some(table) => run_out(&std::fs::read_to_string(table)?, &images),
        None => Ok(()),
    }
}

/// τ/p over γ̇.
fn law(images: &Path) -> Result<(), Box<dyn Error>> {
    let rates = || (0..=200).map(|k| 10_f64.powf(-3.0 + 0.03 * f64::from(k)));
    let regularised = [
        (
            "chauchat-medale, 0.1 1/s",
            MuIRegularisation::ChauchatMedale { strain_rate: 0.1 },
        ),
        (
            "minatti-paris, 795 Pa, 1.2 s",
            MuIRegularisation::MinattiParis {
                yield_stress: 795.0,
                stress_growth: 1.2,
            },
        ),
        (
            "minatti-paris, 795 Pa, 12 s",
            MuIRegularisation::MinattiParis {
                yield_stress: 795.0,
                stress_growth: 12.0,
            },
        ),
    ];
    let plain = sand(MuIRegularisation::ChauchatMedale { strain_rate: 0.1 });
    let exact = rates().map(|rate| [rate, plain.friction(rate, PRESSURE)]);
    let mut series = vec![Series::styled("μ(I)", exact.collect(), Style::Dashes)];
    for (name, regularisation) in regularised {
        let law = sand(regularisation);
        let stress = rates().map(|rate| [rate, law.at(rate, PRESSURE) * rate / PRESSURE]);
        series.push(Series::line(name, stress.collect()));
    }
    let plot = Plot {
        title: "Sand of 0.32 mm at 500 Pa".into(),
        x_label: "strain rate [1/s]".into(),
        y_label: "shear stress over pressure [1]".into(),
        log_x: true,
        series,
        ..Plot::default()
    };
    Ok(plot.save(images.join("mu-i-law.png"))?)
}

/// Δr/r₀ over a.
fn run_out(table: &str, images: &Path) -> Result<(), Box<dyn Error>> {
    let mut found = Vec::new();
    for line in table.lines().filter(|line| !line.trim().is_empty()) {
        let mut numbers = line.split(|c: char| c == ',' || c.is_whitespace());
        let mut next = || numbers.by_ref().find(|n| !n.is_empty()).map(str::parse);
        match (next(), next()) {
            (Some(aspect), Some(run_out)) => found.push([aspect?, run_out?]),
            _ => return Err(format!("not two numbers: {line}").into()),
        }
    }
    let aspects = || (3..=64).map(|k| 0.05 * f64::from(k));
    let law = |f: fn(f64) -> f64| aspects().map(|a| [a, f(a)]).collect::<Vec<_>>();
    let plot = Plot {
        title: "Advance of the fronts of columns of sand, at 6√(H/g)".into(),
        x_label: "aspect ratio a = H/r₀ [1]".into(),
        y_label: "Δr/r₀ [1]".into(),
        series: vec![
            Series::line(
                "round columns, Lube et al. 2004",
                law(|a| if a < 1.7 { 1.24 * a } else { 1.6 * a.sqrt() }),
            ),
            Series::styled(
                "channel, Lube et al. 2005",
                law(|a| match a {
                    _ if a < 1.8 => 1.2 * a,
                    _ if a > 2.8 => 1.9 * a.powf(2.0 / 3.0),
                    // Between the two the source gives no law.
                    _ => f64::NAN,
                }),
                Style::Dashes,
            ),
            Series::markers("scenes column-*", found),
        ],
        ..Plot::default()
    };
    Ok(plot.save(images.join("columns-runout.png"))?)
}
