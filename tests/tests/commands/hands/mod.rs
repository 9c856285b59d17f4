//! What people have in their hands: stepping by hand, comparison of runs, fields on request, animations, pages, and the
//! commands around them.

mod animation;
mod colours;
mod commands;
mod compare;
mod derived;
mod draw;
mod kinematic;
mod measure;
mod mistakes;
mod ranks;
mod stepper;
mod view;
