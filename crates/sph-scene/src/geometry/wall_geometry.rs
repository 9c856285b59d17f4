//! The geometry of a wall as lines or facets, scaled, turned and shifted.

use scene_text::surface::{Facets, Opening, cross, dot};
use sph_core::{Axis, SceneProblem, Winding, bounds, number, unit_factor};

use crate::drawings::format::lines;
use crate::drawings::rows::Form;
use crate::geometry::outlines::{Line, oriented, rectangle};
use crate::geometry::solid::{self, sides_of};
use crate::geometry::vector::{array, point, unit_axis};
use crate::reading::limits::{LINES, WALL_CORNERS};
use crate::tables::wall::{Face, Wedge};
use crate::{FluidSide, SphereWall, Wall};

/// Curves of drawings become lines within this many spacings.
const TOLERANCE: f64 = 0.05;
/// A geometry that is farther across than this many spacings is suspected of a wrong unit …
const ACROSS: f64 = 1e4;
/// … if it also needs more wall elements than this.
const ELEMENTS: f64 = 2e7;
/// Least extent of a geometry, in spacings.
const LEAST: f64 = 2.0;

/// Open surfaces of a smaller [`sense`] than this have no inside: a flat plate has 0, a cube without a lid 0.4.
const NO_INSIDE: f64 = 0.02;
/// Number of openings in a message.
const TOLD: usize = 3;

impl Wall {
    /// The lines of a wall in the plane, with the fluid on the left of travel; files are read.
    ///
    /// A `polyline` is given as it stands: the caller makes a plate of one that has a
    /// `thickness`. `place` is the path of the wall in the scene: `wall.tank`.
    ///
    /// # Errors
    /// If a file cannot be read or holds no such geometry, or the size does not fit the spacing.
    pub fn lines(&self, place: &str, spacing: f64) -> Result<Vec<Line>, SceneProblem> {
        let key = self.geometries().first().copied().unwrap_or("polyline");
        let problem = |why: String| SceneProblem::new(format!("{place}.{key}"), why);
        let factor = self.factor();
        let drawn = self.drawn(spacing / factor).map_err(problem)?;
        let corners: usize = drawn.iter().map(|line| line.points.len()).sum();
        if drawn.len() > LINES || corners > WALL_CORNERS {
            return Err(problem(format!(
                "the drawing has {} lines with {corners} corners; at most {LINES} lines with {WALL_CORNERS} \
                 corners are read",
                drawn.len()
            )));
        }
        // The sides of an open box run anticlockwise; their enclosed volume is not known yet.
        let open_box = self.bounds.is_some() && !self.open.is_empty();
        let side = match self.side() {
            Some(side) if !open_box => side,
            _ => FluidSide::AsDrawn,
        };
        let turned = self.flip || open_box && self.side() == Some(FluidSide::Outside);
        let lines = oriented(drawn, side).map_err(|(tangled, why)| match tangled {
            true => problem(why),
            false => SceneProblem::new(format!("{place}.fluid"), why),
        })?;
        let placing = Placing::new(self, factor);
        let placed = lines.into_iter().map(|line| {
            let mut line = if turned { line.reversed() } else { line };
            (line.points.iter_mut()).for_each(|x| *x = placing.flat(x));
            line
        });
        let lines: Vec<Line> = placed.collect();
        if self.polyline.is_none() {
            let length = lines.iter().map(length).sum::<f64>();
            let corners = bounds(lines.iter().flat_map(|l| l.points.iter().copied()));
            let fits = self.fits(&corners, length / spacing, spacing);
            fits.map_err(problem)?;
        }
        Ok(lines)
    }

