//! Semi-analytical (USAW) and dummy-particle walls: wall geometry, renormalisation factor, wall state.
//!
//! The geometric half, usable without any solver:
//!
//! | | in two dimensions | in three |
//! |---|---|---|
//! | how a wall is drawn | [`Polyline`]; [`thin_plate`] outlines a plate | [`Surface`]: points and triangles |
//! | cut at the particle spacing, checked, joined, [moved](Pose), with an inside | [`Mesh<2>`] | [`Mesh<3>`] |
//! | finds elements near a point | [`ElementTree<2>`] | [`ElementTree<3>`] |
//! | γ and ∇γ in closed form for any piecewise polynomial kernel | [`Renormalisation2d`] | [`Renormalisation3d`] |
//!
//! [`Walls`] are a mesh and its tree, [`WallMesh`] is what they answer in either dimension; wall plugins are written once
//! over it. [`Wall`] is the contract of a plugin, [`Usaw`] and [`DummyParticles`] fulfil it. [`Mover`] is the contract
//! of what moves a wall, whose [`RigidState`] is kept, rolled back and saved; [`RigidMotion`] moves one along
//! [`Course`]s, [`Spring`] holds one against the fluid, and [`bodies`] float and sink. All this is the feature
//! `plugins`, which is on unless it is turned off; without it the table above is left, for programs that want γ of a
//! mesh and nothing else.
//!
#![cfg_attr(feature = "plugins", doc = include_str!("../README.md"))]
// Unit tests name no plugin. Without registration they compile what they call, not all loops of the crate again.
#![cfg_attr(
    test,
    allow(unused_imports, reason = "plugins are not registered in unit tests")
)]
// Code that treatments alone call.
#![cfg_attr(
    not(feature = "plugins"),
    allow(dead_code, unused_imports, reason = "called by treatments")
)]

#[cfg(feature = "plugins")]
pub mod bodies;
mod error;
mod geometry;
mod integrals;
mod parallel;
mod rigid;
#[cfg(feature = "plugins")]
mod scale;
#[cfg(feature = "plugins")]
mod treatment;

pub use error::BoundaryError;
pub(crate) use error::Result;
pub use geometry::mesh::{
    Closest, Element, ElementTree, Face, FaceEdge, Feature, FreeEdge, Mesh, NearElement, NearRows,
    Node, Opening, SeenElement,
};
pub use geometry::periodic::PeriodicBox;
pub use geometry::plate::thin_plate;
pub use geometry::polyline::{FreeEnd, Polyline, WallEnd};
pub use geometry::shells::{Gammas, Shells};
pub use geometry::surface::{Drawing, Surface};
pub use integrals::GammaSum;
pub use integrals::gamma::{Contact, Renormalisation2d, SegmentBatch, SegmentIntegral};
pub use integrals::spatial::{FacetIntegral, Renormalisation3d, Weights};
pub use rigid::motion::{Bend, RigidMotion};
pub use rigid::pose::Pose;
pub use sph_core::course::{Course, Rotation, SinePart, Stage, Translation};

#[cfg(feature = "plugins")]
pub use crate::{
    geometry::walls::{Hindrance, PlanarWalls, SpatialWalls, View, WallMesh, Walls},
    rigid::mover::{Load, Mover, MoverEntry, MoverRefusal, MoverSetting, Spring, Touch},
    rigid::rigid_state::{Movement, RigidState},
    treatment::contract::{
        ThinWall, Wall, WallEntry, WallMotion, WallSetup, WallShape, WallSpec, WallStates,
    },
    treatment::dummy::DummyParticles,
    treatment::symmetric::Symmetric,
    treatment::usaw::Usaw,
};
