//! Pictures and plots: canvas, axes, marks, colours, legends.

pub mod animation;
pub mod axes;
pub mod canvas;
pub mod class_bar;
pub mod colour;
pub mod colour_bar;
pub mod colour_ranges;
pub mod draw_target;
pub mod drawn_series;
pub mod extent;
pub mod legend;
pub mod mark;
pub mod panels;
pub mod particles;
pub mod picture;
pub mod plot;
pub mod relief;
pub mod svg;
pub mod text;
pub mod ticks;
