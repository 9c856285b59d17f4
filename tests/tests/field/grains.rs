//! Scenes of grains.
