//! Courses over time from the motion of a wall.

use std::path::Path;

use scene_text::given;
use sph_core::course::{self, Course, Translation};
use sph_core::{SceneProblem, unit_factor};

use crate::drawings::heading::Form;
use crate::drawings::rows::{self, Row};
use crate::geometry::vector::{array, unit};
use crate::reading::limits::TIMES;
use crate::tables::motion::{Motion, Rotation, Translate};

/// All courses of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Courses<const D: usize> {
    /// Along unit vectors; they add up.
    pub translations: Vec<Translation<D>>,
    /// About a unit vector; (0, 0, 1) in 2D.
    pub rotation: Option<course::Rotation<D>>,
    /// Time from which the courses count, s.
    pub start: f64,
    /// Time from which the wall stays where it is, s.
    pub stop: f64,
}

impl Motion {
    /// The courses, with `velocity` and `angular_velocity` among them and files read.
    ///
    /// `place` is the path of the motion in the scene: `wall.gate.motion`.
    ///
    /// # Errors
    /// If a file cannot be read or is no course.
    pub fn courses<const D: usize>(&self, place: &str) -> Result<Courses<D>, SceneProblem> {
        let mut translations = Vec::new();
        if let Some(velocity) = &self.velocity {
            let speed = velocity.iter().map(|c| c * c).sum::<f64>().sqrt();
            if let Some(along) = unit(velocity) {
                let (along, course) = (array(&along), Course::Steady { speed });
                translations.push(Translation { along, course });
            }
        }
        for (k, translate) in self.translate.iter().enumerate() {
            let along = array(&unit(&translate.along).unwrap_or_default());
            let course = translate.course(&self.translate_path(place, k))?;
            translations.push(Translation { along, course });
        }
        let turning = |centre: Option<&[f64]>, axis: &Option<Vec<f64>>, course| course::Rotation {
            centre: array(centre.unwrap_or_default()),
            axis: axis
                .as_deref()
                .and_then(unit)
                .map_or([0.0, 0.0, 1.0], |a| array(&a)),
            course,
        };
        let rotation = match &self.rotate {
            Some(given) => {
                let course = given.course(&format!("{place}.rotate"))?;
                Some(turning(Some(&given.centre), &given.axis, course))
            }
            None if self.angular_velocity != 0.0 => {
                let speed = self.angular_velocity;
                let course = Course::Steady { speed };
                Some(turning(self.centre.as_deref(), &self.axis, course))
            }
            None => None,
        };
        Ok(Courses {
            translations,
            rotation,
            start: self.start,
            stop: self.stop.unwrap_or(f64::INFINITY),
        })
    }
}

/// What a translation and a rotation have in common, with other units.
macro_rules! with_course {
    ($table:ident, $unit:literal) => {
        impl $table {
            /// The keys of courses that are given.
            pub(crate) fn given(&self) -> Vec<&'static str> {
                given([
                    ("speed", self.speed.is_some()),
                    ("ramp", self.ramp.is_some()),
                    ("sine", self.sine.is_some()),
                    ("table", self.table.is_some()),
                    ("file", self.file.is_some()),
                ])
            }

            /// The given keys of the form of a file.
            pub(crate) fn in_force(&self) -> Vec<&'static str> {
                given([
                    ("unit", self.unit.is_some()),
                    ("scale", self.scale.is_some()),
                    ("time_unit", self.time_unit.is_some()),
                    ("columns", self.columns.is_some()),
                ])
            }

            fn course(&self, place: &str) -> Result<Course, SceneProblem> {
                let ramp = self.ramp.map(|r| Course::Ramp {
                    speed: r.speed,
                    over: r.over,
                });
                let sine = self.sine.map(|s| Course::Sine {
                    amplitude: s.amplitude,
                    period: s.period,
                    phase: s.phase,
                    ramp: s.ramp,
                });
                let steady = self.speed.map(|speed| Course::Steady { speed });
                let plain = steady.or(ramp).or(sine);
                chosen(plain, &self.table, || self.rows(), place)
            }

            /// Keys of the scene for the columns of the file.
            ///
            /// # Errors
            /// The key that is wrong, and why.
            pub(crate) fn form(&self) -> Result<Form, (&'static str, String)> {
                let alike = ["s", $unit];
                let factor = |unit: &Option<String>, k: usize| {
                    let unit = unit.as_deref();
                    unit.map(|u| unit_factor(u, alike[k])).transpose()
                };
                let value = factor(&self.unit, 1).map_err(|why| ("unit", why))?;
                let time = factor(&self.time_unit, 0).map_err(|why| ("time_unit", why))?;
                Ok(Form {
                    columns: self.columns.clone(),
                    factors: [time, self.scale.or(value)],
                    alike,
                })
            }

            /// The rows of the file.
            fn rows(&self) -> Result<Vec<Row>, String> {
                let path = self.path.as_deref();
                let path = path.ok_or_else(|| "the course is missing".to_string())?;
                let form = self.form().map_err(|(_, why)| why)?;
                course_rows(path, &form)
            }
        }
    };
}
with_course!(Translate, "m");
with_course!(Rotation, "rad");

