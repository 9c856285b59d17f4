//! A scene stepped from Python.

use std::fmt::Display;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, TryLockError};

use pyo3::exceptions::{PyKeyError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sph_cli::library::{AnyScene, Trouble};
use sph_core::{Role, StepError};
use sph_particles::{RunError, Stepper};

use crate::columns::{array, axes, field_of, from_array, numbers};
use crate::errors;
use crate::scene::opened;

enum Flow {
    Planar(Box<Stepper<2>>),
    Spatial(Box<Stepper<3>>),
}

/// Does the same in both dimensions.
macro_rules! each {
    ($flow:expr, $stepper:ident => $done:expr) => {
        match $flow {
            Flow::Planar($stepper) => $done,
            Flow::Spatial($stepper) => $done,
        }
    };
}

/// A scene in memory, one step at a time.
#[pyclass(module = "sph._sph", frozen, subclass)]
pub struct Simulation {
    flow: Mutex<Flow>,
    pool: rayon::ThreadPool,
    #[pyo3(get)]
    title: String,
    #[pyo3(get)]
    end: f64,
    #[pyo3(get)]
    dimension: usize,
}

/// Name, unit, whether it is state, and lengths of the axes after the first, of a column.
type Described = (&'static str, &'static str, bool, Vec<usize>);

fn assembled(scene: &sph_cli::library::ParticleScene) -> Result<Flow, RunError> {
    Ok(match scene.dimension {
        3 => Flow::Spatial(Box::new(Stepper::new(scene)?)),
        _ => Flow::Planar(Box::new(Stepper::new(scene)?)),
    })
}

impl Simulation {
    /// The flow, unless it is being stepped.
    fn flow(&self) -> PyResult<MutexGuard<'_, Flow>> {
        match self.flow.try_lock() {
            Ok(flow) => Ok(flow),
            Err(TryLockError::Poisoned(flow)) => Ok(flow.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the simulation is being stepped: a function that it calls, or another thread, cannot look at it",
            )),
        }
    }

    /// Work on the flow with the threads of the simulation.
    fn with<T: Send, E: Display + Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Flow) -> Result<T, E> + Send,
    ) -> PyResult<T> {
        let mut flow = self.flow()?;
        let flow = &mut *flow;
        let done = py.detach(|| self.pool.install(|| work(flow)));
        done.map_err(|e| errors::step(py, &e))
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(
        scene: &Bound<'_, PyAny>,
        set: Vec<String>,
        allow_path: Vec<PathBuf>,
        threads: Option<usize>,
        start: Option<PathBuf>,
    ) -> PyResult<Self> {
        let py = scene.py();
        let opened = opened(scene, set, allow_path)?;
        let AnyScene::Particles(loaded) = &opened.scene else {
            let why = "a scene of grains cannot be stepped from Python: run it with sph.run";
            return Err(errors::from_trouble(py, &Trouble::usage(why)));
        };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
        let pool = pool.build();
        let pool =
            pool.map_err(|e| errors::from_trouble(py, &Trouble::usage(format!("threads: {e}"))))?;
        let made = py.detach(|| {
            pool.install(|| {
                let mut flow = assembled(&loaded.scene)?;
                if let Some(start) = start {
                    let file = match start.is_dir() {
                        true => start.join("checkpoint.sph"),
                        false => start,
                    };
                    each!(&mut flow, s => s.start_from(&file))?;
                }
                Ok::<_, RunError>(flow)
            })
        });
        let flow = made.map_err(|e| errors::from_run(py, &Trouble::in_scene(e, &loaded.source)))?;
        Ok(Simulation {
            flow: Mutex::new(flow),
            pool,
            title: loaded.scene.title.clone(),
            end: loaded.scene.run.end,
            dimension: loaded.scene.dimension,
        })
    }

    /// Simulated time, s.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(each!(&*self.flow()?, s => s.time()))
    }

    /// The last step, s, and what limited it.
    #[getter]
    fn last_step(&self) -> PyResult<(f64, &'static str)> {
        Ok(each!(&*self.flow()?, s => s.last_step()))
    }

    /// Steps taken, and steps that were taken back.
    #[getter]
    fn step_counts(&self) -> PyResult<(u64, u64)> {
        Ok(each!(&*self.flow()?, s => s.steps()))
    }

    /// Free particles.
    fn __len__(&self) -> PyResult<usize> {
        Ok(each!(&*self.flow()?, s => s.parts().flow.world.free.len()))
    }

    /// One step, not beyond `until` (s); its length, s.
    fn one_step(&self, py: Python<'_>, until: f64) -> PyResult<f64> {
        let dt = self.with(py, |flow| each!(flow, s => s.step(until)))?;
        py.check_signals()?;
        Ok(dt)
    }

    /// Computes what is derived, unless that is done.
    fn evaluate(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, |flow| each!(flow, s => s.evaluate()))
    }

    /// Name, unit, whether it is state, and lengths of the axes after the first, of every column.
    fn describe(&self) -> PyResult<Vec<Described>> {
        let flow = self.flow()?;
        let dimension = self.dimension;
        Ok(each!(&*flow, s => {
            let free = &s.parts().flow.world.free;
            let columns = free.columns().zip(free.fields());
            columns
                .map(|((name, unit, role, ..), field)| {
                    (name, unit, role == Role::State, axes(field.shape, dimension))
                })
                .collect()
        }))
    }

    /// A column of the present state.
    fn get<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.evaluate(py)?;
        let flow = self.flow()?;
        let found = each!(&*flow, s => {
            let free = &s.parts().flow.world.free;
            let field = field_of(free, name).filter(|f| free.has(f.name));
            field.map(|field| (numbers(free, field), axes(field.shape, self.dimension)))
        });
        let Some((numbers, axes)) = found else {
            return Err(PyKeyError::new_err(name.to_string()));
        };
        let numbers = numbers.map_err(|e| errors::step(py, &StepError::from(e)))?;
        array(py, numbers, &axes)
    }

    /// Overwrites a column of state.
    fn set(&self, py: Python<'_>, name: &str, values: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut flow = self.flow()?;
        let shape = each!(&*flow, s => {
            let free = &s.parts().flow.world.free;
            let field = field_of(free, name).filter(|f| free.has(f.name));
            field.map(|f| [&[free.len()], &axes(f.shape, self.dimension)[..]].concat())
        });
        let shape = shape.ok_or_else(|| PyKeyError::new_err(name.to_string()))?;
        let values = from_array(values, &shape)?;
        let done = each!(&mut *flow, s => s.set(name, &values));
        done.map_err(|e| errors::step(py, &e))
    }

    /// What the probes measure now: values and units by name.
    fn measure<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let measured = self.with(py, |flow| each!(flow, s => s.measure()))?;
        let all = PyDict::new(py);
        for (name, unit, value) in measured {
            all.set_item(name, (value, unit))?;
        }
        Ok(all)
    }

    /// Points of the walls, m, one row per point.
    fn wall_points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let flow = self.flow()?;
        let points: Vec<f64> = each!(&*flow, s => {
            let points = &s.parts().flow.world.walls.points.position;
            points.iter().flatten().copied().collect()
        });
        array(py, crate::columns::Numbers::Real(points), &[self.dimension])
    }
}
