//! Time integrators and step limits