    /// The triangles of a wall in space, right-hand normals into the fluid; files are read.
    ///
    /// Plane faces have as few triangles as possible. `place` is the path of the wall in the scene: `wall.tank`.
    ///
    /// # Errors
    /// If a file cannot be read or holds no such geometry, or the size does not fit the spacing.
    pub fn facets(&self, place: &str, spacing: f64) -> Result<Facets, SceneProblem> {
        let key = self.geometries().first().copied().unwrap_or("file");
        let problem = |why: String| SceneProblem::new(format!("{place}.{key}"), why);
        let factor = self.factor();
        let mut facets = match &self.path {
            Some(path) => {
                let (facets, odd) = Facets::read(path).map_err(problem)?;
                self.sided(facets, odd, place)?
            }
            None => {
                if let Some(ball) = &self.sphere {
                    // Known before any triangle is made.
                    let radius = factor * ball.shape.radius;
                    let area = 4.0 * std::f64::consts::PI * radius * radius;
                    let corners = [[-radius; 3], [radius; 3]];
                    self.fits(&corners, area / (spacing * spacing), spacing)
                        .map_err(problem)?;
                }
                let outward = self
                    .solid(spacing / factor)
                    .ok_or_else(|| problem("a geometry in space is missing".to_string()))?;
                match self.side() {
                    Some(FluidSide::Inside) => outward.flipped(),
                    _ => outward,
                }
            }
        };
        let placing = Placing::new(self, factor);
        facets.points.iter_mut().for_each(|x| *x = placing.apply(x));
        let elements = facets.area() / (spacing * spacing);
        let fits = self.fits(&facets.bounds(), elements, spacing);
        fits.map(|()| facets).map_err(problem)
    }

    /// The facets of a file with the fluid on the side of the wall's key; `odd` is the first facet whose normal
    /// in the file is not that of its corners.
    fn sided(
        &self,
        facets: Facets,
        odd: Option<usize>,
        place: &str,
    ) -> Result<Facets, SceneProblem> {
        let at = |key: &str, why: String| Err(SceneProblem::new(format!("{place}.{key}"), why));
        let topology = facets.topology();
        if let Some(first) = topology.flipped.first().filter(|_| !self.align) {
            let [corner, ..] = facets.corners(&facets.triangles[*first]);
            let (flipped, all) = (topology.flipped.len(), facets.triangles.len());
            let why = format!(
                "{flipped} of {all} facets face the other way than those beside them, the first is facet {} at {}: \
                 `align = true` turns them round",
                first + 1,
                point(&corner)
            );
            return at("file", why);
        }
        let facets = facets.turned(&topology.flipped);
        let side = match self.side().unwrap_or(FluidSide::AsDrawn) {
            FluidSide::AsDrawn => match odd.filter(|_| !self.align) {
                None => self.flip.then_some(true),
                Some(k) => {
                    let why = format!(
                        "the normal of facet {k} contradicts the order of its corners: give `fluid = \
                         \"inside\"` or \"outside\", which go by the corners, or write the file anew"
                    );
                    return at("fluid", why);
                }
            },
            side if topology.openings.is_empty() => {
                Some((facets.volume() > 0.0) != (side == FluidSide::Outside))
            }
            side => {
                let sense = sense(&facets);
                if sense.abs() < NO_INSIDE {
                    let why = format!(
                        "the surface has {}, and no inside: leave out `fluid` where the normals point into the \
                         fluid, `flip = true` turns them round",
                        openings(&topology.openings)
                    );
                    return at("fluid", why);
                }
                Some((sense > 0.0) != (side == FluidSide::Outside))
            }
        };
        let flipped = side == Some(true);
        Ok(if flipped { facets.flipped() } else { facets })
    }

    /// Number of corners or facets of the wall's shape, where it is not in the length of the scene itself; none of a
    /// file, which has its own error.
    pub fn declared(&self, spacing: f64) -> usize {
        let spacing = spacing / self.factor();
        let sides = |given, radius| sides_of(given, radius, spacing);
        let disc = self.disc.iter().map(|d| sides(d.sides, d.shape.radius));
        let ball = self.sphere.iter().map(|b| 20 * b.parts(spacing).pow(2));
        let cylinder = self.cylinder.iter();
        let cylinder = cylinder.map(|c| 4 * sides(c.sides, c.shape.radius));
        let cone = self.cone.iter().map(|c| 2 * sides(c.sides, c.shape.radius));
        disc.chain(ball).chain(cylinder).chain(cone).sum()
    }

    /// Factor from the numbers of the geometry to metres.
    pub(crate) fn factor(&self) -> f64 {
        let unit = self.unit.as_deref().and_then(|u| unit_factor(u, "m").ok());
        self.scale.or(unit).unwrap_or(1.0)
    }

