//! Open faces as a piece of physics, and their work within a step.

use std::sync::{Arc, Mutex};

use sph_boundary::Wall;
use sph_contribution::{
    Contribution, Gate, Newborn, Offer, Refusal, Report, Setting, StepHook, StepMoment, StepPhase,
    even_out,
};
use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::World;
use sph_rheology::state::Laws;

use crate::faces::{Face, Faces, SharedFaces, lock};
use crate::walls::OpenWalls;
use crate::{Entering, OPEN_FLUX, OpenBoundary, OpenRefusal};

/// Parts of the run at the ends of which the course of a law is checked.
const COURSE: usize = 4096;

/// The open faces of a scene as a contribution, and their work within a step.
#[derive(Clone)]
pub struct OpenBoundaries<const D: usize> {
    faces: SharedFaces<D>,
    /// True if densities are sums, which change with particles that come and go.
    summed: bool,
    phases: Vec<String>,
}

/// Opens faces in the walls of a scene: the treatment of all of them, and the passage of mass.
///
/// `given` are the names of the walls with their laws; `phases` are the names of the phases; `summed` is whether
/// densities are sums over positions.
pub fn open<const D: usize>(
    walls: Box<dyn Wall<D>>,
    given: Vec<(String, Arc<dyn OpenBoundary<D>>)>,
    (laws, phases): (&Laws, &[String]),
    spacing: f64,
    summed: bool,
) -> (Box<dyn Wall<D>>, OpenBoundaries<D>) {
    let cell = spacing.powi(D as i32);
    let faces = given.into_iter().map(|(name, law)| {
        let entering = law.entering();
        let phase = entering.phase.as_ref();
        let phase = phase.and_then(|name| phases.iter().position(|p| p == name));
        Face {
            body: name.as_str().into(),
            name,
            law,
            phase: phase.map(|p| p as u32),
            values: entering.values.into_iter().collect(),
            elements: 0..0,
        }
    });
    let faces = Faces {
        faces: faces.collect(),
        laws: laws.clone(),
        backgrounds: laws.iter().map(|law| law.background()).collect(),
        whole: laws.iter().map(|l| l.reference().density * cell).collect(),
        spacing,
        ..Faces::default()
    };
    let faces = Arc::new(Mutex::new(faces));
    let walls = OpenWalls {
        walls,
        faces: faces.clone(),
    };
    let boundaries = OpenBoundaries {
        faces,
        summed,
        phases: phases.to_vec(),
    };
    (Box::new(walls), boundaries)
}

impl<const D: usize> OpenBoundaries<D> {
    /// Places in front of all ports at a distance, m, each with the name of its face.
    pub fn in_front(&self, distance: f64) -> Vec<(String, Vect<D>)> {
        let faces = lock(&self.faces);
        let all = faces.places.iter().zip(&faces.face_of);
        let names = |face: &usize| faces.faces[*face].name.clone();
        all.map(|(place, face)| (names(face), place.centre + place.normal * distance))
            .collect()
    }

    /// Refusals of laws for the elements of their faces, each with the name of the face.
    pub fn misfits(&self) -> Vec<(String, OpenRefusal)> {
        let faces = lock(&self.faces);
        let one = |face: &Face<D>| {
            let refusal = face.law.fit(&faces.places[face.elements.clone()]).err()?;
            Some((face.name.clone(), refusal))
        };
        faces.faces.iter().filter_map(one).collect()
    }

    /// The fluid that comes in by every face, with its name.
    pub fn entering(&self) -> Vec<(String, Entering)> {
        let faces = lock(&self.faces);
        let all = faces.faces.iter();
        all.map(|f| (f.name.clone(), f.law.entering())).collect()
    }

    /// True if fluid can leave by any of them.
    pub fn let_out(&self) -> bool {
        lock(&self.faces).faces.iter().any(|f| f.law.lets_out())
    }

