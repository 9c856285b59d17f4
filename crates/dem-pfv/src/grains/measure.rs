//! Measurements: energies, the unbalanced force ratio, stresses, strains, porosity.

use nalgebra::Matrix3;

use crate::grains::{ContactLaw, GrainError, GrainSystem, Partner, Slot, Vector};
use crate::sphere;

/// A contact as it was at the last evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// The first body, a grain.
    pub grain: usize,
    /// The second body.
    pub partner: Partner,
    /// Unit normal from the second body to the first.
    pub normal: Vector,
    /// Depth of the overlap, m.
    pub overlap: f64,
    /// Contact point, in the middle of the overlap, m.
    pub point: Vector,
    /// Force on the first body, N.
    pub force: Vector,
    /// True where the tangential force is at the limit of friction.
    pub sliding: bool,
}

/// Relative distance from the limit of friction that rounding leaves to a contact that slides.
const ROUNDING: f64 = 1e-9;

impl GrainSystem {
    /// All contacts of the last evaluation.
    pub fn contacts(&self) -> impl Iterator<Item = Touch> {
        let parts = 0..self.table.ends.len();
        parts.flat_map(move |part| {
            let slots = self.table.slots[self.table.part(part)].iter();
            slots.filter(|s| s.active).map(move |s| self.touch(part, s))
        })
    }

    /// The second body of a contact in a part of the table.
    pub(crate) fn partner(&self, part: usize, slot: &Slot) -> Partner {
        let (second, walls) = (slot.second as usize, self.walls.len());
        match part {
            0 => Partner::Grain(second),
            part if part <= walls => Partner::Wall(part - 1),
            part => Partner::Triangle(part - 1 - walls, second),
        }
    }

    /// The law of the contacts in a part of the table.
    pub(crate) fn law_of(&self, part: usize) -> &dyn ContactLaw {
        let walls = self.walls.iter().map(|w| w.law);
        let others = walls.chain(self.meshes.iter().map(|m| m.law));
        let number = std::iter::once(0).chain(others).nth(part);
        &*self.laws[number.unwrap_or_default()]
    }

    fn touch(&self, part: usize, slot: &Slot) -> Touch {
        let grain = slot.first as usize;
        let arm = self.grains.radius[grain] - 0.5 * slot.overlap;
        let normal = slot.force.dot(&slot.normal);
        let tangential = (slot.force - slot.normal * normal).norm();
        let limit = self.law_of(part).friction() * normal.max(0.0);
        Touch {
            grain,
            partner: self.partner(part, slot),
            normal: slot.normal,
            overlap: slot.overlap,
            point: self.grains.position[grain] - slot.normal * arm,
            force: slot.force,
            sliding: tangential >= limit * (1.0 - ROUNDING),
        }
    }

    /// Share of the contacts between grains whose tangential force is at the limit of friction; none without contacts.
    pub fn sliding_share(&self) -> Option<f64> {
        let between = |t: &Touch| matches!(t.partner, Partner::Grain(_));
        let all = self.contacts().filter(between);
        let (sum, count) = all.fold((0.0, 0.0), |(s, n), t| (s + f64::from(t.sliding), n + 1.0));
        (count > 0.0).then(|| sum / count)
    }

    /// Σ ½ m v² + ½ J ω², J, with the velocities in the middle of the last step.
    pub fn kinetic_energy(&self) -> f64 {
        let g = &self.grains;
        let one = |i: usize| {
            let shift = g.mass[i] * g.velocity[i].norm_squared();
            0.5 * (shift + g.inertia(i) * g.spin[i].norm_squared())
        };
        (0..g.len()).map(one).sum()
    }

    /// λ, the mean resultant force on a grain over the mean contact force; infinite without contacts. Held grains do
    /// not count. Source: Catalano 2012, Eq. (2.16), with the norms inside the sums, without which both vanish.
    pub fn unbalanced_force(&self) -> f64 {
        match self.mean_forces() {
            (_, 0.0) => f64::INFINITY,
            (resultant, contact) => resultant / contact,
        }
    }

