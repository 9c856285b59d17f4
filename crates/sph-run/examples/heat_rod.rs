//! A stranger's model: the temperature of a rod whose ends are cold. `cargo run -p sph-run --example heat_rod`.
//!
//! u_t = α u_xx on 0 < x < 1, u = 0 at both ends, at first u = sin(πx): exactly u = sin(πx) exp(−π²αt). Steps are explicit.

use std::f64::consts::PI;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sph_io::{Cells, FieldData, IoError, Picture, Piece};
use sph_run::{
    Frames, Identity, Model, Outlay, Progress, RunCounters, RunOptions, SavedState, Schedule,
    Start, Status, Watch, run, save_state,
};

type Outcome<T> = Result<T, IoError>;

/// Thermal diffusivity α, m²/s.
const DIFFUSIVITY: f64 = 0.1;

#[derive(Default, Serialize, Deserialize)]
struct Rod {
    /// α Δt/h² of a step; explicit ones are stable up to one half.
    share: f64,
    time: f64,
    steps: u64,
    dt: f64,
    temperature: Vec<f64>,
}

#[derive(Debug, Serialize)]
pub(crate) struct Summary {
    pub(crate) status: Status,
    pub(crate) steps: u64,
    /// Largest |u − exact|, K.
    pub(crate) error: f64,
}

fn places(cells: usize) -> impl Iterator<Item = f64> {
    (0..cells).map(move |k| (k as f64 + 0.5) / cells as f64)
}

impl Model for Rod {
    type Error = IoError;
    type Summary = Summary;

    fn begin(&mut self, start: &Start, own: &Path, _: &mut Watch<'_>) -> Outcome<RunCounters> {
        if *start == Start::Afresh {
            return Ok(RunCounters::default());
        }
        let saved = SavedState::load(own)?.state();
        let (rod, books) = saved.map_err(|problem| IoError::Unfit(own.into(), problem))?;
        *self = rod;
        Ok(books)
    }

    fn advance(&mut self, limit: f64, _: &mut Watch<'_>) -> Outcome<Progress> {
        if limit > self.time {
            let u = &self.temperature;
            let rate = DIFFUSIVITY * (u.len() as f64).powi(2);
            self.dt = (self.share / rate).min(limit - self.time);
            let share = rate * self.dt;
            // Beyond an end the temperature is that of the last cell, with the other sign.
            let step = |k: usize| {
                let left = k.checked_sub(1).map_or(-u[k], |k| u[k]);
                let right = u.get(k + 1).map_or(-u[k], |u| *u);
                u[k] + share * (left - 2.0 * u[k] + right)
            };
            self.temperature = (0..u.len()).map(step).collect();
            (self.time, self.steps) = (self.time + self.dt, self.steps + 1);
            if self.temperature.iter().any(|u| *u > 1.0) {
                let warmer = "warmer than at the start".to_string();
                return Err(IoError::Unfit("rod".into(), warmer));
            }
        }
        Ok(Progress {
            time: self.time,
            step: self.steps,
            dt: self.dt,
            limiter: "diffusion",
            particles: self.temperature.len(),
            ..Progress::default()
        })
    }

    fn columns(&self) -> Vec<(String, String)> {
        vec![("time".into(), "s".into()), ("largest".into(), "K".into())]
    }

    fn row(&mut self, _: &mut Watch<'_>) -> Outcome<Vec<f64>> {
        let largest = self.temperature.iter().copied().fold(0.0, f64::max);
        Ok(vec![self.time, largest])
    }

    fn show(&mut self, frames: Option<&mut Frames>, _: &mut Watch<'_>) -> Outcome<()> {
        let Some(frames) = frames else { return Ok(()) };
        let u = &self.temperature[..];
        let points: Vec<_> = places(u.len()).map(|x| [x, 0.0, 0.0]).collect();
        let mut picture = Picture::new(&points, u);
        picture.diameter = 1.0 / u.len() as f64;
        picture.save(frames.picture("temperature"))?;
        let rod = Piece {
            name: "rod".into(),
            points: points.into(),
            cells: Cells::Vertices,
            fields: vec![FieldData::scalar("temperature", "K", u)],
        };
        frames.add(self.time, vec![rod], 1)
    }

    fn save(&mut self, books: &RunCounters, own: &Path) -> Outcome<()> {
        save_state(own, "rod".into(), &(&*self, books))
    }

    fn conclude(
        &mut self,
        ended: Result<Status, &mut IoError>,
        _: &RunCounters,
        _: &mut Watch<'_>,
    ) -> Outcome<Option<Summary>> {
        let exact = |x: f64| (PI * x).sin() * (-PI * PI * DIFFUSIVITY * self.time).exp();
        let all = places(self.temperature.len()).zip(&self.temperature);
        Ok(Some(Summary {
            status: ended.unwrap_or(Status::Failed),
            steps: self.steps,
            error: all.map(|(x, u)| (u - exact(x)).abs()).fold(0.0, f64::max),
        }))
    }
}

/// Lets a rod of 50 cells cool for a second, with steps of a share α Δt/h².
pub(crate) fn cool(out: &Path, start: Start, share: f64, by: &mut Watch<'_>) -> Outcome<Summary> {
    let options = RunOptions::new(out, Identity::of_text("rod")).start(start);
    let outlay = Outlay {
        folders: vec!["pictures"],
        ..Outlay::default()
    };
    let mut rod = Rod {
        share,
        temperature: places(50).map(|x| (PI * x).sin()).collect(),
        ..Rod::default()
    };
    let summary = run(&mut rod, &options, &Schedule::every(0.1, 1.0), outlay, by)?;
    Ok(summary.expect("a summary of the one process"))
}

#[allow(dead_code, reason = "the test that includes this file has no main")]
fn main() -> Outcome<()> {
    let cooled = cool(Path::new("results/rod"), Start::Afresh, 0.4, &mut ());
    cooled.map(|summary| println!("{summary:?}"))
}
