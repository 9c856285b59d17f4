//! Assembles plugins into a plan and runs it
