//! A step asks for no memory: what it needs has been asked for by the steps before.
//!
//! `DHAT_OUT=FILE cargo test -p sph-tests --test allocations` leaves a profile of the last scene for dhat's viewer.

use std::path::Path;

use dhat::{HeapStats, Profiler};
use sph_scene::{Override, load};
use sph_solver::{Command, Identity, Observer, Progress, RunOptions, Start, run};

#[global_allocator]
static HEAP: dhat::Alloc = dhat::Alloc;

/// Steps after which all buffers have grown.
const WARM: u64 = 30;
/// Steps that are counted.
const COUNTED: u64 = 40;

/// What the steps of a run asked for, blocks and bytes of each.
#[derive(Default)]
struct Watch {
    profiler: Option<Profiler>,
    last: [u64; 2],
    steps: Vec<[u64; 2]>,
    particles: usize,
}

fn asked() -> [u64; 2] {
    let stats = HeapStats::get();
    [stats.total_blocks, stats.total_bytes]
}

impl Observer for Watch {
    fn step(&mut self, progress: &Progress) -> Command {
        self.particles = progress.particles;
        match &self.profiler {
            None if progress.step < WARM => return Command::Continue,
            None => {
                let profiler = Profiler::builder().trim_backtraces(Some(24));
                let profiler = match std::env::var_os("DHAT_OUT") {
                    Some(file) => profiler.file_name(file),
                    None => profiler.testing(),
                };
                self.steps.reserve(2 * COUNTED as usize);
                self.profiler = Some(profiler.build());
            }
            Some(_) => {
                let now = asked();
                self.steps.push([0, 1].map(|k| now[k] - self.last[k]));
            }
        }
        self.last = asked();
        Command::Continue
    }
    fn message(&mut self, _: &str) {}
}

/// Blocks and bytes that steps ask for: those of the median step and of the worst one.
fn steps(name: &str, overrides: &[&str]) -> (usize, [u64; 2], [u64; 2]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
    let most = format!("run.max_steps={}", WARM + COUNTED);
    let always = ["output.every=1000", "output.series_every=1000", &most];
    let overrides = overrides.iter().chain(&always);
    let overrides = overrides.map(|text| Override::parse(text).expect("an override"));
    let overrides: Vec<_> = overrides.collect();
    let loaded = load(&path, &overrides).unwrap_or_else(|e| panic!("{e}"));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = RunOptions {
        out: folder.path().to_path_buf(),
        start: Start::Afresh,
        threads: Some(1),
        identity: Identity::of_text(name),
    };
    let mut watch = Watch::default();
    run(&loaded.scene, &options, &mut watch).unwrap_or_else(|e| panic!("{name}: {e}"));
    drop(watch.profiler.take());
    watch.steps.sort_by_key(|[_, bytes]| *bytes);
    let all = &watch.steps;
    (watch.particles, all[all.len() / 2], all[all.len() - 1])
}

#[test]
fn steps_ask_for_no_memory_that_goes_with_the_particles() {
    let scenes: [(&str, &[&str]); 7] = [
        ("dam-break-koshizuka", &["numerics.spacing=0.004"]),
        ("dam-break-spheric2", &["numerics.spacing=0.06"]),
        (
            "air-water-dambreak-lobovsky",
            &[
                "numerics.spacing=0.01",
                "body.water.box=[[0.0,0.0],[0.605,0.305]]",
                "body.air.subtract=[{box=[[0.0,0.0],[0.605,0.305]]}]",
            ],
        ),
        ("bingham-dam-break", &["numerics.spacing=0.01"]),
        ("granular-pile-lajeunesse", &["numerics.spacing=0.003"]),
        ("soil-collapse-bui", &["numerics.spacing=0.003"]),
        ("turb-channel-k-epsilon", &["numerics.spacing=0.01"]),
    ];
    let only = std::env::var("DHAT_SCENE").ok();
    for (name, overrides) in scenes {
        if only.as_deref().is_some_and(|only| only != name) {
            continue;
        }
        let (particles, median, worst) = steps(name, overrides);
        println!("{name}: {particles} particles, median {median:?}, worst {worst:?}");
    }
}
