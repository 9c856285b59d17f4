//! What this machine does in a second: measured once, and kept for the next command.

use std::io;
use std::path::{Path, PathBuf};

use etcetera::BaseStrategy;
use serde::{Deserialize, Serialize};
use sph_solver::Calibration;
use sph_study::Machine;

/// Small scenes whose pieces are timed; those without walls first.
const SCENES: [&str; 5] = [
    include_str!("calibration/box-2d.toml"),
    include_str!("calibration/box-3d.toml"),
    include_str!("calibration/tank-2d.toml"),
    include_str!("calibration/tank-3d.toml"),
    include_str!("calibration/soil-2d.toml"),
];

/// For what a calibration holds: another program, or another processor, is measured anew.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Key {
    version: String,
    built_with: String,
    checks: bool,
    machine: Machine,
}

impl Key {
    fn this() -> Self {
        Key {
            version: env!("CARGO_PKG_VERSION").into(),
            built_with: env!("SPH_BUILT_WITH").into(),
            checks: cfg!(debug_assertions),
            machine: Machine::this(),
        }
    }
}

/// What is in the file.
#[derive(Serialize, Deserialize)]
struct Kept {
    key: Key,
    calibration: Calibration,
}

/// A calibration, and what to say of it.
pub struct Told {
    /// What pieces of work cost.
    pub calibration: Calibration,
    /// Where it comes from.
    pub origin: String,
}

/// The calibration of this machine: that of the user's cache folder where it is of this program and processor, else a
/// new one, about a second's work, which is left there. A folder that cannot be written only means that the next command
/// measures again.
pub fn calibration() -> Result<Told, String> {
    at(place().as_deref())
}

fn at(place: Option<&Path>) -> Result<Told, String> {
    let key = Key::this();
    let cpu = key.machine.cpu.clone();
    if let Some((place, kept)) = place.and_then(|p| Some((p, read(p)?)))
        && kept.key == key
    {
        let place = place.display();
        return Ok(Told {
            calibration: kept.calibration,
            origin: format!("a calibration of this machine ({cpu}), {place}"),
        });
    }
    let calibration = measured()?;
    let kept = Kept { key, calibration };
    let where_to = match place.map(|p| (p, write(p, &kept))) {
        Some((place, Ok(()))) => format!("kept in {}", place.display()),
        Some((place, Err(e))) => format!("not kept, {}: {e}", place.display()),
        None => "not kept: there is no cache folder".into(),
    };
    Ok(Told {
        calibration: kept.calibration,
        origin: format!("a calibration of this machine ({cpu}), measured now and {where_to}"),
    })
}

/// The file in the user's cache folder, by the conventions of the system.
fn place() -> Option<PathBuf> {
    let folders = etcetera::choose_base_strategy().ok()?;
    Some(folders.cache_dir().join("sph").join("calibration.json"))
}

fn measured() -> Result<Calibration, String> {
    let scene = |text: &&str| {
        let loaded = sph_scene::parse(text, "calibration", &[]);
        loaded.map_err(|refused| {
            let first = refused.diagnostics.first();
            first.map_or(String::new(), |d| d.message.clone())
        })
    };
    let scenes: Vec<_> = SCENES.iter().map(scene).collect::<Result<_, _>>()?;
    Calibration::measure(scenes.iter().map(|s| &s.scene)).map_err(|e| e.to_string())
}

/// A file that is not one of ours is as good as none.
fn read(place: &Path) -> Option<Kept> {
    serde_json::from_slice(&std::fs::read(place).ok()?).ok()
}

/// Whole or not at all: others may read meanwhile.
fn write(place: &Path, kept: &Kept) -> io::Result<()> {
    let folder = place.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let text = serde_json::to_vec_pretty(kept)?;
    let aside = folder.join(format!("calibration.{}.tmp", std::process::id()));
    let written = std::fs::write(&aside, text).and_then(|()| std::fs::rename(&aside, place));
    if written.is_err() {
        let _ = std::fs::remove_file(&aside);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_kept_and_believed_for_this_program_and_machine_alone() {
        let folder = std::env::temp_dir().join(format!("sph-calibration-{}", std::process::id()));
        let place = folder.join("below").join("calibration.json");
        let first = at(Some(&place)).expect("a calibration");
        assert!(first.origin.contains("kept in"), "{}", first.origin);
        let again = at(Some(&place)).expect("a calibration");
        assert_eq!(first.calibration, again.calibration);
        assert!(!again.origin.contains("measured now"), "{}", again.origin);
        let text = std::fs::read_to_string(&place).expect("a file");
        let other = text.replace(&Key::this().machine.cpu, "another processor");
        for bad in [other.as_str(), "{", ""] {
            std::fs::write(&place, bad).expect("a folder");
            let told = at(Some(&place)).expect("a calibration");
            assert!(told.origin.contains("measured now"), "{}", told.origin);
        }
        std::fs::remove_dir_all(&folder).expect("our own folder");
    }

    #[test]
    fn a_folder_that_cannot_be_written_is_no_failure() {
        let told = at(Some(Path::new("/dev/null/sph/calibration.json")));
        let told = told.expect("a calibration");
        assert!(told.origin.contains("not kept"), "{}", told.origin);
    }
}
