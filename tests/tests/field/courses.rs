//! Courses and tables that are read from files.
