//! What steps ask an allocator for, once all buffers have grown: counted, and bounded by what is known to remain
//! (docs/performance.md, "Allocations of a step").
//!
//! `DHAT_OUT=FILE DHAT_SCENE=NAME cargo test -p sph-tests --test memory steps` leaves a profile for dhat's viewer.

use dhat::{HeapStats, Profiler};
use sph_particles::run;
use sph_run::{Command, Identity, Observer, Progress, RunOptions};
use sph_tests::shipped;
use sph_turbulence as _;

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
    let most = format!("run.max_steps={}", WARM + COUNTED);
    let always = ["output.every=1000", "output.series_every=1000", &most];
    let scene = shipped(name, &[overrides, &always].concat());
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = RunOptions::new(folder.path(), Identity::of_text(name)).threads(1);
    let mut watch = Watch::default();
    run(&scene, &options, &mut watch).unwrap_or_else(|e| panic!("{name}: {e}"));
    drop(watch.profiler.take());
    watch.steps.sort_by_key(|[_, bytes]| *bytes);
    let all = &watch.steps;
    (watch.particles, all[all.len() / 2], all[all.len() - 1])
}

/// Scenes with the most blocks that their median step may ask for, debug assertions included.
///
/// None, but where `automatic` solves in two stages: where the first one gives up, its error is two blocks. A step may solve
/// for as often as the scheme lets the viscosity follow the velocity.
type Bounds = (&'static str, &'static [&'static str], u64);

/// Blocks of an error that says how far an iteration came.
const GIVEN_UP: u64 = 2;
/// Solves of a step at most: the outer iterations of a scheme, unless a scene says otherwise.
const SOLVES: u64 = 30;

const SCENES: [Bounds; 7] = [
    ("dam-break-koshizuka", &["numerics.spacing=0.004"], 0),
    ("dam-break-spheric2", &["numerics.spacing=0.06"], 0),
    (
        "air-water-dambreak-lobovsky",
        &[
            "numerics.spacing=0.01 body.water.box=[[0.0,0.0],[0.605,0.305]] \
             body.air.subtract=[{box=[[0.0,0.0],[0.605,0.305]]}]",
        ],
        0,
    ),
    ("bingham-dam-break", &["numerics.spacing=0.01"], 0),
    (
        "granular-pile-lajeunesse",
        &["numerics.spacing=0.003"],
        GIVEN_UP * SOLVES,
    ),
    ("soil-collapse-bui", &["numerics.spacing=0.003"], 0),
    ("turb-channel-k-epsilon", &["numerics.spacing=0.01"], 0),
];

#[test]
fn steps_ask_for_no_more_memory_than_is_known_to_remain() {
    let _alone = super::ALONE.lock();
    let only = std::env::var("DHAT_SCENE").ok();
    let mut wrong = Vec::new();
    for (name, overrides, bounds) in SCENES {
        if only.as_deref().is_some_and(|only| only != name) {
            continue;
        }
        let (particles, median, worst) = steps(name, overrides);
        let line = format!("{name}: {particles} particles, median {median:?}, worst {worst:?}");
        println!("{line}");
        if median[0] > bounds {
            wrong.push(line);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