    /// The largest fall, m/s, of a velocity into the fluid that a law requests, in the mean over its face, within a
    /// time (s) and the longest [memory](OpenBoundary::memory) up to the `end` of a run, s; with the name of that
    /// face.
    pub fn braking(&self, time: f64, end: f64) -> Option<(String, f64)> {
        let faces = lock(&self.faces);
        let memories = faces.faces.iter().filter_map(|f| f.law.memory());
        let time = time + memories.fold(0.0, f64::max);
        let back = ((time / end * COURSE as f64).ceil() as usize).clamp(1, COURSE);
        let fall = |face: &Face<D>| {
            let places = &faces.places[face.elements.clone()];
            let area: f64 = places.iter().map(|p| p.measure).sum();
            let at =
                |k: usize| Some(face.law.asked(places, end * k as f64 / COURSE as f64)? / area);
            let course: Vec<f64> = (0..=COURSE).map_while(at).collect();
            let before = |k: usize| course[k.saturating_sub(back)..=k].iter().copied();
            let falls = (0..course.len()).map(|k| before(k).fold(course[k], f64::max) - course[k]);
            (face.name.clone(), falls.fold(0.0, f64::max))
        };
        let falls = faces.faces.iter().map(fall).filter(|(_, fall)| *fall > 0.0);
        falls.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Learns anew at which pressures the laws of the phases have their reference densities.
    pub fn lifted(&self) {
        let mut faces = lock(&self.faces);
        faces.backgrounds = faces.laws.iter().map(|law| law.background()).collect();
    }

    /// As the solver keeps it.
    pub fn boxed(self) -> Box<dyn Contribution<D>> {
        Box::new(self)
    }
}

impl<const D: usize> Contribution<D> for OpenBoundaries<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if !setting.kicks_once {
            let why =
                "open faces let mass through once per step: take `[integrator.symplectic-euler]`";
            return Err(Refusal::at_key("integrator", "", why));
        }
        offer.hook(self.clone());
        offer.gate(self.clone());
        Ok(())
    }
}

const NAME: &str = "open boundaries";

impl<const D: usize> OpenBoundaries<D> {
    fn columns(&self) -> Access {
        let access = Access::none()
            .both((fields::POSITION, fields::VOLUME))
            .here((fields::VELOCITY, fields::MASS, fields::DENSITY))
            .here((fields::RENORMALISATION, fields::IDENTITY))
            .writes(fields::VELOCITY)
            .where_there(fields::PHASE);
        match self.summed {
            false => access,
            true => access
                .here((OPEN_FLUX, fields::DENSITY_CONSTANT))
                .remembers(OPEN_FLUX)
                .writes(fields::DENSITY_CONSTANT),
        }
    }
}

impl<const D: usize> StepHook<D> for OpenBoundaries<D> {
    fn name(&self) -> String {
        NAME.into()
    }

    fn access(&self) -> Access {
        self.columns()
    }

    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }

    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
        let mut faces = lock(&self.faces);
        faces.balance(world, dt)?;
        if self.summed {
            faces.advance_densities(world, dt)?;
        }
        faces.pass(dt);
        faces.ask(world.time, dt);
        faces.remember(dt);
        Ok(())
    }

    fn report(&self, _: &World<D>) -> Report {
        let faces = lock(&self.faces);
        Report {
            // Without an evaluation of the faces there are none.
            counts: (!faces.memory.volumes.is_empty()).then(|| faces.budget(&self.phases)),
            summary: Some("open_boundaries"),
            warnings: faces.differences(),
            ..Report::default()
        }
    }
}

impl<const D: usize> Gate<D> for OpenBoundaries<D> {
    fn name(&self) -> String {
        NAME.into()
    }

    fn access(&self) -> Access {
        self.columns()
    }

    fn exits(&self) -> Vec<String> {
        let faces = lock(&self.faces);
        faces.faces.iter().map(|f| f.name.clone()).collect()
    }

    fn departures(
        &mut self,
        world: &mut World<D>,
        _dt: f64,
    ) -> Result<Vec<(u32, usize)>, StepError> {
        let gone = lock(&self.faces).leaving(world)?;
        even_out(world, &gone.places, 1.0)?;
        Ok(gone.here)
    }

    fn births(&mut self, world: &mut World<D>, _dt: f64) -> Result<Vec<Newborn<D>>, StepError> {
        let mut faces = lock(&self.faces);
        let born = faces.due_particles();
        let places: Vec<Vect<D>> = born.iter().map(|b| b.position).collect();
        even_out(world, &places, -1.0)?;
        world.walls.passed = faces.passed(&world.walls);
        Ok(born)
    }
}
