//! The program in the hands of its users: its commands, runs that go on, studies, grains.

mod cli;
mod drawn_fields;
mod grains;
mod hands;
mod resume;
mod study;