fn chosen(
    plain: Option<Course>,
    table: &Option<Vec<[f64; 2]>>,
    rows: impl Fn() -> Result<Vec<Row>, String>,
    place: &str,
) -> Result<Course, SceneProblem> {
    if let Some(course) = plain {
        return Ok(course);
    }
    if let Some(table) = table {
        let rows = table.as_slice().into();
        return Ok(Course::Table { rows });
    }
    let rows = rows().map_err(|why| SceneProblem::new(format!("{place}.file"), why))?;
    let rows = rows.iter().map(|r| r.values).collect();
    Ok(Course::Table { rows })
}

/// The rows of a file that is a course.
fn course_rows(path: &Path, form: &Form) -> Result<Vec<Row>, String> {
    let blocks = rows::read(path, form)?;
    let rows: Vec<Row> = blocks.into_iter().flatten().collect();
    let (name, count) = (path.display(), rows.len());
    if count > TIMES {
        return Err(format!("`{name}` holds {count} rows, more than {TIMES}"));
    }
    if count < 2 {
        return Err(format!(
            "`{name}` holds {count} rows, and a course needs at least 2"
        ));
    }
    match rows.windows(2).find(|p| p[0].values[0] >= p[1].values[0]) {
        None => Ok(rows),
        Some(pair) => Err(format!(
            "`{name}`, line {}: times must rise, {} s follows {} s",
            pair[1].line, pair[1].values[0], pair[0].values[0]
        )),
    }
}

impl Motion {
    /// Where the scene says what the wall does at a time, s: the key, and the name of the file with the line if it is in
    /// one. None of a motion without a table.
    pub fn told_at(&self, place: &str, time: f64) -> Option<(String, Option<String>)> {
        let mut translations = self.translate.iter().enumerate();
        let translate = translations.find(|(_, t)| t.path.is_some() || t.table.is_some());
        let (key, file, table, rows) = match (translate, &self.rotate) {
            (Some((k, t)), _) => (self.translate_path(place, k), &t.file, &t.table, t.rows()),
            (None, Some(r)) => (format!("{place}.rotate"), &r.file, &r.table, r.rows()),
            (None, None) => return None,
        };
        let before = |t: f64| t <= time - self.start;
        if let Some(table) = table {
            let row = table.partition_point(|r| before(r[0])).saturating_sub(1);
            return Some((format!("{key}.table[{row}]"), None));
        }
        let rows = rows.ok()?;
        let after = rows.partition_point(|r| before(r.values[0]));
        let line = rows[after.saturating_sub(1)].line;
        let file = file.as_deref()?;
        Some((
            format!("{key}.file"),
            Some(format!("`{file}`, line {line}")),
        ))
    }
}
