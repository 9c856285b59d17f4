//! VTK series, CSV tables, pictures and checkpoints
