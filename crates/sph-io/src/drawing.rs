//! Pictures and plots: canvas, axes, marks, colours, legends.

pub mod animation;
pub mod axes;
pub mod canvas;
pub mod colour;
pub mod colour_bar;
pub mod draw_target;
pub mod extent;
pub mod mark;
pub mod particles;
pub mod picture;
pub mod plot;
pub mod svg;
pub mod text;
pub mod ticks;
