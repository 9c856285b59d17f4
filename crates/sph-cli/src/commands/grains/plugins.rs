//! The kinds of plugins of scenes of grains.

use dem_pfv::Entry;
use dem_pfv::flow::conductances;
use dem_pfv::grains::contact_laws;
use sph_core::{Place, PluginInfo, PluginKind, reexport::inventory};

/// Grains are spheres in space.
const DIMENSIONS: &[usize] = &[3];

inventory::submit! {
    PluginKind::new(
        "contact-law",
        Place::Elsewhere,
        "forces of grains that touch, in [grains.contact.LAW], [box.contact.LAW], [wall.NAME.contact.LAW]",
    )
    .with_plugins(laws)
}
inventory::submit! {
    PluginKind::new(
        "conductance",
        Place::Elsewhere,
        "the conductance of a throat between two pores, in [fluid.conductance.LAW]",
    )
    .with_plugins(throats)
}

fn laws() -> Vec<PluginInfo> {
    contact_laws().into_iter().map(info).collect()
}

fn throats() -> Vec<PluginInfo> {
    conductances().into_iter().map(info).collect()
}

fn info<L: ?Sized>(entry: &Entry<L>) -> PluginInfo {
    PluginInfo {
        name: entry.name,
        summary: entry.summary,
        source: entry.source,
        provider: entry.provider,
        dimensions: DIMENSIONS,
        schema: entry.schema,
    }
}
