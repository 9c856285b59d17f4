//! Shape and motion of the walls of a treatment, by their outline.

/// Shape and motion of walls by their outline; the treatment keeps it in `self.set_up`, whose `moved` places the points
/// and elements of the walls.
macro_rules! shaped_by_outline {
    ($treatment:ident) => {
        impl<const D: usize, M: WallMesh<D>> $treatment<D, M> {
            fn outline(&self) -> Option<&crate::treatment::outline::Outline<D, M>> {
                self.set_up.as_ref().map(|s| &s.outline)
            }

            /// Lets the outline move, and places points and elements where it is then.
            fn moved(
                &mut self,
                walls: &mut WallSet<D>,
                way: impl FnOnce(&mut crate::treatment::outline::Outline<D, M>) -> Result<bool>,
            ) -> Result<()> {
                if let Some(set_up) = self.set_up.as_mut().filter(|s| s.outline.moves()) {
                    let moved = way(&mut set_up.outline)?;
                    set_up.outline.moved += u64::from(moved);
                    set_up.place(walls);
                }
                Ok(())
            }
        }

        impl<const D: usize, M: WallMesh<D>> crate::WallShape<D> for $treatment<D, M> {
            fn contains(&self, point: &Vect<D>) -> bool {
                self.outline().is_none_or(|o| o.mesh.contains(point))
            }

            fn enclosed(&self, point: &Vect<D>) -> Option<f64> {
                self.outline()?.mesh.enclosed(point)
            }

            fn clearance(&self, point: &Vect<D>, within: f64) -> Option<(f64, &str)> {
                self.outline()?.clearance(point, within)
            }

            fn ends_freely(&self) -> bool {
                self.outline().is_some_and(|o| o.mesh.shells().any())
            }

            fn check_free_ends(&self, points: &[Vect<D>]) -> Result<()> {
                self.outline()
                    .map_or(Ok(()), |o| o.mesh.check_free_ends(points, o.support))
            }

            fn thin_walls(&self, points: &[Vect<D>]) -> Vec<crate::ThinWall<D>> {
                self.outline().map_or(Vec::new(), |o| o.thin_walls(points))
            }

            fn warnings(&self) -> Vec<String> {
                let outline = self.outline();
                outline.map_or(Vec::new(), |o| o.mesh.walls().mesh.warnings.clone())
            }
        }

        impl<const D: usize, M: WallMesh<D>> crate::WallMotion<D> for $treatment<D, M> {
            fn advance(
                &mut self,
                walls: &mut WallSet<D>,
                gravity: Vect<D>,
                time: f64,
                dt: f64,
            ) -> Result<()> {
                let forces = std::mem::take(&mut walls.forces);
                let bodies = std::mem::take(&mut walls.bodies);
                let beds = std::mem::take(&mut walls.beds);
                let moved = self.moved(walls, |outline| {
                    outline.grow(beds, dt)?;
                    outline.advance(&forces, &bodies, gravity, [time, dt])
                });
                walls.forces = forces;
                moved
            }

            fn needs_forces(&self, wall: usize) -> bool {
                self.outline().is_some_and(|o| o.needs_forces(wall))
            }

            fn depth_gauges(&self) -> Vec<(usize, sph_neighbours::DepthGauge<D>)> {
                self.outline().map_or(Vec::new(), |o| o.depth_gauges())
            }

            fn states(&self) -> WallStates {
                self.outline().map(|o| o.numbers()).unwrap_or_default()
            }

            fn put_back(
                &mut self,
                walls: &mut WallSet<D>,
                states: &WallStates,
                time: f64,
            ) -> Result<()> {
                self.moved(walls, |outline| outline.put_back(states, time))
            }
        }
    };
}
pub(crate) use shaped_by_outline;
