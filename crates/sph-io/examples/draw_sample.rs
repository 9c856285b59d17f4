//! Draws the pictures of the README into a folder and says how long each took.
//!
//! `cargo run --release -p sph-io --example draw_sample -- DIR`

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use sph_io::{ColourMap, Picture, Plot, Series, Style, View, writable};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("usage: draw_sample DIR")?);
    writable(&folder)?;
    let file = |name: &str| folder.join(name);

    let column = heap(20_000);
    let pressure = values(&column, |p| 9810.0 * (surface(p[0]) - p[1]));
    let tank = tank(1.6, 0.8);
    let dam_break = Picture {
        title: "Dam break",
        time: Some(0.35),
        label: "pressure [Pa]",
        diameter: 0.00427,
        walls: &tank,
        ..Picture::new(&column, &pressure)
    };
    let start = Instant::now();
    dam_break.save(file("dam_break.png"))?;
    println!("{} particles in {:?}", column.len(), start.elapsed());

    let vorticity = values(&column, |p| 60.0 * (9.0 * p[0]).sin() * p[1]);
    Picture {
        title: "Vorticity, clipped range",
        label: "vorticity [1/s]",
        colours: ColourMap::CoolWarm,
        range: Some([-20.0, 20.0]),
        values: &vorticity,
        ..dam_break
    }
    .save(file("vorticity.png"))?;

    let ball = ball(30);
    let height = values(&ball, |p| 2.4e5 * p[2]);
    Picture {
        title: "Ball, front view",
        time: Some(0.0021),
        label: "pressure [Pa]",
        diameter: 1.0 / 30.0,
        view: View::Front,
        width: 800,
        ..Picture::new(&ball, &height)
    }
    .save(file("ball.png"))?;

    let flume: Vec<[f64; 3]> = (0..4000).map(|i| [0.01 * f64::from(i), 0.1, 0.0]).collect();
    let depth = values(&flume, |p| p[0].sin());
    Picture {
        title: "Flume",
        label: "depth [m]",
        diameter: 0.2,
        ..Picture::new(&flume, &depth)
    }
    .save(file("flume.png"))?;
    let tower: Vec<[f64; 3]> = flume
        .iter()
        .map(|p| [p[1] * 1e-3, p[0] * 1e-3, 0.0])
        .collect();
    Picture {
        title: "Tower",
        label: "depth [m]",
        diameter: 2e-4,
        ..Picture::new(&tower, &depth)
    }
    .save(file("tower.png"))?;

    for (plot, name) in [(probe(), "probe"), (convergence(), "convergence")] {
        let start = Instant::now();
        plot.save(file(&format!("{name}.png")))?;
        plot.save(file(&format!("{name}.svg")))?;
        println!("{name} in {:?}", start.elapsed());
    }
    Ok(())
}

fn values(points: &[[f64; 3]], value: impl Fn(&[f64; 3]) -> f64) -> Vec<f64> {
    points.iter().map(value).collect()
}

fn surface(x: f64) -> f64 {
    0.55 * (-2.2 * x * x).exp() + 0.03 * (14.0 * x).sin() * x + 0.02
}

/// At most `count` particles below the surface.
fn heap(count: usize) -> Vec<[f64; 3]> {
    let spacing = 0.00427;
    let at = |i: usize| (i as f64 + 0.5) * spacing;
    let below = |x: f64| (0..).map(at).take_while(move |&y| y < surface(x));
    (0..374)
        .map(at)
        .flat_map(|x| below(x).map(move |y| [x, y, 0.0]))
        .take(count)
        .collect()
}

/// Open at the top.
fn tank(width: f64, height: f64) -> [[[f64; 3]; 2]; 3] {
    let [a, b] = [[0.0, height, 0.0], [0.0; 3]];
    let [c, d] = [[width, 0.0, 0.0], [width, height, 0.0]];
    [[a, b], [b, c], [c, d]]
}

/// A ball of 1 m.
fn ball(across: usize) -> Vec<[f64; 3]> {
    let at = |i: usize| (i as f64 + 0.5) / across as f64 - 0.5;
    let place = |i: usize| {
        [
            at(i % across),
            at(i / across % across),
            at(i / across / across),
        ]
    };
    let inside = |p: &[f64; 3]| p.iter().map(|x| x * x).sum::<f64>() < 0.25;
    (0..across.pow(3)).map(place).filter(inside).collect()
}

/// A computed signal against a measured one with its scatter.
fn probe() -> Plot {
    let signal = |t: f64| 1.1e4 * (t - 0.6).max(0.0).sqrt() * (-1.6 * (t - 0.6)).exp();
    let time = |i: i32| 0.001 * f64::from(i);
    let noisy = |t: f64| signal(t) + 120.0 * (190.0 * t).sin() * (t - 0.6).clamp(0.0, 0.4);
    let fine: Vec<[f64; 2]> = (0..2500).map(|i| [time(i), noisy(time(i))]).collect();
    let coarse: Vec<[f64; 2]> = (0..60)
        .map(|i| 0.042 * f64::from(i))
        .map(|t| [t, 0.97 * signal(t)])
        .collect();
    let lower = coarse.iter().map(|p| [p[0], 0.9 * p[1]]).collect();
    let upper = coarse.iter().map(|p| 1.12 * p[1]).collect();
    Plot {
        title: "Dam break: pressure at P1".into(),
        x_label: "time [s]".into(),
        y_label: "pressure [Pa]".into(),
        series: vec![
            Series::band("experiment, 2.5–97.5 %", lower, upper),
            Series::line("SPH, δr = 5 mm", fine),
            Series::markers("experiment, median", coarse),
        ],
        ..Plot::default()
    }
}

/// Errors against run times.
fn convergence() -> Plot {
    let line = |scale: f64, order: f64| -> Vec<[f64; 2]> {
        let at = |i: i32| 2_f64.powi(i);
        (0..6)
            .map(|i| [0.3 * at(3 * i), scale * at(-i).powf(order)])
            .collect()
    };
    let marked = |name: &str, points| Series::styled(name, points, Style::LineAndMarkers);
    Plot {
        title: "Taylor–Green vortex: error against run time".into(),
        x_label: "run time [s]".into(),
        y_label: "relative L₂ error of the velocity [1]".into(),
        log_x: true,
        log_y: true,
        series: vec![
            marked("Wendland C2", line(0.08, 1.1)),
            marked("Wendland C4", line(0.11, 1.6)),
            marked("quintic spline", line(0.05, 1.4)),
            Series::styled("second order", line(0.03, 2.0), Style::Dashes),
        ],
    }
}
