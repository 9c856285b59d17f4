//! The files of a run.

use std::path::{Path, PathBuf};

use sph_io::{ColourRanges, Frame, PvdSeries, SeriesWriter};

use crate::checkpoint::Progress;
use crate::columns::headings;
use crate::error::DemError;
use crate::fields::values;
use crate::frames;
use crate::model::Model;
use crate::origin::Origin;
use crate::read::Loaded;

/// The series, the frames for ParaView, the pictures.
pub struct Written {
    out: PathBuf,
    series: SeriesWriter,
    pvd: Option<PvdSeries>,
    pictures: usize,
    /// Ranges of colours, for checkpoints.
    pub colours: ColourRanges,
}

impl Written {
    /// Starts the files, or cuts them to where the checkpoint of a resumed run was.
    ///
    /// # Errors
    /// What cannot be written; a series that is not that of the checkpoint.
    pub fn new(loaded: &Loaded, out: &Path, progress: Option<&Progress>) -> Result<Self, DemError> {
        let (file, list) = (out.join("series.csv"), out.join("fields.pvd"));
        let columns = headings(loaded);
        let columns = columns.iter().map(|(name, unit)| (name.as_str(), *unit));
        let vtk = !loaded.scene.output.no_vtk;
        let (series, pvd, pictures) = match progress {
            None => {
                let pvd = if vtk {
                    Some(PvdSeries::create(&list)?)
                } else {
                    None
                };
                (SeriesWriter::create(&file, columns)?, pvd, 0)
            }
            Some(p) => {
                let pvd = if vtk {
                    Some(PvdSeries::open_at(&list, p.frames)?)
                } else {
                    None
                };
                let series = SeriesWriter::open_truncated(&file, p.series, columns)?;
                (series, pvd, p.frames)
            }
        };
        Ok(Self {
            out: out.to_path_buf(),
            series,
            pvd,
            pictures,
            colours: progress.map_or_else(ColourRanges::default, |p| p.colours.clone()),
        })
    }

    /// Appends a row; tells the length of the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn row(&mut self, values: &[f64]) -> Result<u64, DemError> {
        self.series.row(values)?;
        Ok(self.series.position())
    }

    /// Writes fields and pictures; tells how many there are now, and whose colours have changed.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn frame(
        &mut self,
        loaded: &Loaded,
        model: &Model,
        origin: &Origin,
    ) -> Result<(usize, Vec<String>), DemError> {
        let mut wider = Vec::new();
        let scene = &loaded.scene;
        let index = self.pictures;
        if let Some(pvd) = &mut self.pvd {
            let pieces = frames::pieces(model, origin);
            let time = model.grains().time();
            pvd.write(&Frame {
                time,
                index,
                pieces,
            })?;
        }
        if !scene.output.picture.is_empty() {
            let folder = self.out.join("pictures");
            sph_io::writable(&folder)?;
            for field in &scene.output.picture {
                let path = folder.join(format!("{field}_{index:06}.png"));
                let range = scene.output.picture_range.as_ref();
                let given = range.and_then(|all| all.of(field));
                let range = given.or_else(|| {
                    let seen = self.colours.of(field, &values(field, model, origin))?;
                    wider.extend(seen.1.then(|| field.clone()));
                    Some(seen.0)
                });
                frames::picture(model, origin, field, range, &scene.title, None, &path)?;
            }
        }
        self.pictures += 1;
        Ok((self.pictures, wider))
    }

    /// Joins the pictures of every field to a film, unless the scene wants none.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn film(&self, loaded: &Loaded) -> Result<(), DemError> {
        let output = &loaded.scene.output;
        for field in &output.picture {
            let file = |k| self.out.join(format!("pictures/{field}_{k:06}.png"));
            let speed = output.animation.unwrap_or(10.0);
            if speed > 0.0 {
                sph_io::write_film(&self.out, field, (0..self.pictures).map(file), speed)?;
            }
        }
        Ok(())
    }

    /// The file of the series.
    pub fn series(&self) -> &Path {
        self.series.path()
    }
}
