//! A scene from a text, stepped by hand: no file is read and none is written.

use sph_core::fields;
use sph_particles::{RunError, Stepper};

const SCENE: &str = r#"
title = "A drop falls"
dimension = 2
[run]
end = "0.1 s"
[numerics]
spacing = "5 mm"
gravity = [0.0, -9.81]
[phase.water]
density = "1 g/cm^3"
velocity_scale = "2 m/s"
[phase.water.rheology.newtonian]
viscosity = "1 mm^2/s"            # kinematic: that of the phase is 1 mPa s
[body.drop]
phase = "water"
box = [[0.0, 0.0], [0.05, 0.05]]
"#;

/// Height of the centre above its start (m) and mean velocity (m/s) after `seconds`.
pub fn fall(seconds: f64) -> Result<[f64; 2], RunError> {
    let loaded = sph_scene::parse(SCENE, "drop.toml", &[]);
    let loaded = loaded.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let mut drop = Stepper::<2>::new(&loaded.scene)?;
    let mean = |drop: &Stepper<2>, field| {
        let all = drop.parts().flow.world.free.get(field)?;
        Ok::<f64, RunError>(
            all.iter().map(|v: &sph_core::Vect<2>| v[1]).sum::<f64>() / all.len() as f64,
        )
    };
    let start = mean(&drop, fields::POSITION)?;
    drop.run_until(seconds)?;
    Ok([
        mean(&drop, fields::POSITION)? - start,
        mean(&drop, fields::VELOCITY)?,
    ])
}

fn main() -> Result<(), RunError> {
    let [height, velocity] = fall(0.1)?;
    println!("after 0.1 s: {height:.5} m, {velocity:.5} m/s");
    Ok(())
}
