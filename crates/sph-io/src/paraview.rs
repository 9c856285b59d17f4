//! Files for ParaView.

pub mod frame;
pub mod pvd;
pub mod pvtu;
pub mod vtu;
pub mod vtu_read;
