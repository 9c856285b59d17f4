//! Sizes that a file declares are refused before there is memory for them: the program may have
//! 3 GB here, which a refusal is far from.

use std::fs::File;
use std::time::{Duration, Instant};

use sph_tests::{Bench, DAM_BREAK, bench, exchanged};

use crate::bad_files::limited;

/// Memory that may be asked for, KiB, and the time that may pass.
const MEMORY: u32 = 3_000_000;
const TIME: Duration = Duration::from_secs(10);

const PLACE: &str = "[walls.usaw]\n";
const SPACE: &str = "title = \"t\"\ndimension = 3\nrun.end = 1\nnumerics.spacing = 0.01\n[walls.usaw]\n\
                     [phase.water]\ndensity = 1000\nspeed_of_sound = 10\nrheology.newtonian = { viscosity = 1 }\n\
                     [body.water]\nphase = \"water\"\nbox = [[0, 0, 0], [1, 1, 1]]\n";

/// `check` refuses the scene with code 2 and all the words, in time and memory.
fn refused(bench: &Bench, scene: &str, words: &str) {
    bench.write("scene.toml", scene);
    called(bench, "check scene.toml", words);
}

fn called(bench: &Bench, call: &str, words: &str) {
    let start = Instant::now();
    let refused = limited(bench, call, MEMORY).ended(2);
    let took = start.elapsed();
    println!("{took:?}: {}", refused.err.lines().next().unwrap_or(""));
    refused.says(words);
    assert!(took < TIME, "it took {took:?}");
}

#[test]
fn of_scenes() {
    let bench = bench!();
    let set = |from: &str, to: &str| exchanged(DAM_BREAK, from, to);
    let spacing = |x: &str| set("spacing = 0.02", &format!("spacing = {x}"));
    refused(&bench, &spacing("3e-7"), "particles | GB | larger spacing");
    refused(&bench, &spacing("1e-300"), "numerics.spacing");
    let every = |key: &str| set("every = 0.05", &format!("{key} = 1e-13"));
    refused(&bench, &every("every"), "output.every | 1000000 times");
    refused(
        &bench,
        &every("series_every"),
        "output.series_every | times",
    );
    let often = set("checkpoint_every = 0.02", "checkpoint_every = 1e-12");
    refused(&bench, &often, "run.checkpoint_every | times");
    let many = |n: usize, one: &dyn Fn(usize) -> String| (0..n).map(one).collect::<String>();
    let times = many(1_000_001, &|k| format!("{k},"));
    // 4 MiB are full before there are as many times as are too many.
    refused(
        &bench,
        &set("every = 0.05", &format!("times = [{times}]")),
        "longer than 4 MiB",
    );
    let gauges = many(1_001, &|k| {
        format!("[gauge.g{k}]\nkind = \"level\"\nat = [0.1]\n")
    });
    refused(
        &bench,
        &(DAM_BREAK.to_string() + &gauges),
        "1001 tables are more than 1000",
    );
    let pictures = many(5_000, &|_| "\"pressure\",".to_string());
    let pictured = set("[output]\n", &format!("[output]\npicture = [{pictures}]\n"));
    refused(
        &bench,
        &pictured,
        "output.picture | 5000 entries are more than 1000",
    );
    let sides = set(
        PLACE,
        "[walls.usaw]\n[wall.d]\ndisc = { centre = [0.5, 0.5], radius = 0.1, sides = 4000000000 }\n",
    );
    refused(&bench, &sides, "wall.d.disc.sides | 100000");
}

#[test]
fn of_scenes_in_space() {
    let bench = bench!();
    // Each ball has 5 million facets, which is allowed; all have five billion.
    let balls: String = (0..1000)
        .map(|k| format!("[wall.b{k}]\nsphere = {{ centre = [{k}, 0, 0], radius = 0.3, subdivisions = 500 }}\n"))
        .collect();
    refused(
        &bench,
        &(SPACE.to_string() + &balls),
        "corners or facets, more than 10000000",
    );
    // A million particles, each with seven million neighbours.
    let wide = SPACE.replace(
        "numerics.spacing = 0.01",
        "numerics = { spacing = 0.01, smoothing_ratio = 20, skin = 2 }",
    );
    refused(&bench, &wide, "particles | smaller `smoothing_ratio`");
}

#[test]
fn of_files_that_scenes_name() {
    let bench = bench!();
    let stl = format!("{SPACE}[wall.w]\nfile = \"w.stl\"\n");
    let mut few = vec![0; 84 + 2 * 50];
    for (count, words) in [
        (
            u32::MAX,
            "declares 4294967295 facets, more than 5000000; it has room for 2",
        ),
        (4_000_000, "declares 4000000 facets and ends after 2"),
    ] {
        few[80..84].copy_from_slice(&count.to_le_bytes());
        bench.write("w.stl", &few);
        refused(&bench, &stl, &format!("wall.w.file | {words}"));
    }
    let polyline = "polyline = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6]]\nclosed = true\n";
    let drawn = exchanged(DAM_BREAK, polyline, "file = \"w.csv\"\n");
    let referred = format!("{DAM_BREAK}[reference.r]\nprobe = \"front\"\nfile = \"w.csv\"\n");
    // Holes of eight gigabytes that take no room on the disk.
    let hole = |name: &str| {
        let made = File::create(bench.path(name)).and_then(|f| f.set_len(8 << 30));
        made.expect("a sparse file");
    };
    hole("w.stl");
    refused(&bench, &stl, "longer than 512 MiB");
    hole("w.csv");
    refused(&bench, &drawn, "wall.tank.file | longer than 64 MiB");
    refused(&bench, &referred, "reference.r.file | longer than 64 MiB");
    // A hundred thousand lines of which each may lie within each.
    let squares: String = (0..100_000)
        .map(|k| format!("{k},0\n{k}.5,0\n{k}.5,0.5\n{k},0\n\n"))
        .collect();
    bench.write("w.csv", &squares);
    refused(&bench, &drawn, "100000 lines | at most 20000");
    let rows: String = (0..1_000_001).map(|k| format!("{k},0\n")).collect();
    bench.write("w.csv", &rows);
    let moved = DAM_BREAK.replace(
        "condition = \"free-slip\"",
        "condition = \"free-slip\"\nmotion.translate = { along = [1, 0], file = \"w.csv\" }",
    );
    refused(
        &bench,
        &moved,
        "wall.tank.motion | 1000001 rows, more than 1000000",
    );
}

#[test]
fn of_studies() {
    let bench = bench!(DAM_BREAK);
    let values: String = (1..=101).map(|k| format!("{k},")).collect();
    let axis = |key: &str| format!("[[vary]]\nkey = \"{key}\"\nvalues = [{values}]\n");
    let study = format!(
        "title = \"t\"\nscene = \"scene.toml\"\nerror = \"front\"\n{}{}",
        axis("phase.water.density"),
        axis("run.end")
    );
    bench.write("s.toml", &study);
    called(&bench, "study s.toml", "more than 10000 variants");
}
