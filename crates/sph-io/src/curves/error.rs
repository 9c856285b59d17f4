//! Errors of curves and pictures.

use std::path::PathBuf;

use crate::IoError;

/// Errors of drawings.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// A file cannot be read or written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A folder without frames.
    #[error("{} holds no frames of particles", .0.display())]
    NoFrames(PathBuf),
    /// A field that the frames do not have.
    #[error(
        "no field `{name}` was written (there are: {known}); name it in output.fields and run again"
    )]
    NoField {
        /// The request.
        name: String,
        /// The known names.
        known: String,
    },
    /// A component that the field does not have.
    #[error("`{name}` has {components} components, and no `{component}`")]
    NoComponent {
        /// The field.
        name: String,
        /// Its number of components.
        components: usize,
        /// The request.
        component: String,
    },
    /// A particle that no frame has.
    #[error("no frame has a particle of identity {0}")]
    NoParticle(u32),
    /// Something that cannot be drawn.
    #[error("{0}")]
    Unfit(String),
}
