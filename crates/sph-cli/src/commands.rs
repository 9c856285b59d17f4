//! The commands.

pub mod check;
pub mod compare;
pub mod draw;
pub mod explain;
pub mod file_list;
pub mod grains;
pub mod manual;
pub mod measure;
pub mod mesh;
pub mod new;
pub mod outcome;
pub mod plugins;
pub mod run;
pub mod scenes;
pub mod study;
pub mod view;