    /// Contacts per grain, those between grains counted for both.
    pub fn coordination(&self) -> f64 {
        let pairs = self.table.part(0);
        let weight = |k: usize| if pairs.contains(&k) { 2.0 } else { 1.0 };
        let slots = self.table.slots.iter().enumerate();
        let touching = slots.filter(|(_, s)| s.active).map(|(k, _)| weight(k));
        touching.sum::<f64>() / self.grains.len() as f64
    }

    /// Σ_c l n ⊗ F, J, over the contacts of a grain.
    fn moment(&self, grain: usize) -> Matrix3<f64> {
        let mut sum = Matrix3::zeros();
        for (slot, _) in self.table.slots_of(grain).filter(|(slot, _)| slot.active) {
            let arm = self.grains.radius[grain] - 0.5 * slot.overlap;
            sum += slot.normal * slot.force.transpose() * arm;
        }
        sum
    }

    /// Mean stress in each grain, Pa, positive in compression: σ = −(1/V) Σ_c (x^C − x) ⊗ F^c with the grain's
    /// volume V. Source: Catalano 2012, Eqs. (2.17), (2.18), with the other sign.
    pub fn grain_stresses(&self) -> Vec<Matrix3<f64>> {
        let radii = self.grains.radius.iter().enumerate();
        radii.map(|(i, r)| self.moment(i) / sphere(*r)).collect()
    }

    /// Love–Weber stress of all contacts in a volume (m³), Pa, positive in compression: (1/V) Σ_grains Σ_c l n ⊗ F.
    pub fn stress(&self, volume: f64) -> Matrix3<f64> {
        let moments = (0..self.grains.len()).map(|grain| self.moment(grain));
        moments.sum::<Matrix3<f64>>() / volume
    }

    /// Length of the box along an axis, m: the period, or the distance of the two walls that face each other.
    fn length(&self, axis: usize) -> Option<f64> {
        if let Some([from, to]) = self.period[axis] {
            return Some(to - from);
        }
        let facing = |sign| self.walls.iter().find(|w| w.axis() == Some((axis, sign)));
        Some(facing(-1.0)?.point[axis] - facing(1.0)?.point[axis])
    }

    /// Lengths of the box between walls along the axes and periods, m, if it is closed.
    pub fn box_lengths(&self) -> Option<[f64; 3]> {
        Some([self.length(0)?, self.length(1)?, self.length(2)?])
    }

    /// Area of the box across an axis, m².
    ///
    /// # Errors
    /// If the box is not closed.
    pub fn section(&self, axis: usize) -> Result<f64, GrainError> {
        let lengths = self.box_lengths().ok_or(GrainError::NoArea(2 * axis))?;
        Ok(lengths[(axis + 1) % 3] * lengths[(axis + 2) % 3])
    }

    /// Normal component of the contact forces that cross a plane normal to an axis, over the plane's area (Pa),
    /// positive in compression: the effective stress σ'. Grains belong to the side of their centres.
    ///
    /// # Errors
    /// If the box is not closed.
    pub fn effective_stress(&self, axis: usize, at: f64) -> Result<f64, GrainError> {
        let above = |grain: usize| self.grains.position[grain][axis] >= at;
        let mut force = 0.0;
        for touch in self.contacts() {
            let first = above(touch.grain);
            let second = match touch.partner {
                Partner::Grain(other) => above(other),
                Partner::Wall(wall) if self.walls[wall].normal[axis].abs() > 0.5 => {
                    self.walls[wall].point[axis] >= at
                }
                _ => first,
            };
            if first != second {
                force += if first { 1.0 } else { -1.0 } * touch.force[axis];
            }
        }
        Ok(force / self.section(axis)?)
    }

