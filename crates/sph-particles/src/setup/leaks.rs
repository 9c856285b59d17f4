//! Walls behind which fluid can get: ends that no wall continues, holes, solids that are drawn inside out.
//!
//! A wall may end where fluid goes over its end on purpose: at the open top of a tank, at the brink of a plate. It may not
//! end beside another wall, within a wall that holds the fluid, or with a gap below the level of the fluid at the start.

use sph_core::{Vect, comma_list, number};
use sph_neighbours::{WallSet, World};
use sph_scene::Scene;

use crate::setup::rims::{Rim, Skin, Skins};

/// Ends nearer to each other than this share of the spacing are reported as one place.
const SAME: f64 = 1e-3;
/// A lid whose normal rises no more than this share of its size is upright.
const UPRIGHT: f64 = 0.1;

/// A wall behind which fluid can get.
#[derive(Clone, Debug)]
pub struct Leak<const D: usize> {
    /// The place in the scene, the wall, the defect and its remedy.
    pub text: String,
    /// Places of it, m.
    pub places: Vec<Vect<D>>,
}

/// All of them, of walls that have elements; the fluid is where the particles are.
pub fn leaks<const D: usize>(
    scene: &Scene,
    world: &World<D>,
    walls: &WallSet<D>,
    particles: &[Vect<D>],
) -> Vec<Leak<D>> {
    if walls.elements.corners.is_empty() {
        return Vec::new();
    }
    let about = LeakInput {
        scene,
        world,
        walls,
        skins: Skins::new(walls, &world.domain),
        up: (world.gravity.norm() > 0.0).then(|| -world.gravity.normalize()),
        particles,
    };
    let rims = about.skins.rims.iter().filter_map(|r| about.rim(r));
    let turned = (0..about.skins.all.len()).filter_map(|k| about.turned(k));
    rims.chain(turned).collect()
}

struct LeakInput<'a, const D: usize> {
    scene: &'a Scene,
    world: &'a World<D>,
    walls: &'a WallSet<D>,
    skins: Skins<D>,
    /// Against gravity; none without it.
    up: Option<Vect<D>>,
    particles: &'a [Vect<D>],
}

