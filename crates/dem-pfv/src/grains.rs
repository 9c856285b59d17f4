//! Discrete elements: spheres that touch each other, walls and meshes, moved by their contact forces.
//!
//! m dv/dt = ΣF, J dω/dt = ΣM with forces from small overlaps, integrated by a leap-frog (Catalano 2012, ch. 2).
//! Dry, or with any force from outside; there is no fluid here.
//!
//! * [`Setup`] of [`Grain`]s, [`Wall`]s and [`Mesh`]es; [`GrainSystem`] steps it, [`Grains`] are its columns.
//! * [`ContactLaw`]: [`LinearElastic`], [`HertzMindlin`], both with [`RollingResistance`], or a plugin of your own:
//!   [`ContactLawEntry`], [`contact_law`].
//! * [`Control`]: walls at a velocity, a stress or a rate of strain, and free pistons.
//! * [`Cloud`], [`rain`], [`Grown`], [`step_to_rest`]: samples.
//! * [`GrainSystem::stress`], [`GrainSystem::grain_stresses`], [`strains`], [`GrainSystem::unbalanced_force`]:
//!   measures.
//! * [`State`]: saved, and resumed to the same bits. [`GrainError`]: refusals, by the grain's number.
//!
//! ```
//! use dem_pfv::grains::{Grain, GrainSystem, LinearElastic, Setup, Wall};
//!
//! // A ball of 1 kg and k = 10⁵ N/m lies on the floor, after a while of damping.
//! let density = 0.75 / (std::f64::consts::PI * 0.1_f64.powi(3));
//! let ball = Grain::new([0.0, 0.0, 0.1], 0.1, density);
//! let law = LinearElastic::new(1e6, 0.5, 0.3);
//! let floor = Wall::new([0.0; 3], [0.0, 0.0, 1.0]);
//! let setup = Setup::new(vec![ball], law).walls([floor]).gravity([0.0, 0.0, -9.81]).damping(0.3);
//! let mut system = GrainSystem::new(setup)?;
//! let step = 0.5 * system.critical_step();
//! for _ in 0..2000 {
//!     system.step(step)?;
//! }
//! let overlap = 0.1 - system.grains.position[0].z;
//! assert!((overlap - 9.81 / 1e5).abs() < 1e-12); // m g / k
//! # Ok::<(), dem_pfv::grains::GrainError>(())
//! ```

mod law;
mod measure;
mod motion;
mod samples;
mod setup;
mod springs;
mod stability;
mod system;
mod table;
mod touch;
mod wall;
pub use crate::Vector;
pub use crate::error::{GrainError, Partner, Unrest};
pub(crate) use law::reduced;
pub use law::{Contact, ContactLaw, ContactLawEntry, MEMORY, Stiffness, contact_law};
pub use measure::{Touch, strains};
pub use samples::{Cloud, Grown, rain, step_to_rest, uniform_radii};
pub(crate) use setup::INERTIA;
pub use setup::{Grain, Grains, Period, Setup};
pub(crate) use setup::{check_period, finite, positive, separation, wrap};
pub use springs::{HertzMindlin, LinearElastic, RollingResistance};
pub use system::GrainSystem;
pub use table::State;
pub(crate) use table::{Limit, Slot};
pub use wall::{Control, Mesh, Wall};
pub(crate) use wall::{nearest, sign};
