//! Scenes and drawings as they are read, and the messages of those that are refused.

mod common;
mod drawings;
mod filling;
mod kinds;
mod motion;
mod overrides;
mod renamed;
mod robust;
mod scenes;
mod stl;
