//! Runs a scene of grains without the command line: `cargo run --release -p dem-pfv --example run_scene FILE OUT`.

use dem_pfv::scene::{identity, read, run};
use scene_text::{Override, Source};
use sph_run::{Command, Observer, Progress, RunOptions};

struct Lines;

impl Observer for Lines {
    fn step(&mut self, step: &Progress) -> Command {
        if step.step.is_multiple_of(20_000) {
            println!(
                "t = {:.4} s, step {}, Δt {:.1e} s",
                step.time, step.step, step.dt
            );
        }
        Command::Continue
    }
    fn message(&mut self, text: &str) {
        println!("{text}");
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("name a scene and a folder")?;
    let out = arguments.next().ok_or("name a folder")?;
    let set: Result<Vec<_>, _> = arguments.map(|text| Override::parse(&text)).collect();
    let text = scene_text::read_text(file.as_ref())?;
    let loaded = read(Source::new(&text, &file, &set?)).map_err(|(_, mistakes)| {
        let lines: Vec<_> = mistakes.iter().map(ToString::to_string).collect();
        lines.join("\n")
    })?;
    let options = RunOptions::new(out, identity(&loaded)).threads(1);
    let summary = run(&loaded, &options, &mut Lines)?;
    println!("{}", serde_json::to_string_pretty(&summary)?);
    Ok(())
}
