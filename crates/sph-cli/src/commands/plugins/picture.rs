//! `sph plugins KIND NAME… --picture FILE`: laws, sheared alone, and kernels with their slopes.

use std::path::Path;

use sph_core::{PluginInfo, number};
use sph_io::{Panels, Plot, Series};
use sph_solver::kernels::{self, Kernel};
use sph_solver::rheometer::{self, Rheology};

use super::law_sample::{self, LawSample};
use crate::commands::draw::{picture, quantity};
use crate::terminal::{Trouble, console};
use crate::tool_arguments::PluginArguments;

/// Strain rates in 1/s where none are given: the ends of the axis of a flow curve.
const ENDS: [f64; 2] = [1e-3, 1e2];
/// Those at which a law with an elastic part is sheared from rest.
const RATES: [f64; 4] = [0.01, 0.1, 1.0, 10.0];
/// Pressure in Pa at which laws with friction are sheared if none is given.
const PRESSURE: f64 = 1000.0;
/// Strain up to which laws are tried that do not yield before.
const FAR: f64 = 2.0;
const POINTS: usize = 200;
/// Most curves that can be distinguished.
const MOST: usize = 12;

/// A specimen at a pressure.
struct Curve<'s> {
    label: String,
    law: &'s dyn Rheology,
    pressure: f64,
}

pub fn draw_laws(asked: &PluginArguments, laws: &[PluginInfo], file: &Path) -> Result<(), Trouble> {
    picture("picture", file, &["svg", "png"])?;
    let samples = law_sample::all(laws, &asked.set, asked.vary.as_deref())?;
    let curves = curves(&samples, &numbers("pressure", &asked.pressure, "Pa")?)?;
    let elastic = curves.iter().filter(|c| c.law.elastic().is_some()).count();
    let rates = rates(&asked.strain_rates)?;
    let panels = match elastic {
        0 => flow(&curves, &rates)?,
        all if all == curves.len() => from_rest(&curves, &rates, strain(asked)?)?,
        _ => {
            return Err(Trouble::usage(
                "laws with and without an elastic part have no common picture: draw them apart",
            ));
        }
    };
    save(&panels, file)
}

fn save(panels: &Panels, file: &Path) -> Result<(), Trouble> {
    picture("picture", file, &["svg", "png"])?;
    panels.save(file).map_err(|e| e.to_string())?;
    console::out(&format!("wrote {}\n", file.display()));
    Ok(())
}

/// Every specimen at every pressure, or once if pressure does not matter to it.
fn curves<'s>(samples: &'s [LawSample], pressures: &[f64]) -> Result<Vec<Curve<'s>>, Trouble> {
    let given = or_else(pressures, &[PRESSURE]);
    let mut curves = Vec::new();
    for LawSample { label, law } in samples {
        let own: &[f64] = if law.needs().pressure { given } else { &[0.0] };
        curves.extend(own.iter().map(|&pressure| Curve {
            label: match law.needs().pressure {
                true => format!("{label}, {} Pa", number::plain(pressure)),
                false => label.clone(),
            },
            law: &**law,
            pressure,
        }));
    }
    no_more_than(MOST, curves.len())?;
    Ok(curves)
}

fn or_else<'n>(given: &'n [f64], others: &'n [f64]) -> &'n [f64] {
    if given.is_empty() { others } else { given }
}

fn no_more_than(most: usize, count: usize) -> Result<(), Trouble> {
    match count <= most {
        true => Ok(()),
        false => Err(Trouble::usage(format!(
            "{count} curves cannot be distinguished in one picture: {most} at most"
        ))),
    }
}

/// Shear stress over strain rate, and viscosity over it with logarithmic axes.
fn flow(curves: &[Curve], rates: &[f64]) -> Result<Panels, Trouble> {
    let [low, high] = ends(rates)?;
    // The first steps of the linear axis are as fine as the logarithmic one: laws bend there.
    let fine = spread(low, high, POINTS);
    let even = (1..=POINTS).map(|k| high * k as f64 / POINTS as f64);
    let mut along: Vec<f64> = fine.iter().copied().chain(even).collect();
    along.push(0.0);
    along.sort_by(f64::total_cmp);
    let stress = |c: &Curve| {
        let points = viscosity(c, &along).into_iter();
        points.map(|[g, eta]| [g, eta * g]).collect()
    };
    let series = |of: &dyn Fn(&Curve) -> Vec<[f64; 2]>| -> Vec<Series> {
        let all = curves.iter();
        all.map(|c| Series::line(&c.label, of(c))).collect()
    };
    Ok(Panels(vec![
        plot("strain rate [1/s]", "shear stress [Pa]", series(&stress)),
        viscosities(series(&|c| viscosity(c, &fine))),
    ]))
}