impl<const D: usize> LeakInput<'_, D> {
    fn name(&self, wall: usize) -> &str {
        self.scene.wall.keys().nth(wall).map_or("", String::as_str)
    }

    fn leak(&self, wall: usize, what: &str, places: Vec<Vect<D>>) -> Leak<D> {
        let name = self.name(wall);
        let line = self.scene.wall.get(name).and_then(|w| w.place.as_ref());
        let line = line.map_or(String::new(), |line| format!("{line}: "));
        let text = format!("{line}wall.{name}: {what}");
        Leak { text, places }
    }

    /// The defect of an end of a wall, if it has one.
    fn rim(&self, rim: &Rim<D>) -> Option<Leak<D>> {
        let points = &self.walls.points.position;
        let wall = |node: usize| self.walls.points.wall[node] as usize;
        let [low, high] = rim.bounds(points);
        let places: Vec<Vect<D>> = rim.nodes.iter().map(|n| points[*n]).collect();
        let first = wall(rim.nodes[0]);
        let told = |what: String| Some(self.leak(first, &what, places.clone()));
        let support = self.world.kernel.support_radius();
        let wide = match D {
            2 => rim.lid.norm(),
            _ => (high - low).norm(),
        };
        if wide < support {
            return told(self.gap(rim));
        }
        let beside = self.neighbouring_points(rim, support);
        if let Some((node, ..)) = beside.first() {
            return Some(self.leak(wall(*node), &self.beside_text(rim, &beside), places));
        }
        let level = self.level();
        let lowest = self.up.map_or(f64::NEG_INFINITY, |up| {
            let heights = places.iter().map(|x| x.dot(&up));
            heights.fold(f64::INFINITY, f64::min)
        });
        if lowest >= level {
            return None;
        }
        let ends = self.ends(rim);
        let centre = 0.5 * (low + high);
        let others = self.skins.all.iter().enumerate();
        let mut others = others.filter(|(k, _)| !rim.skins.contains(k));
        if let Some((_, skin)) = others.find(|(_, s)| s.holds && in_box(s, &centre)) {
            let holds = self.name(skin.wall);
            return told(format!(
                "it ends at {ends}, within wall `{holds}`, and no wall goes on there: fluid gets behind it; close it{}",
                closing::<D>()
            ));
        }
        let up = self.up?;
        let upright = rim.lid.dot(&up) > -UPRIGHT * rim.lid.norm();
        if !upright || !self.scene.outlet.is_empty() {
            return None;
        }
        told(format!(
            "it is open at {ends}, below the level of the fluid at the start: fluid runs out there; close it, or \
             put an `[outlet.NAME]` where the fluid is to leave"
        ))
    }

    fn gap(&self, rim: &Rim<D>) -> String {
        let walls = rim.skins.map(|s| self.name(self.skins.all[s].wall));
        let (whose, remedy) = match walls[0] == walls[1] {
            true => (String::new(), format!("close it{}", closing::<D>())),
            false => {
                let whose = format!(" between it and wall `{}`", walls[1]);
                (whose, "give both ends the same place".to_string())
            }
        };
        let ends = self.ends(rim);
        format!(
            "there is a gap{whose} at {ends}, narrower than the kernel is wide: forces are wrong there; {remedy}"
        )
    }

    /// Ends of a rim beside other walls: their points, those of the walls, and the distances, m.
    fn beside_text(&self, rim: &Rim<D>, beside: &[(usize, usize, f64)]) -> String {
        let walls = &self.walls.points;
        let whose = |point: usize| self.name(walls.wall[point] as usize);
        let told = |(node, other, distance): &(usize, usize, f64)| {
            let at = match distance < &(SAME * self.world.spacing) {
                true => "on".to_string(),
                false => format!("{} m from", number::plain(*distance)),
            };
            format!("{} {at} wall `{}`", self.end(rim, *node), whose(*other))
        };
        let all: Vec<String> = beside.iter().map(told).collect();
        let other = beside.first().map_or("", |(_, other, _)| whose(*other));
        format!(
            "{}, which does not go on there: fluid that comes there gets behind the wall, or the run fails; close \
             the wall{}, or let it end in a corner of `{other}`",
            all.join(" and "),
            closing::<D>()
        )
    }

    /// An end of a rim: in the plane which one.
    fn end(&self, rim: &Rim<D>, node: usize) -> String {
        let at = place(&self.walls.points.position[node]);
        let which = rim.nodes.iter().position(|n| *n == node);
        match (D, which) {
            (2, Some(0)) => format!("its last end at {at} is free"),
            (2, _) => format!("its first end at {at} is free"),
            _ => format!("its edge at {at} is free"),
        }
    }

    /// The place of a rim.
    fn ends(&self, rim: &Rim<D>) -> String {
        let points = &self.walls.points.position;
        match D {
            2 => {
                let ends: Vec<String> = rim.nodes.iter().map(|n| place(&points[*n])).collect();
                ends.join(" and ")
            }
            _ => {
                let [low, high] = rim.bounds(points);
                let wide = number::plain((high - low).norm());
                let centre = place(&rim.centre(points));
                format!("an opening {wide} m wide around {centre}")
            }
        }
    }

    /// Points of a rim with the nearest one of another skin within `reach`, and the distance, m: in the plane of both
    /// ends, in space the nearest.
    fn neighbouring_points(&self, rim: &Rim<D>, reach: f64) -> Vec<(usize, usize, f64)> {
        let points = &self.walls.points.position;
        let [low, high] = rim.bounds(points);
        let near = |x: &Vect<D>| (0..D).all(|k| low[k] - reach < x[k] && x[k] < high[k] + reach);
        let others = points.iter().enumerate().filter(|(k, x)| {
            let skin = self.skins.of_point[*k];
            skin.is_some_and(|s| !rim.skins.contains(&s)) && near(x)
        });
        let others: Vec<usize> = others.map(|(k, _)| k).collect();
        let nearest = |node: &usize| {
            let apart = |k: &usize| (*k, (points[*k] - points[*node]).norm());
            let nearest = others.iter().map(apart).min_by(|a, b| a.1.total_cmp(&b.1));
            let (other, _) = nearest.filter(|(_, apart)| *apart < reach)?;
            // Points are a spacing apart, and the wall between them is nearer.
            Some((*node, other, self.distance(*node, other)))
        };
        let mut all: Vec<_> = rim.nodes.iter().filter_map(nearest).collect();
        if D > 2 {
            all.sort_by(|a, b| a.2.total_cmp(&b.2));
            all.truncate(1);
        }
        all.reverse();
        all
    }

    /// Distance of a point from the elements at another one, m.
    fn distance(&self, node: usize, other: usize) -> f64 {
        let (points, elements) = (&self.walls.points.position, &self.walls.elements);
        let corners = elements.corners.iter().enumerate();
        let at = corners.filter(|(_, c)| c.contains(&(other as u32)));
        let apart = points[node] - points[other];
        let off = |(k, _): (usize, &[u32; D])| apart.dot(&elements.normal[k]).abs();
        at.map(off).fold(apart.norm(), f64::min)
    }

    /// Highest level of the fluid at the start, along the direction against gravity, m.
    fn level(&self) -> f64 {
        let Some(up) = self.up else {
            return f64::INFINITY;
        };
        let elements = &self.walls.elements;
        let open = elements.centre.iter().zip(&elements.open);
        let open = open.filter(|(_, open)| **open).map(|(x, _)| x);
        let heights = self.particles.iter().chain(open).map(|x| x.dot(&up));
        heights.fold(f64::NEG_INFINITY, f64::max)
    }

    /// A wall that holds no fluid, within one that does.
    fn turned(&self, k: usize) -> Option<Leak<D>> {
        let skin = &self.skins.all[k];
        let rimmed = self.skins.rims.iter().any(|r| r.skins.contains(&k));
        let mut others = self.skins.all.iter().enumerate();
        let inner =
            others.any(|(n, o)| n != k && o.holds && in_box(o, &skin.low) && in_box(o, &skin.high));
        if rimmed || !skin.holds || skin.open || !inner {
            return None;
        }
        if self.particles.iter().any(|x| in_box(skin, x)) {
            return None;
        }
        let what = "the fluid is to be inside of it, and none is there, while other fluid surrounds it: turn it with `flip = \
                    true`, or draw it the other way round";
        Some(self.leak(skin.wall, what, vec![skin.low, skin.high]))
    }
}

/// True if a place is in the box around a skin.
fn in_box<const D: usize>(skin: &Skin<D>, x: &Vect<D>) -> bool {
    (0..D).all(|k| skin.low[k] <= x[k] && x[k] <= skin.high[k])
}

/// The way to close a wall.
fn closing<const D: usize>() -> &'static str {
    if D == 2 { " (`closed = true`)" } else { "" }
}

fn place<const D: usize>(x: &Vect<D>) -> String {
    format!("({})", comma_list(x.iter().map(|x| number::plain(*x))))
}
