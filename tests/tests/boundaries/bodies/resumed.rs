//! The same bits for any number of threads and after an interruption.

use sph_tests::bench;

use crate::bodies::FLOAT;

#[test]
fn bodies_are_threaded_and_resumed_bit_for_bit() {
    for integrator in ["symplectic-euler", "leap-frog", "verlet"] {
        let bench = bench!(FLOAT);
        let scheme = format!("--set integrator={{\"{integrator}\"={{}}}}");
        // It meets a second box, which is held by a line.
        bench.write(
            "scene.toml",
            format!(
                "{FLOAT}\n[wall.buoy]\nbox = [[0.54, 0.2], [0.64, 0.3]]\nfluid = \"outside\"\n\
                 [wall.buoy.mover.rigid-body]\nmass = 4.0\nfriction = 0.3\nvelocity = [-1.5, 0.0]\n\
                 [[wall.buoy.mover.rigid-body.line]]\nfrom = [0.7, 0.0]\nto = [0.62, 0.2]\n\
                 stiffness = 2000.0\ndamping = 20.0\n"
            ),
        );
        let one = bench.same_bits(&scheme, 101);
        bench.done(&format!(
            "run scene.toml --quiet --out four --threads 4 {scheme}"
        ));
        one.assert_same(&bench.state("four"), integrator);
        let pushed = bench.series("one").last("float.x").abs();
        assert!(pushed > 1e-3, "the boxes did not meet, {pushed} m");
    }
}
