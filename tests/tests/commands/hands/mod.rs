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

use sph_io::{FieldValues, Piece};

/// A field of reals of a frame.
fn reals(piece: &Piece<'_>, name: &str) -> Vec<f64> {
    let field = piece.fields.iter().find(|f| f.name == name);
    let FieldValues::F64(values) = &field.expect("the field").data else {
        panic!("{name} is not real");
    };
    values.to_vec()
}
