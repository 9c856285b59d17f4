//! `sph completions` and `sph man`: made from the definition of the command line.

use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;
use sph_core::{comma_list, suggestion};
use sph_io::write_whole;

use crate::arguments::Arguments;
use crate::terminal::{Trouble, console};

pub fn completions(shell: Shell) -> Result<(), Trouble> {
    let mut script = Vec::new();
    let mut command = Arguments::command();
    clap_complete::generate(shell, &mut command, "sph", &mut script);
    console::raw(&script);
    Ok(())
}

pub fn man(of: Option<&str>, out: Option<&Path>) -> Result<(), Trouble> {
    let pages = pages();
    let Some(folder) = out else {
        let name = match of {
            Some(of) => format!("sph-{of}"),
            None => "sph".to_string(),
        };
        let unknown = || {
            let known = || pages.iter().filter_map(|(n, _)| n.strip_prefix("sph-"));
            let near = suggestion(name.trim_start_matches("sph-"), known());
            let known = comma_list(known());
            format!("there is no such command{near} (there are: {known})")
        };
        let page = pages.iter().find(|(n, _)| *n == name);
        console::raw(&page.ok_or_else(unknown)?.1);
        return Ok(());
    };
    sph_io::writable(folder)?;
    for (name, page) in &pages {
        write_whole(folder.join(format!("{name}.1")), page)?;
    }
    console::out(&format!("{} pages in {}", pages.len(), folder.display()));
    Ok(())
}

/// Name and text of the page of `sph` and of every command.
fn pages() -> Vec<(String, Vec<u8>)> {
    let mut whole = Arguments::command().disable_help_subcommand(true);
    whole.build();
    let mut pages = vec![("sph".to_string(), page(whole.clone()))];
    for command in whole.get_subcommands() {
        pages.push((format!("sph-{}", command.get_name()), page(command.clone())));
    }
    pages
}

fn page(command: clap::Command) -> Vec<u8> {
    let mut page = Vec::new();
    // A vector takes all.
    let _ = Man::new(command).render(&mut page);
    page
}
