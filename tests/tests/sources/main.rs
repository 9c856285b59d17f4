//! What the sources and the pages keep to: arrows between crates and modules, lengths, links, commands.

mod arrows;
mod docs;
mod long_functions;
mod module_circles;
mod ranks;
mod words;
