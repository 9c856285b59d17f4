//! Fields for ParaView, pictures and the curves of probes.

use sph_core::fields;
use sph_io::{ColourMap, ColourRanges, FieldData, Picture, View};
use sph_probes::{SURFACE_DISTANCE, surface_distance};
use sph_run::{Frames, Outlay};
use sph_scene::{Scene, given};

use crate::failure::error::Result;
use crate::running::course::Running;
use crate::running::pieces::{
    column_of, drawn_walls, own_particles, particles, points, walls, write_own_share,
    zone_particles,
};
use crate::setup::Probes;

/// True if outputs show how far particles are from the surface, which is found from lists and contacts.
pub fn shows_depths(scene: &Scene) -> bool {
    let mut shown = scene.output.fields.iter().chain(&scene.output.picture);
    shown.any(|name| name == SURFACE_DISTANCE.name)
}

/// The files of a scene's outputs.
pub fn outlay<const D: usize>(scene: &Scene, probes: &Probes<D>) -> Outlay {
    let curves = || probes.iter().filter_map(|(_, p)| p.as_curves());
    let drawn = curves().any(|c| c.drawn_column().is_some());
    let pictures = drawn || !scene.output.picture.is_empty();
    let curves = curves().next().is_some();
    Outlay {
        vtk: scene.output.vtk,
        pictures: scene.output.picture.clone(),
        digits: 4,
        animation: scene.output.pictures_per_second(),
        folders: given([("pictures", pictures), ("curves", curves)]),
    }
}

