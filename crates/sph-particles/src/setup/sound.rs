//! The numerical speed of sound of every phase.

use sph_rheology::state::Laws;
use sph_scene::{Phase, PressureOf, ReferencePressure, Scene};
use sph_solver::SolverError;

/// The speed of sound of every phase, m/s, in the order of their names; `fall` is √(gH), m/s.
///
/// Each phase has its own, unless `numerics.reference_pressure` gives all of them one p_r = ρ₀c₀²:
/// c₀ = √(p_r/ρ₀) (Krimi et al. 2018, Eq. 5 and 6).
///
/// # Errors
/// If no key gives it, or a phase gives a speed beside the common pressure.
pub fn sound_speeds(scene: &Scene, fall: f64) -> Result<Vec<f64>, SolverError> {
    let phases = || scene.phase.iter();
    let own = |(name, phase): (&String, &Phase)| own(name, phase, fall);
    let pressure = match scene.numerics.reference_pressure {
        None => return phases().map(own).collect(),
        Some(ReferencePressure::Value(pressure)) => {
            refuse_own(scene, None)?;
            pressure
        }
        Some(ReferencePressure::Of(PressureOf::Equal)) => {
            let lightest = phases().min_by(|a, b| a.1.density.total_cmp(&b.1.density));
            refuse_own(scene, lightest.map(|(name, _)| name.as_str()))?;
            let speed = lightest.map_or(Ok(0.0), own)?;
            lightest.map_or(0.0, |(_, phase)| phase.density) * speed * speed
        }
    };
    let speeds = phases().map(|(_, p)| (pressure / p.density).sqrt());
    Ok(speeds.collect())
}

/// The least speed of sound of all phases, m/s.
pub fn slowest_sound(laws: &Laws) -> f64 {
    let sounds = laws.iter().map(|law| law.reference().sound_speed);
    sounds.fold(f64::INFINITY, f64::min)
}

/// The speed of sound of a phase by itself.
fn own(name: &str, phase: &Phase, fall: f64) -> Result<f64, SolverError> {
    let default = 10.0 * phase.velocity_scale.unwrap_or(0.0).max(fall);
    let speed = phase.speed_of_sound.unwrap_or(default);
    match speed > 0.0 {
        true => Ok(speed),
        false => Err(SolverError::at(
            format!("phase.{name}"),
            "without gravity the speed of sound cannot be guessed: give `speed_of_sound`, or \
             `velocity_scale`, the largest speed you expect",
        )),
    }
}

/// Refuses speeds of sound of other phases than the one that gives the common pressure.
fn refuse_own(scene: &Scene, giver: Option<&str>) -> Result<(), SolverError> {
    let mut given = scene
        .phase
        .iter()
        .filter(|(_, p)| p.speed_of_sound.is_some());
    let Some((name, _)) = given.find(|(name, _)| giver != Some(name.as_str())) else {
        return Ok(());
    };
    let from = giver.map_or(String::new(), |of| format!(", from that of `{of}`"));
    let why = format!(
        "`numerics.reference_pressure` gives the phase its speed of sound{from}: leave it out"
    );
    Err(SolverError::at(format!("phase.{name}.speed_of_sound"), why))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn speeds(numerics: &str, water: &str, oil: &str) -> Result<Vec<f64>, String> {
        let text = format!(
            "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics = {{ spacing = 0.1{numerics} }}\n\
             phase.oil = {{ density = 2000, rheology.newtonian = {{ viscosity = 1 }}{oil} }}\n\
             phase.water = {{ density = 1000, rheology.newtonian = {{ viscosity = 1 }}{water} }}\n\
             body.a = {{ phase = \"water\", box = [[0, 0], [1, 1]] }}\n"
        );
        let scene = sph_scene::parse(&text, "t.toml", &[]);
        let scene = scene.unwrap_or_else(|e| panic!("{e}")).scene;
        sound_speeds(&scene, 3.0).map_err(|e| e.to_string())
    }

    #[test]
    fn phases_have_their_own_speed_or_one_pressure() {
        let near = |found: Result<Vec<f64>, String>, exact: [f64; 2]| {
            let found = found.unwrap_or_else(|e| panic!("{e}"));
            let off = found.iter().zip(exact).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{found:?}");
        };
        near(speeds("", "", ", speed_of_sound = 7"), [7.0, 30.0]);
        near(speeds("", ", velocity_scale = 5", ""), [30.0, 50.0]);
        let pressure = ", reference_pressure = \"400 kPa\"";
        near(speeds(pressure, "", ""), [200_f64.sqrt(), 20.0]);
        let equal = ", reference_pressure = \"equal\"";
        let given = speeds(equal, ", speed_of_sound = 20", "");
        near(given, [200_f64.sqrt(), 20.0]);
        near(speeds(equal, "", ""), [450_f64.sqrt(), 30.0]);
    }

    #[test]
    fn a_speed_beside_the_pressure_is_refused() {
        let speed = ", speed_of_sound = 20";
        let told = speeds(", reference_pressure = 4e5", speed, "").unwrap_err();
        assert!(told.starts_with("phase.water.speed_of_sound: `numerics.reference"));
        let told = speeds(", reference_pressure = \"equal\"", "", speed).unwrap_err();
        assert!(told.contains("from that of `water`"));
    }
}