    /// Lines as they are given; shapes go round anticlockwise or are turned later.
    fn drawn(&self, spacing: f64) -> Result<Vec<Line>, String> {
        let corners = |list: &[Vec<f64>]| list.iter().map(|p| array(p)).collect::<Vec<[f64; 2]>>();
        if let Some(points) = &self.polyline {
            let (points, closed) = (corners(points), self.closed);
            return Ok(vec![Line { points, closed }]);
        }
        if let Some(points) = &self.polygon {
            return Ok(vec![Line::closed(corners(points))]);
        }
        if let Some(disc) = &self.disc {
            let sides = sides_of(disc.sides, disc.shape.radius, spacing);
            let centre: [f64; 2] = array(&disc.shape.centre);
            let ring = solid::ring(disc.shape.radius, sides, disc.turn);
            let points = ring.iter().map(|p| [centre[0] + p[0], centre[1] + p[1]]);
            return Ok(vec![Line::closed(points.collect())]);
        }
        if let Some([lo, hi]) = &self.bounds {
            return Ok(rectangle(array(lo), array(hi), &self.open));
        }
        if let Some(wedge) = &self.wedge {
            return Ok(vec![Line::closed(wedge.plane(Face::YPlus))]);
        }
        let path = self.path.as_ref();
        let path = path.ok_or("a geometry in the plane is missing")?;
        // A drawing that is scaled later is taken as it stands, else the heads of the columns may have units.
        let scaled = self.unit.is_some() || self.scale.is_some();
        let form = Form::places(&self.columns, scaled.then_some(1.0));
        lines(path, TOLERANCE * spacing, &form)
    }

    /// The surface of a shape, facing outwards.
    fn solid(&self, spacing: f64) -> Option<Facets> {
        let ring =
            |given, radius: f64, turn| solid::ring(radius, sides_of(given, radius, spacing), turn);
        if let Some([lo, hi]) = &self.bounds {
            return Some(solid::cuboid(array(lo), array(hi), &self.open));
        }
        if let Some(ball) = &self.sphere {
            let (centre, parts) = (array(&ball.shape.centre), ball.parts(spacing));
            return Some(solid::sphere(centre, ball.shape.radius, parts));
        }
        if let Some(c) = &self.cylinder {
            let ring = ring(c.sides, c.shape.radius, c.turn);
            let (from, to) = (array(&c.shape.from), array(&c.shape.to));
            return Some(solid::cylinder(from, to, &ring, c.open_ends));
        }
        if let Some(c) = &self.cone {
            let ring = ring(c.sides, c.shape.radius, c.turn);
            let (base, apex) = (array(&c.shape.base), array(&c.shape.apex));
            return Some(solid::cone(base, apex, &ring));
        }
        if let Some(wedge) = &self.wedge {
            let up = wedge.up.unwrap_or(Face::ZPlus);
            let across = 3 - wedge.rise.axis() - up.axis();
            let axis = [Axis::X, Axis::Y, Axis::Z][across];
            let ends = [wedge.lo[across], wedge.hi[across]];
            let plane = wedge.plane(Face::ZPlus);
            return Some(solid::extrusion(&plane, axis, ends, false));
        }
        let whole = self.extrusion.as_ref()?;
        let e = &whole.shape;
        let polygon: Vec<[f64; 2]> = e.polygon.iter().map(|p| array(p)).collect();
        let ends = [e.from, e.to];
        Some(solid::extrusion(&polygon, e.axis, ends, whole.open_ends))
    }

    /// Refuses lengths that are absurdly large or small against the spacing.
    fn fits<const D: usize>(
        &self,
        [lo, hi]: &[[f64; D]; 2],
        elements: f64,
        spacing: f64,
    ) -> Result<(), String> {
        let across = (0..D).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
        let told = self.unit.is_some() || self.scale.is_some();
        let advice = |plain: &'static str, file: &'static str| match (&self.file, told) {
            (Some(_), false) => file,
            (Some(_), true) => "is the factor from `unit` or `scale` right?",
            (None, _) => plain,
        };
        if across < LEAST * spacing {
            let other = "are the coordinates in another unit? give for instance `unit = \"km\"`";
            let advice = advice("take a smaller spacing", other);
            return Err(format!(
                "it is {across:.3e} m across, less than {LEAST} spacings of {spacing} m: {advice}"
            ));
        }
        if across > ACROSS * spacing && elements > ELEMENTS || !elements.is_finite() {
            let other = "are the coordinates in millimetres? give `unit = \"mm\"`";
            let advice = advice("take a larger spacing", other);
            return Err(format!(
                "it is {across:.3e} m across and would need {elements:.1e} wall elements at a \
                 spacing of {spacing} m: {advice}"
            ));
        }
        Ok(())
    }
}

