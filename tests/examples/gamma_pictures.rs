//! Draws γ, the share of the kernel on the fluid's side of the walls, for docs/walls.md: around a
//! gear from an SVG drawing, and on a slice through the tank of `hydrostatic-tank-3d`.
//!
//! ```sh
//! cargo run --release -p sph-tests --example gamma_pictures
//! ```

use std::error::Error;
use std::path::Path;

use sph_boundary::{
    Drawing, Gammas, PeriodicBox, PlanarWalls, Polyline, SpatialWalls, Surface, WallMesh, WallSpec,
};
use sph_core::Vect;
use sph_io::{Picture, View};
use sph_kernels::{Kernel, wendland_c2};
use sph_scene::{Facets, Line, Scene, load, parse};

/// A gear in a fluid, and a fluid in the bore of the gear.
const GEAR: &str = r#"
title = "A gear in a fluid"
dimension = 2
[run]
end = 1.0
[numerics]
spacing = "4 mm"
[wall.gear]
file = "docs/images/gear.svg"
unit = "mm"
fluid = "outside"
[phase.water]
density = 1000.0
speed_of_sound = 10.0
[phase.water.rheology.newtonian]
viscosity = "1 mPa s"
[body.water]
phase = "water"
box = [[0.0, 0.0], [0.24, 0.24]]
clip = true
"#;

/// Points of a picture along its width.
const ACROSS: f64 = 300.0;
/// Values are drawn in bands of this height.
const BAND: f64 = 0.02;

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let images = root.join("docs/images");
    let place = root.join("gear.toml").display().to_string();
    gear(&parse(GEAR, &place, &[])?.scene, &images)?;
    let tank = load(&root.join("scenes/hydrostatic-tank-3d.toml"), &[])?;
    pyramid(&tank.scene, &images)
}

fn gear(scene: &Scene, images: &Path) -> Result<(), Box<dyn Error>> {
    let mut walls = Vec::new();
    for (name, wall) in &scene.wall {
        for Line { points, closed } in wall.lines(name, scene.numerics.spacing)? {
            let name = name.clone();
            walls.push(WallSpec::at_rest(Drawing::Line(Polyline {
                name,
                points,
                closed,
            })));
        }
    }
    let slice = |u: f64, v: f64| Vect::<2>::new(u, v);
    let window = [[0.0, 0.24], [0.0, 0.24]];
    let field = Field::<2, PlanarWalls>::new(&walls, scene)?;
    let picture = field.on(&window, &slice);
    let lines = field.edges(|x| [x[0], x[1], 0.0], |_| true);
    Picture {
        title: "γ around a gear, δr = 4 mm, support 16 mm",
        label: "γ",
        diameter: 1.5 * picture.apart, // no gaps
        walls: &lines,
        window: Some(window),
        range: Some([0.2, 1.0]),
        width: 760,
        ..Picture::new(&picture.points, &picture.values)
    }
    .save(images.join("gamma-gear.png"))?;
    Ok(())
}

fn pyramid(scene: &Scene, images: &Path) -> Result<(), Box<dyn Error>> {
    let mut walls = Vec::new();
    for (name, wall) in &scene.wall {
        let Facets { points, triangles } = wall.facets(name, scene.numerics.spacing)?;
        let name = name.clone();
        let surface = Surface {
            name,
            points,
            triangles,
        };
        walls.push(WallSpec::at_rest(Drawing::Surface(surface)));
    }
    // Through the tip of the pyramid, seen along +y.
    let slice = |u: f64, v: f64| Vect::<3>::new(u, 0.25, v);
    let window = [[0.0, 0.5], [0.0, 0.3]];
    let field = Field::<3, SpatialWalls>::new(&walls, scene)?;
    let picture = field.on(&window, &slice);
    // The mesh of the face behind the slice shows where the pyramid is cut.
    let lines = field.edges(|x| x.into(), |normal| normal[1] > 0.5);
    Picture {
        title: "γ on a slice through a pyramid, δr = 25 mm, support 100 mm",
        label: "γ",
        diameter: 1.5 * picture.apart, // no gaps
        walls: &lines,
        view: View::Front,
        window: Some(window),
        range: Some([0.1, 1.0]),
        width: 760,
        ..Picture::new(&picture.points, &picture.values)
    }
    .save(images.join("gamma-pyramid.png"))?;
    Ok(())
}

/// γ over the fluid.
struct Field<const D: usize, M: WallMesh<D>> {
    mesh: M,
    integrals: M::Integrals,
    support: f64,
}

/// Points of a slice, m, with γ there.
struct Slice {
    points: Vec<[f64; 3]>,
    values: Vec<f64>,
    apart: f64,
}

impl<const D: usize, M: WallMesh<D>> Field<D, M> {
    fn new(walls: &[WallSpec<D>], scene: &Scene) -> Result<Self, Box<dyn Error>> {
        let (kernel, spacing) = (wendland_c2(), scene.numerics.spacing);
        let h = scene.numerics.smoothing_ratio * spacing;
        let support = kernel.support() * h;
        let shape = kernel.polynomial().ok_or("the kernel is no polynomial")?;
        Ok(Field {
            mesh: M::build(walls, spacing, support, &PeriodicBox::none())?,
            integrals: M::integrals(shape, h)?,
            support,
        })
    }

    /// γ at the points of the window that are in the fluid.
    fn on(&self, window: &[[f64; 2]; 2], slice: &dyn Fn(f64, f64) -> Vect<D>) -> Slice {
        let [[left, right], [bottom, top]] = *window;
        let apart = (right - left) / ACROSS;
        let (mut points, mut values) = (Vec::new(), Vec::new());
        let mut contacts = sph_neighbours::ContactBlock::default();
        let count = |from: f64, to: f64| ((to - from) / apart).round() as usize;
        for j in 0..count(bottom, top) {
            for i in 0..count(left, right) {
                let u = left + (i as f64 + 0.5) * apart;
                let v = bottom + (j as f64 + 0.5) * apart;
                let x = slice(u, v);
                if !self.mesh.contains(&x) {
                    continue;
                }
                contacts.clear();
                let near = self.mesh.near(&x, self.support);
                let (one, room) = ([(&x, &near[..])].into_iter(), &mut Default::default());
                let mut found = Gammas::default();
                self.mesh
                    .gammas(&self.integrals, one, room, &mut contacts, &mut found);
                let gamma = found.all[0].0;
                values.push((gamma / BAND).round() * BAND);
                points.push(if D == 2 { [u, v, 0.0] } else { [u, x[1], v] });
            }
        }
        Slice {
            points,
            values,
            apart,
        }
    }

    /// The edges of elements, as they are cut at the spacing, with a normal that is wanted.
    fn edges(
        &self,
        place: impl Fn(Vect<D>) -> [f64; 3],
        wanted: impl Fn(&Vect<D>) -> bool,
    ) -> Vec<[[f64; 3]; 2]> {
        let nodes: Vec<_> = self.mesh.places().into_iter().map(place).collect();
        let node = |k: usize| nodes[k];
        let ends = |c: [usize; D]| (0..D - 1 + D / 3).map(move |k| [c[k], c[(k + 1) % D]]);
        let elements = self.mesh.elements().iter();
        let elements = elements.filter(|e| wanted(&e.normal.into()));
        let all = elements.flat_map(|e| ends(e.nodes));
        all.map(|[a, b]| [node(a), node(b)]).collect()
    }
}
