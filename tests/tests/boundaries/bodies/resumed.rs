//! The same bits for any number of threads and after an interruption.

use sph_tests::{Bench, FinalState};

use crate::bodies::{FLOAT, PROGRAM};

#[test]
fn bodies_are_threaded_and_resumed_bit_for_bit() {
    for integrator in ["symplectic-euler", "leap-frog", "verlet"] {
        let bench = Bench::with(PROGRAM, FLOAT);
        let scheme = format!("--set integrator={{\"{integrator}\"={{}}}}");
        // It meets a second box, which is held by a line.
        bench.write(
            "scene.toml",
            &format!(
                "{FLOAT}\n[wall.buoy]\nbox = [[0.54, 0.2], [0.64, 0.3]]\nfluid = \"outside\"\n\
                 [wall.buoy.mover.rigid-body]\nmass = 4.0\nfriction = 0.3\nvelocity = [-1.5, 0.0]\n\
                 [[wall.buoy.mover.rigid-body.line]]\nfrom = [0.7, 0.0]\nto = [0.62, 0.2]\n\
                 stiffness = 2000.0\ndamping = 20.0\n"
            ),
        );
        bench.done(&format!(
            "run scene.toml --quiet --out one --threads 1 {scheme}"
        ));
        for threads in [2, 4] {
            bench.done(&format!(
                "run scene.toml --quiet --out more --threads {threads} {scheme}"
            ));
            let more = FinalState::read(&bench.path("more"));
            FinalState::read(&bench.path("one")).assert_same(&more, integrator);
        }
        let part = format!("run scene.toml --quiet --out parts {scheme}");
        let stopped = bench.call(&format!("{part} --threads 1 --set run.max_steps=101"));
        assert!(stopped.code.is_some(), "{}", stopped.err);
        bench.done(&format!("{part} --threads 2 --resume --changed"));
        let whole = FinalState::read(&bench.path("one"));
        let parts = FinalState::read(&bench.path("parts"));
        assert_eq!(
            whole.columns["wall_states"], parts.columns["wall_states"],
            "{integrator}"
        );
        whole.assert_same(&parts, integrator);
        let series = sph_io::read_table(bench.path("one/series.csv")).expect("a series");
        let way = series.column("float.x").expect("a way");
        let pushed = way.last().expect("rows").abs();
        assert!(
            pushed > 1e-3,
            "{integrator}: the boxes did not meet, {pushed} m"
        );
    }
}
