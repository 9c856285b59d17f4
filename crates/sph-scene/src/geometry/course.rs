//! Courses over time from the motion of a wall.

use scene_text::given;
use sph_core::course::{self, Course, Translation};
use sph_core::{SceneProblem, unit_factor};

use crate::drawings::rows::{self, Form, Row};
use crate::geometry::vector::{array, unit, unit_axis};
use crate::reading::limits::TIMES;
use crate::tables::motion::{CourseRows, Motion, Rotation, Translate};

impl Motion {
    /// Translations along unit vectors, which add up, and the rotation about a unit vector, (0, 0, 1) in 2D;
    /// `velocity` and `angular_velocity` are among them, and files read.
    ///
    /// `place` is the path of the motion in the scene: `wall.gate.motion`.
    ///
    /// # Errors
    /// If a file cannot be read or is no course.
    pub fn courses<const D: usize>(
        &self,
        place: &str,
    ) -> Result<(Vec<Translation<D>>, Option<course::Rotation<D>>), SceneProblem> {
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
            let course = translate
                .given()
                .course(&format!("{place}.{}", self.translate_key(k)))?;
            translations.push(Translation { along, course });
        }
        let speed = self.angular_velocity;
        let (centre, axis, course) = match &self.rotate {
            Some(rotate) => {
                let course = rotate.given().course(&format!("{place}.rotate"))?;
                (Some(&rotate.centre), &rotate.axis, Some(course))
            }
            None => {
                let course = (speed != 0.0).then_some(Course::Steady { speed });
                (self.centre.as_ref(), &self.axis, course)
            }
        };
        let rotation = course.map(|course| course::Rotation {
            centre: array(centre.map_or(&[], |centre| centre)),
            axis: unit_axis(axis),
            course,
        });
        Ok((translations, rotation))
    }
}

/// Course of a translation or a rotation, by its keys.
pub(crate) struct ImposedCourse<'a> {
    /// The keys of courses that are given.
    pub keys: Vec<&'static str>,
    /// That without rows.
    course: Option<Course>,
    pub rows: &'a CourseRows,
    unit: &'static str,
}

impl Translate {
    pub(crate) fn given(&self) -> ImposedCourse<'_> {
        let ramp = self.ramp.map(|r| (r.speed, r.over));
        let sine = self.sine.as_ref();
        let sine = sine.map(|s| s.oscillation.course(s.amplitude));
        ImposedCourse::new(self.speed, ramp, sine, &self.rows, "m")
    }
}

impl Rotation {
    pub(crate) fn given(&self) -> ImposedCourse<'_> {
        let ramp = self.ramp.map(|r| (r.speed, r.over));
        let sine = self.sine.as_ref();
        let sine = sine.map(|s| s.oscillation.course(s.amplitude));
        ImposedCourse::new(self.speed, ramp, sine, &self.rows, "rad")
    }
}

impl<'a> ImposedCourse<'a> {
    fn new(
        speed: Option<f64>,
        ramp: Option<(f64, f64)>,
        sine: Option<Course>,
        rows: &'a CourseRows,
        unit: &'static str,
    ) -> Self {
        let keys = given([
            ("speed", speed.is_some()),
            ("ramp", ramp.is_some()),
            ("sine", sine.is_some()),
            ("table", rows.table.is_some()),
            ("file", rows.file.is_some()),
        ]);
        let steady = speed.map(|speed| Course::Steady { speed });
        let ramp = ramp.map(|(speed, over)| Course::Ramp { speed, over });
        ImposedCourse {
            keys,
            course: steady.or(ramp).or(sine),
            rows,
            unit,
        }
    }

    fn course(&self, place: &str) -> Result<Course, SceneProblem> {
        if let Some(course) = &self.course {
            return Ok(course.clone());
        }
        let rows = match &self.rows.table {
            Some(table) => table.as_slice().into(),
            None => {
                let told = |why| SceneProblem::new(format!("{place}.file"), why);
                let rows = self.rows().map_err(told)?;
                rows.iter().map(|r| r.values).collect()
            }
        };
        Ok(Course::Table { rows })
    }

    /// Keys of the scene for the columns of the file; or the key that is wrong, and why.
    pub fn form(&self) -> Result<Form, (&'static str, String)> {
        let factor = |given: &Option<String>, alike| {
            let given = given.as_deref();
            given.map(|unit| unit_factor(unit, alike)).transpose()
        };
        let value = factor(&self.rows.unit, self.unit).map_err(|why| ("unit", why))?;
        let time = factor(&self.rows.time_unit, "s").map_err(|why| ("time_unit", why))?;
        Ok(Form {
            columns: self.rows.columns.clone(),
            factors: [time, self.rows.scale.or(value)],
            alike: ["s", self.unit],
        })
    }

    /// The rows of the file, whose times rise.
    fn rows(&self) -> Result<Vec<Row>, String> {
        let path = self.rows.path.as_deref();
        let path = path.ok_or_else(|| "the course is missing".to_string())?;
        let form = self.form().map_err(|(_, why)| why)?;
        let blocks = rows::read(path, &form)?;
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
}

impl Motion {
    /// Source of the wall's motion at a time, s: the key, and the name of the file with the line if it is in one. None
    /// of a motion without a table.
    pub fn told_at(&self, place: &str, time: f64) -> Option<(String, Option<String>)> {
        let mut translations = self.translate.iter().enumerate();
        let told = |rows: &CourseRows| rows.path.is_some() || rows.table.is_some();
        let (key, given) = match (translations.find(|(_, t)| told(&t.rows)), &self.rotate) {
            (Some((k, t)), _) => (format!("{place}.{}", self.translate_key(k)), t.given()),
            (None, Some(r)) => (format!("{place}.rotate"), r.given()),
            (None, None) => return None,
        };
        let before = |t: f64| t <= time - self.start;
        if let Some(table) = &given.rows.table {
            let row = table.partition_point(|r| before(r[0])).saturating_sub(1);
            return Some((format!("{key}.table[{row}]"), None));
        }
        let rows = given.rows().ok()?;
        let after = rows.partition_point(|r| before(r.values[0]));
        let line = rows[after.saturating_sub(1)].line;
        let file = given.rows.file.as_deref()?;
        let told = format!("`{file}`, line {line}");
        Some((format!("{key}.file"), Some(told)))
    }
}