/// Shear stress over strain at constant rates from rest, and the viscosity if there is one.
fn from_rest(curves: &[Curve], rates: &[f64], strain: Option<f64>) -> Result<Panels, Trouble> {
    let rates = or_else(rates, &RATES);
    no_more_than(MOST, curves.len() * rates.len())?;
    let most = |c: &Curve| {
        let of = |&rate: &f64| yielded(c, rate);
        rates.iter().map(of).fold(0.0, f64::max)
    };
    let yielding = || curves.iter().map(most).fold(0.0, f64::max);
    let end = strain.unwrap_or_else(|| (4.0 * yielding()).min(FAR));
    let steps = 10 * POINTS;
    let strains: Vec<f64> = (0..=steps).map(|k| end * k as f64 / steps as f64).collect();
    let mut sheared = Vec::new();
    for c in curves {
        for &rate in rates {
            let stress = rheometer::shear_stresses(c.law, c.pressure, rate, &strains);
            let points = strains.iter().zip(stress).map(|(s, t)| [*s, t]);
            let label = format!("{}, {} 1/s", c.label, number::plain(rate));
            sheared.push(Series::line(label, points.step_by(10).collect()));
        }
    }
    let mut panels = vec![plot("shear strain [1]", "shear stress [Pa]", sheared)];
    let widened = |[a, b]: [f64; 2], r: &f64| [r.min(a), r.max(b)];
    let [low, high] = rates.iter().fold([f64::INFINITY, 0.0], widened);
    let fine = spread(low / 10.0, high * 10.0, POINTS);
    // A constant needs no panel.
    let viscous = curves.iter();
    let viscous = viscous.filter(|c| c.law.uniform_viscosity().is_none());
    let viscous = viscous.map(|c| Series::line(&c.label, viscosity(c, &fine)));
    let viscous: Vec<Series> = viscous.collect();
    if !viscous.is_empty() {
        panels.push(viscosities(viscous));
    }
    Ok(Panels(panels))
}

fn viscosities(series: Vec<Series>) -> Plot {
    Plot {
        log_x: true,
        log_y: true,
        ..plot("strain rate [1/s]", "viscosity [Pa s]", series)
    }
}

fn plot(x_label: &str, y_label: &str, series: Vec<Series>) -> Plot {
    Plot {
        x_label: x_label.into(),
        y_label: y_label.into(),
        series,
        ..Plot::default()
    }
}

/// The strain at which a shear from rest comes to 99 % of its largest stress.
fn yielded(curve: &Curve, rate: f64) -> f64 {
    let strains = spread(1e-7, FAR, 10 * POINTS);
    let stress = rheometer::shear_stresses(curve.law, curve.pressure, rate, &strains);
    let largest = stress.iter().fold(0.0_f64, |m, t| m.max(*t));
    let mut all = strains.iter().zip(stress);
    let found = all.find(|(_, t)| *t >= 0.99 * largest);
    found.map_or(FAR, |(s, _)| *s)
}

fn viscosity(curve: &Curve, rates: &[f64]) -> Vec<[f64; 2]> {
    let viscosity = rheometer::viscosities(curve.law, curve.pressure, rates);
    let points = rates.iter().zip(viscosity);
    points.map(|(g, eta)| [*g, eta]).collect()
}

/// Numbers from `low` to `high`, evenly spread over the decades.
fn spread(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = (high / low).ln() / (count - 1) as f64;
    (0..count).map(|k| low * (step * k as f64).exp()).collect()
}

fn ends(rates: &[f64]) -> Result<[f64; 2], Trouble> {
    match *rates {
        [] => Ok(ENDS),
        [low, high] if low < high => Ok([low, high]),
        _ => Err(Trouble::usage(
            "--strain-rates: a law without an elastic part takes two, the lower end of the axis and \
             the upper one",
        )),
    }
}

fn rates(given: &[String]) -> Result<Vec<f64>, Trouble> {
    let rates = numbers("strain-rates", given, "1/s")?;
    match rates.iter().find(|r| !(1e-12..=1e12).contains(*r)) {
        Some(wrong) => {
            Err(format!("--strain-rates: {wrong} 1/s is not between 1e-12 and 1e12").into())
        }
        None => Ok(rates),
    }
}

fn strain(arguments: &PluginArguments) -> Result<Option<f64>, Trouble> {
    match arguments.strain {
        Some(strain) if !(1e-12..=100.0).contains(&strain) => {
            Err(format!("--strain {strain}: expected a number between 1e-12 and 100").into())
        }
        strain => Ok(strain),
    }
}

fn numbers(option: &str, given: &[String], unit: &str) -> Result<Vec<f64>, Trouble> {
    let each = given.iter().map(|text| quantity(option, text, unit));
    each.collect()
}

/// The pictures are of the kernels of the plane.
const DIMENSION: usize = 2;

/// Draws w h² and −w' h³ over r/h in two dimensions.
pub fn draw_kernels(
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
    save(&panels(&kernels.map_err(|e| e.to_string())?), file)
}

fn panels(kernels: &[Box<dyn Kernel>]) -> Panels {
    let panel = |label: &str, of: &dyn Fn(&dyn Kernel, f64) -> f64| {
        let curves = kernels.iter().map(|kernel| {
            let along = (0..=POINTS).map(|k| kernel.support() * k as f64 / POINTS as f64);
            let points = along.map(|q| [q, of(&**kernel, q)]);
            Series::line(kernel.name(), points.collect())
        });
        plot("r/h [1]", label, curves.collect())
    };
    Panels(vec![
        panel("w h² [1]", &|k, q| k.normalisation(DIMENSION) * k.value(q)),
        panel("−∂w/∂r h³ [1]", &|k, q| {
            -k.normalisation(DIMENSION) * k.derivative(q)
        }),
    ])
}
