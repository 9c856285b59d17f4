//! The shape of a zone, and the band around it.

use sph_boundary::Wall;
use sph_core::Vect;
use sph_neighbours::{Domain, Frame as Pose};
use sph_scene::{Scene, Shape, Zone};
use sph_solver::Flow;

use super::sample::REACH;

/// Width of the band over the support of the finer particles: those of the zone have all neighbours in its inner half, and
/// these have all of theirs in the band.
const BAND: f64 = 2.0;

/// The shape of a zone, where it was drawn and where it is.
#[derive(Clone, Debug)]
pub(crate) struct Frame<const D: usize> {
    /// Shape as it was drawn; along a period that a box spans it has no sides.
    pub shape: Shape<D>,
    /// Width of the band around it, m.
    pub band: f64,
    /// The shape of its core, in which the flow around is led by the zone.
    core: Shape<D>,
    /// Distance of the core behind that shape, m.
    inset: f64,
    /// The wall that carries it.
    carrier: Option<String>,
    /// The pose of that wall, and the domain with its periods.
    carried: Option<(Pose<D>, Domain<D>)>,
}

impl<const D: usize> Frame<D> {
    /// The shape of a zone whose particles have a support, m; none if the zone has no shape.
    pub fn new(scene: &Scene, zone: &Zone, support: f64) -> Option<Self> {
        let mut shape = zone.shape_in::<D>(scene)?;
        if let Shape::Cuboid { lo, hi } = &mut shape {
            let periods = scene.numerics.periodic.bounds::<D>();
            for (k, period) in periods.into_iter().enumerate() {
                if period.is_some_and(|[from, to]| lo[k] <= from && to <= hi[k]) {
                    (lo[k], hi[k]) = (f64::NEG_INFINITY, f64::INFINITY);
                }
            }
        }
        Some(Frame {
            core: shape.clone(),
            shape,
            band: BAND * support,
            inset: 0.0,
            carrier: zone.carrier(scene).cloned(),
            carried: None,
        })
    }

    /// The same in the present state of a flow.
    pub fn at(&self, flow: &Flow<D>) -> Self {
        let walls = &flow.world.walls;
        let carrier = self.carrier.as_ref();
        let wall = carrier.and_then(|wall| walls.names.iter().position(|name| name == wall));
        let pose = wall.and_then(|wall| walls.frames.get(wall));
        Frame {
            carried: pose.map(|pose| (*pose, flow.world.domain.clone())),
            ..self.clone()
        }
    }

    /// A place as it would be with the shape where it was drawn.
    fn drawn(&self, x: &Vect<D>) -> [f64; D] {
        let Some((pose, domain)) = &self.carried else {
            return (*x).into();
        };
        let (low, high) = self.shape.bounds();
        let middle = |k: usize| {
            if low[k].is_finite() {
                0.5 * (low[k] + high[k])
            } else {
                0.0
            }
        };
        let centre = Vect::from_fn(|k, _| middle(k));
        let way = domain.nearest(x - pose.present(&centre));
        (centre + pose.turned_back(&way)).into()
    }

    /// With a core that begins a fit's radius behind each side with fluid before it; `spacing` is that around the zone, m.
    ///
    /// Between core and side both flows are computed: a flow that is fitted to the other at once copies its own errors.
    pub fn with_core(mut self, walls: Option<&dyn Wall<D>>, spacing: f64) -> Self {
        let Shape::Cuboid { mut lo, mut hi } = self.shape else {
            self.inset = REACH * spacing;
            return self;
        };
        for axis in 0..D {
            for (end, side, inwards) in [(&mut lo, 0, 1.0), (&mut hi, 1, -1.0)] {
                if self.is_open(walls, spacing, (axis, side)) {
                    end[axis] += inwards * REACH * spacing;
                }
            }
        }
        self.core = Shape::Cuboid { lo, hi };
        self
    }

    /// True if there may be fluid before a side of the box around it: a place in front of all walls, or a zone that moves.
    pub fn is_open(
        &self,
        walls: Option<&dyn Wall<D>>,
        spacing: f64,
        (axis, side): (usize, usize),
    ) -> bool {
        let (low, high) = self.shape.bounds();
        let ends = [low, high];
        if !ends[side][axis].is_finite() {
            return false;
        }
        let Some(walls) = walls.filter(|_| self.carrier.is_none()) else {
            return true;
        };
        let outwards = if side == 0 { -1.0 } else { 1.0 };
        // Along a period that the box spans all places are alike for what stands in it.
        let first = ends[side][axis] + 0.25 * outwards * spacing;
        let span = |k: usize| match (k == axis, low[k].is_finite()) {
            (true, _) => (first, outwards * spacing, 3),
            (false, true) => {
                let length = high[k] - low[k];
                let count = (length / spacing).ceil();
                (low[k], length / count, count as usize + 1)
            }
            (false, false) => (0.0, 0.0, 1),
        };
        let spans: [_; D] = std::array::from_fn(span);
        let places: usize = spans.iter().map(|(_, _, count)| count).product();
        (0..places).any(|mut place| {
            let x = Vect::from_fn(|k, _| {
                let (first, step, count) = spans[k];
                let number = place % count;
                place /= count;
                first + step * number as f64
            });
            walls.contains(&x)
        })
    }

    /// True if a place is in the shape widened by a margin, m.
    pub fn holds(&self, x: &Vect<D>, margin: f64) -> bool {
        holds(&self.shape, &self.drawn(x), margin)
    }

    /// True if a place is in the outer half of the band, or beyond it.
    pub fn is_outer(&self, x: &Vect<D>) -> bool {
        !self.holds(x, 0.5 * self.band)
    }

    /// True if a place is in the core.
    pub fn in_core(&self, x: &Vect<D>) -> bool {
        holds(&self.core, &self.drawn(x), -self.inset)
    }

    /// The wall that carries it; it stays if there is none.
    pub fn carrier(&self) -> Option<&String> {
        self.carrier.as_ref()
    }

    /// Corners of the box around the shape where it was drawn, widened by a margin, m.
    pub fn corners(&self, margin: f64) -> [Vect<D>; 2] {
        let (low, high) = self.shape.bounds();
        let [low, high] = [low, high].map(Vect::from);
        [low.add_scalar(-margin), high.add_scalar(margin)]
    }
}

/// True if a place is in a shape widened by a margin, m; boxes keep their corners.
fn holds<const D: usize>(shape: &Shape<D>, x: &[f64; D], margin: f64) -> bool {
    match shape {
        Shape::Cuboid { lo, hi } => (0..D).all(|k| lo[k] - margin <= x[k] && x[k] < hi[k] + margin),
        _ => shape.depth(x) >= -margin,
    }
}
