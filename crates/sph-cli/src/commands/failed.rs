//! A failed run in a few lines.

use sph_particles::{Failure, Findings, ParticleRecord, Share, Suspect};

use crate::terminal::layout::{columns, remarks, row};

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
    text.push_str(&format!(
        "the step\n  Δt = {:.3e} s, bound `{}`, {tried}\n",
        found.dt, found.limiter
    ));
    if !found.advice.is_empty() {
        text.push_str("what may help\n");
        text.push_str(&remarks(&found.advice));
    }
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
    let rows: Vec<_> = files
        .map(|(what, path)| row(what, path.display().to_string()))
        .collect();
    if !rows.is_empty() {
        text.push_str("written\n");
        text.push_str(&columns(2, &rows));
    }
    text
}

fn suspect(suspect: &Suspect) -> String {
    let named = match suspect.named {
        true => "the particle",
        false => "the particle with the largest acceleration",
    };
    let mut text = format!(
        "{named}\n  number {} of body `{}`, phase `{}`\n",
        suspect.number, suspect.body, suspect.phase
    );
    let both = [("before", &suspect.before), ("failed", &suspect.after)];
    for (when, seen) in both {
        text.push_str(&seen.as_ref().map_or(String::new(), |s| sighting(when, s)));
    }
    text
}

fn sighting(when: &str, seen: &ParticleRecord) -> String {
    let number = |x: &Option<f64>| x.map_or("not finite".into(), |x| format!("{x:.4e}"));
    let list = |v: &[Option<f64>]| v.iter().map(number).collect::<Vec<_>>().join(", ");
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
    let mut text = String::new();
    for (when, shares) in all.into_iter().filter(|(_, s)| !s.is_empty()) {
        text.push_str(&format!("what acted on it {when}, m/s²\n"));
        let rows: Vec<_> = shares.iter().take(TERMS).map(share).collect();
        text.push_str(&columns(2, &rows));
    }
    text
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
