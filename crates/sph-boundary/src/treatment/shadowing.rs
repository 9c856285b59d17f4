//! Pairs of particles that walls with free ends hide from each other.

use sph_core::Vect;
use sph_neighbours::{Hidden, HiddenPairs, World};

use crate::geometry::walls::wall_mesh::WallMesh;
use crate::treatment::near::NearLists;

impl<const D: usize> NearLists<D> {
    /// Pairs with a shell between them, where particles are `at`: those that are `behind` it and all that the way to them leads
    /// through it, its elements and its points.
    pub fn hidden<M: WallMesh<D>>(
        &self,
        mesh: &M,
        world: &World<D>,
        behind: &[(u32, u32)],
        at: impl Fn(usize) -> Vect<D>,
    ) -> Hidden {
        let support2 = world.kernel.support_radius().powi(2);
        let [mut particles, mut points, mut at_points, mut at_elements] = [const { Vec::new() }; 4];
        for &(place, shell) in behind {
            let particle = self.particles[place as usize];
            let x = &at(particle as usize);
            let row = self.row(place as usize).iter();
            let own = row.filter(|near| mesh.shells().shell_of(near.index()) == shell);
            for other in self.around(world, particle) {
                let way: Vect<D> = world.domain.nearest_image(at(other as usize) - x);
                let near = other != particle && way.norm_squared() < support2;
                if near && own.clone().any(|near| mesh.is_crossed(*near, x, &way)) {
                    particles.extend([[particle, other], [other, particle]]);
                }
            }
            for near in own {
                let element = near.index();
                at_elements.push([element as u32, particle]);
                let in_density = world.walls.points.in_density();
                if in_density || world.walls.at_corners {
                    for corner in world.walls.elements.corners[element] {
                        at_points.push([corner, particle]);
                        if in_density {
                            points.push([particle, corner]);
                        }
                    }
                }
            }
        }
        Hidden {
            particles: HiddenPairs::from_pairs(particles),
            points: HiddenPairs::from_pairs(points),
            at_points: HiddenPairs::from_pairs(at_points),
            at_elements: HiddenPairs::from_pairs(at_elements),
        }
    }

    /// Neighbours that a particle may have within its support; all where no sum of it is needed.
    fn around<'a>(&self, world: &'a World<D>, particle: u32) -> impl Iterator<Item = u32> + 'a {
        let listed = world.lists.free.candidates(particle as usize);
        let all = match listed.is_empty() {
            true => 0..world.free.len() as u32,
            false => 0..0,
        };
        listed.iter().copied().chain(all)
    }

    /// The shells that the particle at a place of `particles` is behind.
    pub fn behind(&self, place: usize) -> &[(u32, u32)] {
        let from = self.behind.partition_point(|(p, _)| (*p as usize) < place);
        let row = &self.behind[from..];
        &row[..row.partition_point(|(p, _)| *p as usize == place)]
    }
}
