//! Means over time and layers, and spectra.

use sph_tests::{FinalState, PERIODIC, Series, bench, close, finished};

use crate::turbulence::{CHANNEL, in_two_parts};

const MEANS: &str =
    "[probe.means]\nkind = \"mean-profile\"\naxis = \"y\"\nfrom = 0.0\nto = 0.2\nlayers = 20\n";

fn curve(folder: &std::path::Path, name: &str) -> Series {
    Series::of(&folder.join("curves").join(name))
}

/// u_x = −3y at the start: layers of two rows have the mean of their middle, and half a spacing of fluctuation.
#[test]
fn layers_have_the_means_of_their_particles() {
    let turning = CHANNEL
        .replace("velocity = [1.0, 0.0]", "")
        .replace("end = 0.02", "end = 1e-7")
        + "[body.water.initial.rigid-rotation]\nangular_velocity = 3.0\ncentre = [0.1, 0.0]\n"
        + &MEANS.replace("layers = 20", "layers = 10");
    let table = curve(finished(&turning, 1).folder(), "means_0000.csv");
    let [distance, mean, rms] = table.columns(["distance", "mean.x", "rms.x"]);
    assert_eq!(distance.len(), 10);
    for k in 0..10 {
        close(mean[k], -3.0 * distance[k], 1e-3, "m/s of a layer");
        assert!((rms[k] / (3.0 * 0.005) - 1.0).abs() < 1e-2, "{}", rms[k]);
    }
}

/// What was gathered before a run was stopped counts after it is resumed: the same file bit for bit.
#[test]
fn means_go_on_in_a_run_that_is_resumed() {
    let text =
        format!("{CHANNEL}{MEANS}").replace("every = 0.02", "every = 0.02\nseries_every = 1e-9");
    let (whole, stopped) = (finished(&text, 1), in_two_parts(&text));
    let resumed = FinalState::read(stopped.path());
    whole.state().assert_same(&resumed, "whole and resumed");
    let [a, b] = [whole.folder(), stopped.path()].map(|folder| {
        let path = folder.join("curves/means_0001.csv");
        std::fs::read_to_string(path).expect("a curve")
    });
    assert_eq!(a, b);
    // 1 m/s but for what the bed has taken from the first rows.
    let means = curve(whole.folder(), "means_0001.csv");
    let mean = means.column("mean.x");
    assert!(mean[0] < mean[19], "{mean:?}");
    close(mean[19], 1.0, 1e-3, "m/s above");
}

/// Vortices of one wave along both axes: all in the shell of √2, and ½⟨u²⟩ = U²/4 but for what the means over the kernel lessen.
#[test]
fn vortices_of_one_wave_stand_in_one_shell() {
    let text = PERIODIC
        .replace("velocity = [1.0, 0.5]", "")
        .replace("end = 0.1", "end = 1e-6")
        + "[body.all.initial.taylor-green]\nspeed = 1.0\nlength = 1.0\nkinematic_viscosity = 1.0\ndensity = 1.0\n\
           [probe.spectrum]\nkind = \"energy-spectrum\"\npoints = 16\n";
    let run = finished(&text, 1);
    let table = curve(run.folder(), "spectrum_0000.csv");
    let [k, e] = table.columns(["wavenumber", "energy"]);
    let first = std::f64::consts::TAU;
    assert!((k[0] - first).abs() < 1e-9 && k.len() == 8, "{k:?}");
    let total: f64 = e.iter().map(|e| e * first).sum();
    assert!(e[0] * first / total > 0.999, "{e:?}");
    assert!((run.last("spectrum.energy") / total - 1.0).abs() < 1e-3);
    assert!(total < 0.25 && total > 0.15, "{total}");
}

#[test]
fn probes_that_do_not_fit_are_refused_before_a_file_is_written() {
    let cases = [
        (
            "[probe.s]\nkind = \"energy-spectrum\"\npoints = 8\n",
            "periodic along all axes",
        ),
        (
            &MEANS.replace("from = 0.0", "from = 1.0"),
            "`to` is to be larger",
        ),
        (
            &MEANS.replace("axis = \"y\"", "axis = \"z\""),
            "no such `axis`",
        ),
        (&format!("{MEANS}field = \"mud\"\n"), "mud"),
    ];
    for (probe, expected) in cases {
        let bench = bench!(&format!("{CHANNEL}{probe}"));
        let outcome = bench.call("run scene.toml");
        let told = outcome.out + &outcome.err;
        assert!(told.contains(expected), "`{expected}` is not in: {told}");
        assert!(!bench.path("scene").exists(), "{probe}");
    }
}