impl SphereWall {
    /// Parts of every edge of the icosahedron, at a spacing in the unit of the geometry.
    fn parts(&self, spacing: f64) -> usize {
        let open = || solid::subdivisions(self.shape.radius / spacing);
        self.subdivisions.unwrap_or_else(open)
    }
}

impl Wedge {
    /// The triangle in the plane of `rise` and `up`, its right angle at the high end, as coordinates in the order of the
    /// axes.
    fn plane(&self, up: Face) -> Vec<[f64; 2]> {
        let (rise, up) = (self.rise, self.up.unwrap_or(up));
        // Where the box begins and ends in a direction.
        let ends = |face: Face| {
            let [lo, hi] = [&self.lo, &self.hi].map(|c| c.get(face.axis()).copied().unwrap_or(0.0));
            if face.upper() { [lo, hi] } else { [hi, lo] }
        };
        let ([near, far], [low, high]) = (ends(rise), ends(up));
        let place = |along: f64, height: f64| match rise.axis() < up.axis() {
            true => [along, height],
            false => [height, along],
        };
        vec![place(near, low), place(far, low), place(far, high)]
    }
}

fn length(line: &Line) -> f64 {
    let closing = line.points.first().filter(|_| line.closed);
    let ends = line.points.iter().skip(1).chain(closing);
    let edges = line.points.iter().zip(ends);
    edges.map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
}

/// x → turn·(factor·x − centre) + centre + shift.
struct Placing {
    factor: f64,
    turn: Option<RotationAxis>,
    shift: [f64; 3],
}

struct RotationAxis {
    centre: [f64; 3],
    axis: [f64; 3],
    cos: f64,
    sin: f64,
}

impl Placing {
    pub fn new(wall: &Wall, factor: f64) -> Self {
        let turn = wall.rotate.as_ref().map(|rotate| RotationAxis {
            centre: array(rotate.centre.as_deref().unwrap_or(&[])),
            axis: unit_axis(&rotate.axis),
            cos: solid::clean(rotate.angle.cos()),
            sin: solid::clean(rotate.angle.sin()),
        });
        Placing {
            factor,
            turn,
            shift: array(wall.translate.as_deref().unwrap_or(&[])),
        }
    }

    pub fn apply(&self, x: &[f64; 3]) -> [f64; 3] {
        let mut x = x.map(|c| self.factor * c);
        if let Some(turn) = &self.turn {
            let arm: [f64; 3] = std::array::from_fn(|k| x[k] - turn.centre[k]);
            let across = cross(&turn.axis, &arm);
            let along = dot(&turn.axis, &arm) * (1.0 - turn.cos);
            x = std::array::from_fn(|k| {
                let turned = turn.cos * arm[k] + turn.sin * across[k] + along * turn.axis[k];
                turn.centre[k] + turned
            });
        }
        std::array::from_fn(|k| x[k] + self.shift[k])
    }

    pub fn flat(&self, x: &[f64; 2]) -> [f64; 2] {
        let [x, y, _] = self.apply(&[x[0], x[1], 0.0]);
        [x, y]
    }
}

/// Side that a surface faces: [`Winding::sense`].
pub fn sense(facets: &Facets) -> f64 {
    let corners = facets.triangles.iter().map(|t| facets.corners(t));
    Winding::sense(&corners.collect::<Vec<_>>())
}

/// The largest openings in words, in the unit of the file.
fn openings(all: &[Opening]) -> String {
    let opening = |o: &Opening| {
        let (edges, size, centre) = (o.edges, number::plain(o.size), point(&o.centre));
        format!("{edges} edges, {size} across, around {centre}")
    };
    let told: Vec<String> = all.iter().take(TOLD).map(opening).collect();
    let more = if all.len() > TOLD { "; …" } else { "" };
    format!("{} openings ({}{more})", all.len(), told.join("; "))
}
