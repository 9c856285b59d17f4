//! s of all walls of a scene, each group of walls that moves as one in its own frame.

use std::collections::BTreeMap;

use rayon::prelude::*;
use sph_core::{Sets, Vect, bounds};
use sph_neighbours::{CHUNK, Domain, Frame, Slope};

use crate::scale::flat::{FlatFace, PlaneScale, REACH, flat_faces};
use crate::scale::map::{Mapping, ScaleMap};
use crate::{PeriodicBox, Result, WallMesh, WallSetup, WallSpec};

/// Size of the elements of faces, over h: the scale is that of faces, for any division into pieces.
const ELEMENT: f64 = 4.0;

#[derive(Debug)]
pub(crate) struct WallScales<const D: usize, M> {
    plane: PlaneScale,
    groups: Vec<Group<D, M>>,
    h: f64,
    domain: Domain<D>,
}

/// Walls that move as one and have nodes in common.
#[derive(Debug)]
struct Group<const D: usize, M> {
    wall: u32,
    walls: Vec<u32>,
    mesh: M,
    faces: Vec<FlatFace<D>>,
    map: Option<ScaleMap<D>>,
}

/// Walls of a mesh that have nodes in common, by their numbers: sets of walls without a common node.
fn joined<const D: usize, M: WallMesh<D>>(mesh: &M, walls: usize) -> Vec<Vec<usize>> {
    let mut wall_at = vec![None; mesh.nodes().len()];
    let mut sets = Sets::new(walls);
    for element in mesh.elements() {
        for node in element.nodes {
            let other = *wall_at[node].get_or_insert(element.wall);
            sets.join([other, element.wall]);
        }
    }
    let mut all = BTreeMap::<usize, Vec<usize>>::new();
    (0..walls).for_each(|wall| all.entry(sets.root(wall)).or_default().push(wall));
    all.into_values().collect()
}

