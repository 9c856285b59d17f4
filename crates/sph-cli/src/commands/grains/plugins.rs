//! The kinds of plugins that scenes of grains know.

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
    .of(laws)
}
inventory::submit! {
    PluginKind::new(
        "conductance",
        Place::Elsewhere,
        "what a throat between two pores lets through, in [fluid.conductance.LAW]",
    )
    .of(throats)
}

fn laws() -> Vec<PluginInfo> {
    let info = |e: &&dem_pfv::grains::LawEntry| PluginInfo {
        name: e.name,
        summary: e.summary,
        source: e.source,
        provider: e.provider,
        dimensions: DIMENSIONS,
        schema: e.schema,
    };
    contact_laws().iter().map(info).collect()
}

fn throats() -> Vec<PluginInfo> {
    let info = |e: &&dem_pfv::flow::ConductanceEntry| PluginInfo {
        name: e.name,
        summary: e.summary,
        source: e.source,
        provider: e.provider,
        dimensions: DIMENSIONS,
        schema: e.schema,
    };
    conductances().iter().map(info).collect()
}
