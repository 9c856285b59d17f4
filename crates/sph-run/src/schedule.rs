//! When something is due.

use crate::model::{RunCounters, Status};

/// When rows, fields and checkpoints are due, and when a run is over.
pub struct Schedule<'a> {
    /// Simulated time at the end, s.
    pub end: f64,
    /// Simulated time between rows of the series, s.
    pub rows: f64,
    /// The first output of fields after a time, s.
    pub next_output: Box<dyn Fn(f64) -> Option<f64> + Sync + 'a>,
    /// True if steps end where fields are due.
    pub hits_outputs: bool,
    /// Simulated time between checkpoints, s.
    pub checkpoints: f64,
    /// Largest number of steps.
    pub max_steps: Option<u64>,
    /// Outcome of a run with that many steps.
    pub capped: Status,
    /// Wall-clock time after which the run stops with a checkpoint, s.
    pub max_wall: Option<f64>,
}

/// Outputs that are due.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DueOutputs {
    /// A row of the series.
    pub row: bool,
    /// Fields.
    pub output: bool,
    /// A checkpoint.
    pub checkpoint: bool,
}

impl DueOutputs {
    pub fn any(self) -> bool {
        self.row || self.output || self.checkpoint
    }
}

/// The first multiple of an interval after a time, or the `end` where it is beyond; all in s.
pub fn next_multiple(interval: f64, end: f64, time: f64) -> Option<f64> {
    match time < 0.0 {
        true => Some(0.0),
        false => (time < end).then(|| ((over(time, interval) + 1) as f64 * interval).min(end)),
    }
}

/// Number of intervals that are over by a time, s.
fn over(time: f64, every: f64) -> u64 {
    (time / every).floor() as u64
}

impl Schedule<'_> {
    /// Fields every so many seconds until an `end`, s; ten rows and one checkpoint for each. Steps end where they are due.
    pub fn every(interval: f64, end: f64) -> Self {
        Schedule {
            end,
            rows: 0.1 * interval,
            next_output: Box::new(move |time| next_multiple(interval, end, time)),
            hits_outputs: true,
            checkpoints: interval,
            max_steps: None,
            capped: Status::Interrupted,
            max_wall: None,
        }
    }

    /// Outputs that are due at a time, s.
    pub(crate) fn due(&self, time: f64, books: &RunCounters) -> DueOutputs {
        let written = books.last_row == Some(time);
        DueOutputs {
            row: !written && (time >= books.rows as f64 * self.rows || time >= self.end),
            output: books.next_output.is_some_and(|t| time >= t),
            checkpoint: over(time, self.checkpoints) > books.checkpoints || time >= self.end,
        }
    }

    /// The next time that is hit exactly.
    pub(crate) fn target(&self, books: &RunCounters) -> f64 {
        let output = books.next_output.filter(|_| self.hits_outputs);
        output.unwrap_or(self.end).min(self.end)
    }

    pub(crate) fn row_written(&self, time: f64, books: &mut RunCounters) {
        books.rows = over(time, self.rows) + 1;
        books.last_row = Some(time);
    }

    pub(crate) fn checkpoint_due(&self, time: f64, books: &mut RunCounters) {
        books.checkpoints = over(time, self.checkpoints);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 0.03 s: rows and checkpoints are those of their intervals, fields at the very times.
    #[test]
    fn everything_is_due_as_often_as_its_interval_says() {
        let schedule = Schedule::every(0.25, 1.0);
        let mut books = RunCounters {
            next_output: (schedule.next_output)(0.0),
            ..RunCounters::default()
        };
        let (mut time, mut rows, mut outputs, mut checkpoints) = (0.0, 0, Vec::new(), 0);
        loop {
            let due = schedule.due(time, &books);
            if due.row {
                rows += 1;
                schedule.row_written(time, &mut books);
                assert!(!schedule.due(time, &books).row, "one row at a time");
            }
            if due.output {
                outputs.push(time);
                books.next_output = (schedule.next_output)(time);
            }
            if due.checkpoint {
                checkpoints += 1;
                schedule.checkpoint_due(time, &mut books);
            }
            if time >= 1.0 {
                break;
            }
            time = f64::min(time + 0.03, schedule.target(&books));
        }
        assert_eq!(outputs, [0.25, 0.5, 0.75, 1.0]);
        assert_eq!(checkpoints, 4);
        // One for each interval of 0.025 s in which a step ends, and the first.
        assert!((33..=41).contains(&rows), "{rows} rows");
    }

    #[test]
    fn the_next_multiple_is_later_and_not_beyond_the_end() {
        assert_eq!(next_multiple(0.1, 1.0, 0.0), Some(0.1));
        let next = next_multiple(0.1, 1.0, 3.0 * 0.1).expect("there is one");
        assert!((next - 0.4).abs() < 1e-12, "{next}");
        assert_eq!(next_multiple(0.3, 1.0, 0.95), Some(1.0));
        assert_eq!(next_multiple(0.1, 1.0, 1.0), None);
        assert_eq!(next_multiple(0.1, 1.0, -1.0), Some(0.0), "before the start");
    }
}
