//! Shapes of zones, by the walls of their scene.

use sph_core::bounds;

use crate::geometry::periodic_place::fills;
use crate::geometry::surround::Surround;
use crate::geometry::vector::array;
use crate::{Scene, Shape, Wall, Zone};

/// Segments of a wall in the plane, its triangles in space.
fn elements<const D: usize>(wall: &Wall, spacing: f64) -> Vec<[[f64; D]; D]> {
    if D == 3 {
        let facets = wall.facets("", spacing).unwrap_or_default();
        let corner = |k: &u32| array(&facets.points[*k as usize]);
        let corners = |t: &[u32; 3]| std::array::from_fn(|k| corner(&t[k]));
        return facets.triangles.iter().map(corners).collect();
    }
    let lines = wall.lines("", spacing).unwrap_or_default();
    let segments = lines.iter().flat_map(|line| {
        let next = line.points.iter().cycle().skip(1);
        let count = line.points.len().saturating_sub(usize::from(!line.closed));
        line.points.iter().zip(next).take(count)
    });
    let corners = |(from, to): (&[f64; 2], &[f64; 2])| {
        std::array::from_fn(|k| array(if k == 0 { from } else { to }))
    };
    segments.map(corners).collect()
}

impl Zone {
    /// Its shape in a scene, if it has one in D dimensions.
    pub fn shape_in<const D: usize>(&self, scene: &Scene) -> Option<Shape<D>> {
        match &self.near {
            Some(near) => {
                let spacing = scene.numerics.spacing;
                let elements = elements::<D>(scene.wall.get(&near.wall)?, spacing);
                let [low, high] = bounds(elements.iter().flatten().copied());
                let periods = scene.numerics.periodic.bounds::<D>();
                let endless = fills((&low, &high), spacing, &periods);
                let some = !elements.is_empty();
                some.then(|| Shape::Surround(Surround::new(elements, near.distance, endless)))
            }
            None => self.shape.shape(),
        }
    }

    /// The wall that carries it: the wall of `follows`, else a moving wall of `near`.
    pub fn carrier<'a>(&'a self, scene: &Scene) -> Option<&'a String> {
        let moves = |wall: &Wall| wall.motion.is_some() || !wall.mover.is_empty();
        let near = self.near.as_ref().map(|near| &near.wall);
        let moving = near.filter(|wall| scene.wall.get(*wall).is_some_and(moves));
        self.follows.as_ref().or(moving)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(walls: &str) -> Scene {
        let text = format!(
            "title = \"near\"\ndimension = 2\nrun.end = 1.0\nnumerics.spacing = 0.1\nnumerics.smoothing_ratio = 2.0\n\
             numerics.periodic.x = [0.0, 4.0]\n[zone.near]\nnear = {{ wall = \"floor\", distance = 0.5 }}\n{walls}"
        );
        let table: toml::Table = text.parse().expect("TOML");
        table.try_into().expect("a scene")
    }

    #[test]
    fn depths_are_distances_from_the_wall() {
        let step = scene("[wall.floor]\npolyline = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]\n");
        let shape = step.zone["near"].shape_in::<2>(&step).expect("a shape");
        for (x, depth) in [
            ([1.5, 0.2], 0.3),
            ([1.5, -0.2], 0.3),
            ([2.6, 0.5], -0.1),
            ([0.7, -0.4], 0.0),
            ([2.3, 1.4], 0.0),
        ] {
            assert!((shape.depth(&x) - depth).abs() < 1e-15, "{x:?}");
        }
        assert_eq!(shape.bounds(), ([0.5, -0.5], [2.5, 1.5]));
    }

    #[test]
    fn a_wall_through_the_period_has_no_ends() {
        let floor = scene("[wall.floor]\npolyline = [[0.0, 0.0], [4.0, 0.0]]\n");
        let shape = floor.zone["near"].shape_in::<2>(&floor).expect("a shape");
        let (low, high) = shape.bounds();
        assert_eq!([low[1], high[1]], [-0.5, 0.5]);
        assert_eq!([low[0], high[0]], [f64::NEG_INFINITY, f64::INFINITY]);
        assert!((shape.depth(&[4.0, 0.1]) - 0.4).abs() < 1e-15);
    }

    #[test]
    fn a_zone_near_a_moving_wall_follows_it() {
        let still = scene("[wall.floor]\ndisc = { centre = [1.0, 0.0], radius = 0.2 }\n");
        assert_eq!(still.zone["near"].carrier(&still), None);
        let moving = "[wall.floor]\ndisc = { centre = [1.0, 0.0], radius = 0.2 }\nmotion.velocity = [1.0, 0.0]\n";
        let moving = scene(moving);
        assert_eq!(
            moving.zone["near"].carrier(&moving),
            Some(&"floor".to_string())
        );
    }
}
