//! Files for ParaView.

pub(crate) mod beside;
pub mod frame;
pub mod pvd;
pub mod pvtu;
pub mod vtu;
pub mod vtu_read;
pub mod xml;
