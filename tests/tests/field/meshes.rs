//! Walls from CAD files and what fills them.
