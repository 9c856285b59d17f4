//! Scene files: parsing, units, shapes, filling, JSON schema
