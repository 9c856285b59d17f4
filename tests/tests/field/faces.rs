//! Open faces and outlets.
