//! The sph command: run, check, explain, plugins, schema, scenes, new