impl<const D: usize> Running<'_, D> {
    /// Fields, pictures and curves. Ranks write the particles of a frame together, but where these have a depth that the first
    /// alone has found. Returns changes of the pictures.
    pub fn write_output(&self, frames: Option<&mut Frames>) -> Result<Vec<String>> {
        let parts = self.parts.flow.parts.as_ref();
        let communicator = parts.map(|p| (p.link.transport.rank(), p.link.transport.ranks()));
        let together = self.scene.output.vtk && !shows_depths(self.scene);
        let among = communicator.filter(|(_, ranks)| together && *ranks > 1);
        match (frames, among) {
            (Some(frames), among) => self.write_all(frames, among.map(|(_, ranks)| ranks)),
            (None, Some((rank, _))) => {
                let place = (self.counters.books.outputs, rank);
                write_own_share(self.scene, &self.parts.flow, &self.options.out, place)?;
                Ok(Vec::new())
            }
            (None, None) => Ok(Vec::new()),
        }
    }

    /// Writes all outputs at the present time; `ranks` is the number of processes where these write frames together.
    fn write_all(&self, frames: &mut Frames, ranks: Option<usize>) -> Result<Vec<String>> {
        let shown = self.shown();
        let flow = &shown.flow;
        let mut remarks = Vec::new();
        let points = points(flow)?;
        // No column: only an output reads it.
        let depths = match shows_depths(self.scene) {
            true => surface_distance(&flow.world)?,
            false => Vec::new(),
        };
        self.write_frame(&points, &depths, frames, ranks)?;
        let phases: Vec<String> = self.scene.phase.keys().cloned().collect();
        for name in &self.scene.output.picture {
            let drawn = match name == SURFACE_DISTANCE.name {
                true => Some(("surface distance [m]".to_string(), depths.clone())),
                false => column_of(flow, name),
            };
            let Some((label, values)) = drawn else {
                continue;
            };
            let classes = match name == fields::PHASE.name {
                true => &phases[..],
                false => &[],
            };
            let (range, told) = match classes {
                [] => self.range(name, &values, &mut frames.colours),
                _ => (None, None),
            };
            remarks.extend(told);
            let finest = self.finest(name)?;
            let (points, values, diameters) = match &finest {
                Some((points, values, diameters)) => (&points[..], &values[..], &diameters[..]),
                None => (&points[..], &values[..], &[][..]),
            };
            let picture = Picture {
                diameters,
                walls: &drawn_walls(&flow.world),
                classes,
                range,
                ..self.picture(points, &label, values)
            };
            picture.save(frames.picture(name))?;
        }
        for (name, probe) in &shown.probes {
            let Some(curves) = probe.as_curves() else {
                continue;
            };
            let columns = curves.curve_columns();
            let rows = curves.curves(&flow.world)?;
            let table = columns.iter().map(|c| (&c.suffix, c.unit));
            sph_io::write_table(frames.table("curves", name), table, &rows)?;
            if let Some(drawn) = curves.drawn_column() {
                let label = format!("{} [{}]", columns[drawn].suffix, columns[drawn].unit);
                let values: Vec<f64> = rows.iter().map(|row| row[drawn]).collect();
                let (range, told) = self.range(name, &values, &mut frames.colours);
                remarks.extend(told);
                // A map over the first two columns, its cells as wide as the nearest ones are apart.
                let places: Vec<_> = rows.iter().map(|row| [row[0], row[1], 0.0]).collect();
                let apart = |[a, b]: [[f64; 3]; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
                let pairs = places.windows(2).map(|pair| apart([pair[0], pair[1]]));
                let diameter = pairs.fold(f64::INFINITY, f64::min);
                let plain = self.picture(&places, &label, &values);
                let picture = Picture {
                    diameter: match diameter.is_finite() {
                        true => diameter,
                        false => plain.diameter,
                    },
                    view: View::Plane,
                    range,
                    ..plain
                };
                picture.save(frames.picture(name))?;
            }
        }
        Ok(remarks)
    }

    /// A picture of values at points, particles of the spacing.
    fn picture<'p>(
        &'p self,
        points: &'p [[f64; 3]],
        label: &'p str,
        values: &'p [f64],
    ) -> Picture<'p> {
        let world = &self.shown().flow.world;
        Picture {
            title: &self.scene.title,
            time: Some(world.time),
            label,
            diameter: world.spacing,
            view: if D == 2 { View::Plane } else { View::Above },
            colours: ColourMap::Viridis,
            ..Picture::new(points, values)
        }
    }

    /// The range for the next picture of a field, and a remark if it is wider than pictures have `seen`.
    fn range(
        &self,
        field: &str,
        values: &[f64],
        seen: &mut ColourRanges,
    ) -> (Option<[f64; 2]>, Option<String>) {
        let given = self.scene.output.picture_range.as_ref();
        let given = given.and_then(|all| all.ends(field));
        let speeds = self.scene.phase.values().filter_map(|p| p.velocity_scale);
        let scale = match field {
            _ if field == fields::PRESSURE.name => self.shown().pressure,
            _ if field == fields::VELOCITY.name => speeds.fold(0.0, f64::max),
            _ => 0.0,
        };
        let scaled = (scale > 0.0).then_some([0.0, scale]);
        if let Some(range) = given.or(scaled) {
            return (Some(range), None);
        }
        let Some((range, wider)) = seen.next(field, values) else {
            return (None, None);
        };
        let [low, high] = range.map(sph_core::number::plain);
        let told = wider.then(|| {
            format!("note: colours of `{field}` go from {low} to {high} from here on; `output.picture_range` fixes them")
        });
        (Some(range), told)
    }

    /// Adds a frame for ParaView; `depths` are distances to the surface, if these are requested.
    fn write_frame(
        &self,
        points: &[[f64; 3]],
        depths: &[f64],
        frames: &mut Frames,
        ranks: Option<usize>,
    ) -> Result<()> {
        let flow = &self.shown().flow;
        if !frames.lists() {
            return Ok(());
        }
        let wanted = |name: &str| self.scene.output.fields.iter().any(|f| f == name);
        let mut fluid = match ranks {
            Some(_) => own_particles(&self.parts.flow, wanted)?,
            None => particles(&flow.world.free, points, wanted),
        };
        let depth = SURFACE_DISTANCE;
        if wanted(depth.name) {
            let field = FieldData::scalar(depth.name, depth.unit, depths);
            fluid.fields.push(field);
        }
        let mut pieces = vec![fluid];
        for level in self.zones.all_levels() {
            pieces.push(zone_particles(level, wanted)?);
        }
        pieces.extend(walls(&flow.world));
        Ok(frames.add(flow.world.time, pieces, ranks.unwrap_or(1))?)
    }

    /// The finest particles everywhere with a column; none without zones, and where a flow has no such column.
    fn finest(&self, name: &str) -> Result<Option<Spots>> {
        if self.zones.levels.is_empty() {
            return Ok(None);
        }
        let (mut places, mut values, mut diameters) = (Vec::new(), Vec::new(), Vec::new());
        for (flow, some) in self.zones.finest(&self.shown().flow)? {
            let Some((_, column)) = column_of(flow, name) else {
                return Ok(None);
            };
            let all = points(flow)?;
            places.extend(some.iter().map(|k| all[*k]));
            values.extend(some.iter().map(|k| column[*k]));
            diameters.resize(places.len(), flow.world.spacing);
        }
        Ok(Some((places, values, diameters)))
    }
}

/// Places, values and diameters of particles in a picture.
type Spots = (Vec<[f64; 3]>, Vec<f64>, Vec<f64>);
