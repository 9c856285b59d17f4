//! A failed run in a few lines.

use sph_core::comma_list;
use sph_particles::{Failure, Findings, ParticleRecord, Share, Suspect};

use crate::terminal::{columns, headed, remarks, row};

/// Number of terms in the report.
const TERMS: usize = 6;

/// The particle, the terms that acted there, remedies, and files to look at.
pub fn text(failure: &Failure) -> String {
    let found = &failure.findings;
    let mut text = found.particle.as_ref().map_or(String::new(), suspect);
    text.push_str(&terms(found));
    let tried = match found.retries {
        0 => "not tried again".to_string(),
        1 => "after a roll-back".to_string(),
        n => format!("after {n} roll-backs"),
    };
    let (dt, limiter) = (found.dt, &found.limiter);
    text.push_str(&format!(
        "the step\n  Δt = {dt:.3e} s, bound `{limiter}`, {tried}\n"
    ));
    text.push_str(&headed("what may help", remarks(&found.advice)));
    let titles = [
        "a picture of the bad state",
        "and of what is around the particle",
    ];
    let pictures = titles.into_iter().zip(&failure.pictures);
    let bad_state = failure.bad_state.iter();
    let bad_state = bad_state.map(|path| ("all of it, for ParaView", path));
    let saved = failure.checkpoint.iter();
    let saved = saved.map(|path| ("the last good state, for --resume", path));
    let files = pictures.chain(bad_state).chain(saved);
    let rows = files.map(|(what, path)| row(what, path.display().to_string()));
    text + &headed("written", columns(2, rows))
}

fn suspect(suspect: &Suspect) -> String {
    let named = match suspect.named {
        true => "the particle",
        false => "the particle with the largest acceleration",
    };
    let Suspect {
        number,
        body,
        phase,
        ..
    } = suspect;
    let mut text = format!("{named}\n  number {number} of body `{body}`, phase `{phase}`\n");
    for (when, seen) in [("before", &suspect.before), ("failed", &suspect.after)] {
        text.extend(seen.iter().map(|seen| sighting(when, seen)));
    }
    text
}

fn sighting(when: &str, seen: &ParticleRecord) -> String {
    let number = |x: &Option<f64>| x.map_or("not finite".into(), |x| format!("{x:.4e}"));
    let list = |v: &[Option<f64>]| comma_list(v.iter().map(number));
    let mut text = format!(
        "  {when}  t = {:.6} s, at ({}) m, u = ({}) m/s\n          ρ = {} kg/m³, p = {} Pa",
        seen.time,
        list(&seen.position),
        list(&seen.velocity),
        number(&seen.density),
        number(&seen.pressure)
    );
    if let Some(nearest) = seen.nearest {
        text.push_str(&format!("; nearest neighbour {nearest:.2} spacings"));
    }
    if let Some((wall, distance)) = &seen.wall {
        text.push_str(&format!("; wall `{wall}` {distance:.2} spacings"));
    }
    text.push('\n');
    text
}

/// The largest terms before and after, m/s².
fn terms(found: &Findings) -> String {
    let all = [
        ("at the last good state", &found.before),
        ("at the bad state", &found.after),
    ];
    let blocks = all.map(|(when, shares)| {
        let rows = shares.iter().take(TERMS).map(share);
        headed(&format!("what acted on it {when}, m/s²"), columns(2, rows))
    });
    blocks.concat()
}

fn share(share: &Share) -> Vec<String> {
    let number = |x: Option<f64>| x.map_or("not finite".into(), |x| format!("{x:.3e}"));
    let mut more = match share.of_walls {
        Some(0.0) => String::new(),
        of_walls => format!("of walls {}", number(of_walls)),
    };
    if let Some(rate) = share.density_rate {
        let comma = if more.is_empty() { "" } else { ", " };
        more.push_str(&format!("{comma}density at {rate:.3e} kg/m³/s"));
    }
    vec![share.term.clone(), number(share.acceleration), more]
}
