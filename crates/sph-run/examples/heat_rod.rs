//! A stranger's model: the temperature of a rod whose ends are cold. `cargo run -p sph-run --example heat_rod`.
//!
//! u_t = α u_xx on 0 < x < 1, u = 0 at both ends, at first u = sin(πx): exactly u = sin(πx) exp(−π²αt). Steps are explicit.

use std::f64::consts::PI;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sph_io::{Cells, FieldData, IoError, Piece};
use sph_run::{
    Frames, Identity, Model, Outlay, Progress, RunCounters, RunOptions, SavedState, Schedule,
    Start, Status, Watch, run, save_state,
};

/// Thermal diffusivity α, m²/s.
const DIFFUSIVITY: f64 = 0.1;

#[derive(Default, Serialize, Deserialize)]
struct Rod {
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

impl Rod {
    fn new(cells: usize) -> Self {
        Rod {
            temperature: places(cells).map(|x| (PI * x).sin()).collect(),
            ..Rod::default()
        }
    }
}

fn places(cells: usize) -> impl Iterator<Item = f64> {
    (0..cells).map(move |k| (k as f64 + 0.5) / cells as f64)
}

impl Model for Rod {
    type Error = IoError;
    type Summary = Summary;

    fn begin(
        &mut self,
        start: &Start,
        own: &Path,
        _: &mut Watch<'_>,
    ) -> Result<RunCounters, IoError> {
        if *start == Start::Afresh {
            return Ok(RunCounters::default());
        }
        let path = own.to_path_buf();
        let saved = SavedState::load(own)?.state();
        let (rod, books) = saved.map_err(|problem| IoError::Unfit(path, problem))?;
        *self = rod;
        Ok(books)
    }

    fn advance(&mut self, limit: f64, _: &mut Watch<'_>) -> Result<Progress, IoError> {
        if limit > self.time {
            let u = &self.temperature;
            let cells = u.len() as f64;
            self.dt = (0.4 / (cells * cells * DIFFUSIVITY)).min(limit - self.time);
            let share = DIFFUSIVITY * self.dt * cells * cells;
            // Beyond an end the temperature is that of the last cell, with the other sign.
            let step = |k: usize| {
                let left = k.checked_sub(1).map_or(-u[k], |k| u[k]);
                let right = u.get(k + 1).map_or(-u[k], |u| *u);
                u[k] + share * (left - 2.0 * u[k] + right)
            };
            self.temperature = (0..u.len()).map(step).collect();
            self.time += self.dt;
            self.steps += 1;
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

    fn row(&mut self, _: &mut Watch<'_>) -> Result<Vec<f64>, IoError> {
        let largest = self.temperature.iter().copied().fold(0.0, f64::max);
        Ok(vec![self.time, largest])
    }

    fn show(&mut self, frames: Option<&mut Frames>, _: &mut Watch<'_>) -> Result<(), IoError> {
        let points: Vec<_> = places(self.temperature.len())
            .map(|x| [x, 0.0, 0.0])
            .collect();
        let rod = Piece {
            name: "rod".into(),
            points: points.into(),
            cells: Cells::Vertices,
            fields: vec![FieldData::scalar("temperature", "K", &self.temperature[..])],
        };
        frames.map_or(Ok(()), |frames| frames.add(self.time, vec![rod], 1))
    }

    fn save(&mut self, books: &RunCounters, own: &Path) -> Result<(), IoError> {
        save_state(own, "rod".into(), &(&*self, books))
    }

    fn conclude(
        &mut self,
        ended: Result<Status, &mut IoError>,
        _: &RunCounters,
        _: &mut Watch<'_>,
    ) -> Result<Option<Summary>, IoError> {
        let exact = |x: f64| (PI * x).sin() * (-PI * PI * DIFFUSIVITY * self.time).exp();
        let all = places(self.temperature.len()).zip(&self.temperature);
        Ok(Some(Summary {
            status: ended.unwrap_or(Status::Failed),
            steps: self.steps,
            error: all.map(|(x, u)| (u - exact(x)).abs()).fold(0.0, f64::max),
        }))
    }
}

/// Lets a rod of 50 cells cool for a second.
pub(crate) fn cool(out: &Path, start: Start, observer: &mut Watch<'_>) -> Result<Summary, IoError> {
    let options = RunOptions::new(out, Identity::of_text("rod")).start(start);
    let schedule = Schedule::every(0.1, 1.0);
    let mut rod = Rod::new(50);
    let summary = run(&mut rod, &options, &schedule, Outlay::default(), observer)?;
    Ok(summary.expect("a summary of the one process"))
}

#[allow(dead_code, reason = "the test that includes this file has no main")]
fn main() -> Result<(), IoError> {
    println!(
        "{:?}",
        cool(Path::new("results/rod"), Start::Afresh, &mut ())?
    );
    Ok(())
}
