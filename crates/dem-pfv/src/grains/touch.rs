//! From positions to contact forces.

use rayon::prelude::*;

use crate::grains::{Contact, ContactLaw, Mesh, Slot, State, Vector, Wall, nearest, separation};

/// Slots that one call of a law answers at most.
const BATCH: usize = 128;

/// Radius and mass of a plane and of a triangle.
const OF_SURFACES: [f64; 2] = [f64::INFINITY; 2];

impl State {
    /// Forces between grains.
    pub(crate) fn at_grains(&self, slots: &mut [Slot], law: &dyn ContactLaw) {
        sweep(slots, law, |slot| self.pair(slot));
    }

    /// Forces at a wall.
    pub(crate) fn at_wall(&self, slots: &mut [Slot], wall: &Wall, law: &dyn ContactLaw) {
        sweep(slots, law, |slot| {
            let grain = slot.first as usize;
            let gap = wall.distance(&self.grains.position[grain]) - self.grains.radius[grain];
            let motion = [wall.velocity, Vector::zeros()];
            (gap < 0.0).then(|| self.contact(slot, wall.normal, -gap, motion, OF_SURFACES))
        });
    }

    /// Forces at a mesh.
    pub(crate) fn at_mesh(&self, slots: &mut [Slot], mesh: &Mesh, law: &dyn ContactLaw) {
        let groups = slots.par_chunk_by_mut(|a, b| a.first == b.first);
        groups.for_each(|group| self.at_triangles(group, mesh, law));
    }

    fn pair(&self, slot: &Slot) -> Option<Contact> {
        let (a, b) = (slot.first as usize, slot.second as usize);
        let g = &self.grains;
        let apart = separation(&g.position[a], &g.position[b], &self.period);
        let reach = g.radius[a] + g.radius[b];
        let square = apart.norm_squared();
        if square >= reach * reach {
            return None;
        }
        let distance = square.sqrt();
        // Equal centres have no direction; any one does.
        let normal = match distance > 0.0 {
            true => apart / distance,
            false => Vector::x(),
        };
        let (motion, size) = ([g.velocity[b], g.spin[b]], [g.radius[b], g.mass[b]]);
        Some(self.contact(slot, normal, reach - distance, motion, size))
    }

    /// A contact with a second body by its velocity, angular velocity, radius and mass.
    fn contact(
        &self,
        slot: &Slot,
        normal: Vector,
        overlap: f64,
        [velocity, spin]: [Vector; 2],
        [radius, mass]: [f64; 2],
    ) -> Contact {
        let (g, a) = (&self.grains, slot.first as usize);
        let radius = [g.radius[a], radius];
        let lever = radius.map(|r| r - 0.5 * overlap);
        let mut rolling = g.spin[a] * lever[0];
        if lever[1].is_finite() {
            rolling += spin * lever[1];
        }
        let (memory, turn) = match slot.active {
            true => {
                let twist = 0.5 * self.last_step * normal.dot(&(g.spin[a] + spin));
                let (axis, cosine) = (slot.normal.cross(&normal), slot.normal.dot(&normal));
                (slot.memory, (axis, cosine, twist))
            }
            false => Default::default(),
        };
        Contact {
            normal,
            overlap,
            velocity: g.velocity[a] - velocity - rolling.cross(&normal),
            spin: g.spin[a] - spin,
            radius,
            mass: [g.mass[a], mass],
            step: self.last_step,
            memory,
            force: Vector::zeros(),
            couple: Vector::zeros(),
            turn,
        }
    }