    /// The highest point of a grain, m.
    pub fn highest(&self) -> f64 {
        let tops = self.grains.position.iter().zip(&self.grains.radius);
        tops.map(|(x, r)| x.z + r).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Volume of the box, m³, if it is closed.
    pub fn box_volume(&self) -> Option<f64> {
        Some(self.box_lengths()?.iter().product())
    }

    /// n = 1 − Σ (4/3) π R³ / V of the box. Source: Catalano 2012, Eq. (1.1).
    pub fn porosity(&self) -> Option<f64> {
        Some(1.0 - self.grains.volume() / self.box_volume()?)
    }

    pub(crate) fn height(&self, wall: usize) -> Result<f64, GrainError> {
        let axis = self.walls[wall].axis().map(|(axis, _)| axis);
        let length = axis.and_then(|axis| self.length(axis));
        length.ok_or(GrainError::NoArea(wall))
    }

    /// Area of a wall, m²: the given one, or that between the box's other walls.
    ///
    /// # Errors
    /// If it is not given and the box is not closed along the other two axes.
    pub fn wall_area(&self, wall: usize) -> Result<f64, GrainError> {
        let area = self.walls.get(wall).and_then(|w| {
            let side = |k: usize| self.length((w.axis()?.0 + k) % 3);
            w.area.or_else(|| Some(side(1)? * side(2)?))
        });
        area.ok_or(GrainError::NoArea(wall))
    }

    /// Normal stress at a wall, Pa, positive in compression: the push of grains and fluid over its area.
    ///
    /// # Errors
    /// As [`GrainSystem::wall_area`].
    pub fn wall_stress(&self, wall: usize) -> Result<f64, GrainError> {
        Ok(self.walls[wall].push() / self.wall_area(wall)?)
    }

    /// Mean normal stress, Pa: of all walls, or where there are periods that of [`GrainSystem::stress`] in the box.
    ///
    /// # Errors
    /// If the box is not closed.
    pub fn mean_stress(&self) -> Result<f64, GrainError> {
        let volume = self.box_volume().ok_or(GrainError::NoArea(0))?;
        if self.period.iter().any(Option::is_some) {
            return Ok(self.stress(volume).trace() / 3.0);
        }
        let stresses = (0..self.walls.len()).map(|w| self.wall_stress(w));
        let sum: f64 = stresses.sum::<Result<f64, _>>()?;
        Ok(sum / self.walls.len() as f64)
    }
}

/// Small strain ε = ½ (∇u + ∇uᵀ) around each grain from displacements u (m), positive in extension.
///
/// In each tetrahedron of grains, u is linear between the centres, so that ⟨∇u⟩ = (1/V) Σ_facets ū ⊗ S; a
/// grain takes the mean of its tetrahedra, weighted by their volumes, and zero if it has none. Tetrahedra that
/// name a grain that is not there or are flat are left out. Source: Catalano 2012, Eqs. (2.20), (2.21), in space; the
/// printed factor 1/L there is 1/S.
pub fn strains(
    tetrahedra: &[[usize; 4]],
    positions: &[Vector],
    displacements: &[Vector],
) -> Vec<Matrix3<f64>> {
    let grains = positions.len().min(displacements.len());
    let mut sums = vec![(Matrix3::zeros(), 0.0); positions.len()];
    for corners in tetrahedra {
        if corners.iter().any(|&c| c >= grains) {
            continue;
        }
        let edge = |of: &[Vector], k: usize| of[corners[k]] - of[corners[0]];
        let edges = |of| Matrix3::from_columns(&[1, 2, 3].map(|k| edge(of, k)));
        let shape = edges(positions);
        let Some(inverse) = shape.try_inverse() else {
            continue;
        };
        let gradient = edges(displacements) * inverse;
        let volume = shape.determinant().abs() / 6.0;
        for &corner in corners {
            sums[corner].0 += (gradient + gradient.transpose()) * (0.5 * volume);
            sums[corner].1 += volume;
        }
    }
    let mean = |(sum, volume): (Matrix3<f64>, f64)| match volume > 0.0 {
        true => sum / volume,
        false => Matrix3::zeros(),
    };
    sums.into_iter().map(mean).collect()
}