/// Size of elements, m: `most`, `share` of the smallest piece of a wall if that is less, the spacing at least.
pub(crate) fn element_size<const D: usize>(
    walls: &[WallSpec<D>],
    spacing: f64,
    (most, share): (f64, f64),
) -> f64 {
    let of_wall = |wall: &WallSpec<D>| {
        let [low, high] = bounds(wall.drawing.points::<D>());
        (0..D).map(|k| high[k] - low[k]).fold(0.0, f64::max)
    };
    let least = walls.iter().map(of_wall).fold(f64::INFINITY, f64::min);
    (share * least).min(most).max(spacing)
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct ScaleAt<const D: usize> {
    pub scale: f64,
    pub slope: Vect<D>,
}

impl<const D: usize, M: WallMesh<D>> WallScales<D, M> {
    /// Of the walls of a scene; `groups` has the group of each.
    ///
    /// # Errors
    /// If a wall cannot have a scale.
    pub fn new(setup: &WallSetup<'_, D>, groups: &[usize]) -> Result<Self> {
        let plane = PlaneScale::new(setup.kernel, D);
        let h = setup.smoothing_length;
        let kernel = setup.kernel.sampler(D, h);
        let mut all = Vec::new();
        // The nodes of a map look as far as it reaches.
        let reach = (REACH + 1.0) * h + kernel.support_radius();
        let domain = PeriodicBox::from_domain(setup.domain);
        let build = |own: &[usize]| {
            let specs: Vec<WallSpec<D>> = own.iter().map(|k| setup.walls[*k].clone()).collect();
            let size = element_size(&specs, setup.spacing, (ELEMENT * h, 0.25));
            M::build(&specs, size, reach, &domain)
        };
        let mut pieces: Vec<(Vec<usize>, M)> = Vec::new();
        let mut together = BTreeMap::<usize, Vec<usize>>::new();
        let walls = groups.iter().enumerate();
        walls.for_each(|(wall, group)| together.entry(*group).or_default().push(wall));
        for own in together.into_values() {
            let mesh = build(&own)?;
            match &joined(&mesh, own.len())[..] {
                [_] => pieces.push((own, mesh)),
                several => {
                    for piece in several {
                        let own: Vec<usize> = piece.iter().map(|k| own[*k]).collect();
                        let mesh = build(&own)?;
                        pieces.push((own, mesh));
                    }
                }
            }
        }
        for (own, mesh) in pieces {
            let (faces, curved) = flat_faces(&mesh, setup.domain, setup.spacing);
            let mut group = Group {
                wall: own[0] as u32,
                walls: own.iter().map(|k| *k as u32).collect(),
                mesh,
                faces,
                map: None,
            };
            if curved.contains(&true) {
                let flat = |x: &Vect<D>| group.flat(x, &plane, h, setup.domain).0;
                let over_flat = |x: &Vect<D>| {
                    let height = |f: &FlatFace<D>| f.normal.dot(&setup.domain.nearest(x - f.place));
                    group.faces.iter().map(height).fold(f64::INFINITY, f64::min)
                };
                group.map = Some(ScaleMap::new(&Mapping {
                    mesh: &group.mesh,
                    curved: &curved,
                    flat: &flat,
                    over_flat: &over_flat,
                    kernel: &*kernel,
                    domain: setup.domain,
                    wall: setup.walls[own[0]].drawing.name(),
                })?);
            }
            all.push(group);
        }
        Ok(WallScales {
            plane,
            groups: all,
            h,
            domain: setup.domain.clone(),
        })
    }

    /// At all places, and which wall has which part; `frames` are those of moving walls, by wall.
    pub fn at(
        &self,
        places: &[Vect<D>],
        frames: &[Frame<D>],
        found: &mut Vec<ScaleAt<D>>,
        slopes: &mut Vec<Vec<Slope<D>>>,
    ) {
        let none = ScaleAt {
            scale: 1.0,
            slope: Vect::zeros(),
        };
        found.clear();
        found.resize(places.len(), none);
        slopes.resize_with(places.len().div_ceil(CHUNK), Vec::new);
        let chunks = found.par_chunks_mut(CHUNK).zip(places.par_chunks(CHUNK));
        let all = chunks.zip(slopes).enumerate();
        all.for_each(|(chunk, ((found, places), slopes))| {
            slopes.clear();
            for (k, (found, x)) in found.iter_mut().zip(places).enumerate() {
                let particle = (chunk * CHUNK + k) as u32;
                let from = slopes.len();
                let mut logarithm = 0.0;
                for group in &self.groups {
                    let frame = frames.get(group.wall as usize);
                    logarithm += group.add(self, x, frame, particle, slopes);
                }
                if slopes.len() > from {
                    let own = slopes[from..].iter();
                    *found = ScaleAt {
                        scale: logarithm.exp(),
                        slope: own.fold(Vect::zeros(), |sum, s| sum + s.slope),
                    };
                }
            }
        });
    }
}

impl<const D: usize, M: WallMesh<D>> Group<D, M> {
    /// ln s of the flat faces and its gradient at a place where the group was drawn.
    fn flat(&self, x: &Vect<D>, plane: &PlaneScale, h: f64, domain: &Domain<D>) -> (f64, Vect<D>) {
        let mut sum = (0.0, Vect::zeros());
        for face in &self.faces {
            if let Some((value, gradient)) = face.at(&domain.nearest(x - face.place), plane, h) {
                sum = (sum.0 + value, sum.1 + gradient);
            }
        }
        sum
    }

    /// ln s of the group at a place; its slopes are left wall by wall.
    fn add(
        &self,
        all: &WallScales<D, M>,
        x: &Vect<D>,
        frame: Option<&Frame<D>>,
        particle: u32,
        slopes: &mut Vec<Slope<D>>,
    ) -> f64 {
        // From a place that was drawn to the particle, where it was drawn.
        let apart = |place: &Vect<D>| match frame {
            None => all.domain.nearest(x - place),
            Some(frame) => {
                frame.turned_back(&all.domain.nearest(x + frame.round - frame.present(place)))
            }
        };
        let mut sum = 0.0;
        let mut leave = |wall: u32, slope: Vect<D>| {
            let slope = frame.map_or(slope, |frame| frame.turned(&slope));
            slopes.push(Slope {
                particle,
                wall,
                slope,
            });
        };
        let nearest = |x: &Vect<D>| {
            let nearest = self.mesh.nearest(x, (REACH + 1.0) * all.h);
            nearest.map_or(self.wall, |(_, wall)| self.walls[wall])
        };
        for face in &self.faces {
            let apart = apart(&face.place);
            if let Some((value, gradient)) = face.at(&apart, &all.plane, all.h) {
                let wall = match &face.walls[..] {
                    [only] => self.walls[*only as usize],
                    _ => nearest(&(face.place + apart)),
                };
                sum += value;
                leave(wall, gradient);
            }
        }
        if let Some(map) = &self.map {
            let middle = map.middle();
            let place = middle + apart(&middle);
            if let Some((value, gradient, wall)) = map.at(&place) {
                sum += value;
                leave(self.walls[wall as usize], gradient);
            }
        }
        sum
    }
}