    /// Triangles that share an edge or a corner would count one contact several times: only local minima of
    /// the distance count, and the lowest number among equals.
    fn at_triangles(&self, group: &mut [Slot], mesh: &Mesh, law: &dyn ContactLaw) {
        let grain = group[0].first as usize;
        let (at, radius) = (&self.grains.position[grain], self.grains.radius[grain]);
        let near = group.iter().enumerate().filter_map(|(k, slot)| {
            let point = nearest(at, mesh.corners(slot.second as usize));
            let distance = (at - point).norm();
            (distance < radius).then_some((k, point, distance))
        });
        let near: Vec<(usize, Vector, f64)> = near.collect();
        let same = 1e-7 * radius;
        let counts = |&(k, point, distance): &(usize, Vector, f64)| {
            !near.iter().any(|&(other, _, nearer)| {
                // Their order is total, so that the first of a chain always stays.
                let before = nearer < distance || (nearer == distance && other < k);
                let corners = mesh.corners(group[other].second as usize);
                before && (nearest(&point, corners) - point).norm() <= same
            })
        };
        let kept: Vec<_> = near.iter().copied().filter(counts).collect();
        hand_over(group, &kept, at);
        let batch = kept.iter().map(|&(k, point, distance)| {
            let normal = match distance > 0.0 {
                true => (at - point) / distance,
                false => {
                    let [a, b, c] = mesh.corners(group[k].second as usize);
                    (b - a).cross(&(c - a)).normalize()
                }
            };
            let motion = [mesh.velocity_at(&point), mesh.spin];
            self.contact(&group[k], normal, radius - distance, motion, OF_SURFACES)
        });
        let mut batch: Vec<Contact> = batch.collect();
        for slot in group.iter_mut() {
            slot.active = false;
        }
        law.respond(&mut batch);
        for ((k, ..), contact) in kept.iter().zip(&batch) {
            write_back(&mut group[*k], contact);
        }
    }
}

/// The memory of a contact goes along with a grain that rolls or slides from one triangle to the next.
fn hand_over(group: &mut [Slot], kept: &[(usize, Vector, f64)], at: &Vector) {
    for &(k, point, _) in kept {
        if group[k].active {
            continue;
        }
        let normal = at - point;
        let left = |&j: &usize| group[j].active && !kept.iter().any(|&(other, ..)| other == j);
        let along = |j: usize| group[j].normal.dot(&normal);
        let from = (0..group.len()).filter(left);
        let from = from.max_by(|&i, &j| along(i).total_cmp(&along(j)));
        if let Some(from) = from.filter(|&j| along(j) > 0.5 * normal.norm()) {
            group[k] = Slot {
                first: group[k].first,
                second: group[k].second,
                ..group[from]
            };
            group[from].active = false;
        }
    }
}

fn sweep(
    slots: &mut [Slot],
    law: &dyn ContactLaw,
    touch: impl Fn(&Slot) -> Option<Contact> + Sync,
) {
    let room = || (Vec::with_capacity(BATCH), Vec::with_capacity(BATCH));
    let tasks = slots.par_chunks_mut(BATCH).with_min_len(4);
    tasks.for_each_init(room, |(batch, places), chunk| {
        batch.clear();
        places.clear();
        for (k, slot) in chunk.iter_mut().enumerate() {
            if let Some(contact) = touch(slot) {
                batch.push(contact);
                places.push(k);
            } else {
                slot.active = false;
            }
        }
        law.respond(batch);
        for (contact, &k) in batch.iter().zip(places.iter()) {
            write_back(&mut chunk[k], contact);
        }
    });
}

/// Writes an answered contact back, with M = (x_C − x) × F for both bodies.
fn write_back(slot: &mut Slot, contact: &Contact) {
    let turning = contact.normal.cross(&contact.force);
    let lever = contact.radius.map(|r| r - 0.5 * contact.overlap);
    slot.active = true;
    slot.overlap = contact.overlap;
    slot.normal = contact.normal;
    slot.memory = contact.memory;
    slot.force = contact.force;
    let second = match lever[1].is_finite() {
        true => -turning * lever[1] - contact.couple,
        false => -contact.couple,
    };
    slot.torque = [contact.couple - turning * lever[0], second];
}
