//! Streamlines, profiles and tracks of flows that are known.

use std::path::Path;

use sph_io::curves::{Cloud, DrawError, Frames, Line, evenly, nearest, streamlines, tracks};
use sph_io::{Cells, FieldData, Frame, Piece, PvdSeries};
use sph_tests::Says;

/// Spacing of the particles, m.
const SPACING: f64 = 0.05;

/// A number between −1 and 1 that looks like chance.
fn shaken(k: usize) -> f64 {
    let x = (k as f64 * 12.9898).sin() * 43_758.545_3;
    2.0 * (x - x.floor()) - 1.0
}

/// A square of particles around the origin, shaken by a fifth of their spacing.
fn square() -> Vec<[f64; 3]> {
    let side = 41;
    let place = |k: usize| (k as f64 - 20.0) * SPACING;
    (0..side * side)
        .map(|k| {
            let shake = 0.2 * SPACING;
            [
                place(k % side) + shake * shaken(2 * k),
                place(k / side) + shake * shaken(2 * k + 1),
                0.0,
            ]
        })
        .collect()
}

fn turning(points: &[[f64; 3]]) -> Vec<f64> {
    points.iter().flat_map(|[x, y, _]| [-y, *x, 0.0]).collect()
}

/// The fit is exact for a linear velocity, so that the only error is that of the steps: a step of fourth order turns by
/// the angle φ = s/r with a relative error of the radius of φ⁶/144 at most, 2πr/s times.
#[test]
fn streamlines_of_a_rigid_rotation_are_circles() {
    let points = square();
    let cloud = Cloud::new(&points, SPACING);
    let lines = streamlines(&cloud, &turning(&points), 2, 0.1);
    assert!(lines.len() >= 8, "{} lines", lines.len());
    let mut closed = 0;
    let mut worst: f64 = 0.0;
    for line in &lines {
        let radius = |p: &[f64; 3]| p[0].hypot(p[1]);
        let start = radius(&line[line.len() / 2]);
        let step = 0.25 * SPACING;
        let bound = (step / start).powi(5) * std::f64::consts::TAU / 72.0 + 1e-12;
        for p in line {
            let off = (radius(p) / start - 1.0).abs();
            worst = worst.max(off);
            assert!(off < bound, "{start} m: {off:.2e}, bound {bound:.2e}");
        }
        closed += usize::from(line.first() == line.last());
    }
    println!(
        "{} lines, {closed} closed, off their circles by {worst:.2e} at most",
        lines.len()
    );
    assert!(closed >= 5, "{closed} of {} closed", lines.len());
    for (k, line) in lines.iter().enumerate() {
        for other in &lines[..k] {
            let apart = line
                .iter()
                .flat_map(|p| other.iter().map(move |q| (p[0] - q[0]).hypot(p[1] - q[1])));
            // A line ends where another is nearer than half of the distance.
            assert!(apart.fold(f64::INFINITY, f64::min) > 0.5 * 0.1 - 1e-9);
        }
    }
}

/// Frames of a square that turns as a whole, with its radius as a column, one radian per second.
fn frames(folder: &Path) -> Frames {
    let start = square();
    let mut series = PvdSeries::create(folder.join("fields.pvd")).expect("a list");
    for index in 0..5 {
        let time = 0.25 * index as f64;
        let (s, c) = time.sin_cos();
        // Another order in every frame, as particles are sorted now and then.
        let order: Vec<usize> = (0..start.len())
            .map(|k| (k * 7 + 13 * index) % start.len())
            .collect();
        let points: Vec<[f64; 3]> = order
            .iter()
            .map(|&k| start[k])
            .map(|[x, y, _]| [c * x - s * y, s * x + c * y, 0.0])
            .collect();
        let linear: Vec<f64> = points
            .iter()
            .map(|[x, y, _]| 3.0 * x - 2.0 * y + time)
            .collect();
        let fields = vec![
            FieldData::scalar("height", "m", linear),
            FieldData::tensor("velocity", "m/s", 3, turning(&points)),
            FieldData::integer(
                "identity",
                order.iter().map(|k| *k as u32).collect::<Vec<_>>(),
            ),
        ];
        let piece = Piece {
            name: "fluid".into(),
            points: points.into(),
            cells: Cells::Vertices,
            fields,
        };
        let frame = Frame {
            time,
            index,
            pieces: vec![piece],
        };
        series.write(&frame, 1).expect("a frame");
    }
    Frames::from_folder(folder).expect("frames")
}

#[test]
fn a_profile_of_a_linear_field_is_exact_and_ends_with_the_fluid() {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = frames(folder.path());
    let line = Line {
        from: [-0.5, 0.3, 0.0],
        to: [2.0, 0.3, 0.0],
        points: 101,
    };
    let snapshot = frames.read(frames.at(Some(0.0))).expect("a frame");
    let column = snapshot.column("height").expect("a field");
    let mut outside = 0;
    for [distance, value] in snapshot.profile(&line, &column.values) {
        let x = distance - 0.5;
        if value.is_nan() {
            outside += 1;
            // The square ends at 1 m, and a particle is within a spacing.
            assert!(x > 1.0, "nothing at {x}");
        } else {
            let off = (value - (3.0 * x - 0.6)).abs();
            assert!(off < 1e-12, "{off:.1e} at {x}");
        }
    }
    assert!(outside > 30, "{outside}");
    let path = folder.path().join("line.svg");
    sph_io::curves::draw_profile(&frames, &line, "velocity.x", &[Some(0.0), None], &path)
        .expect("drawn");
    let table = sph_io::read_table(path.with_extension("csv")).expect("a table");
    assert_eq!(table.column("time").map(<[f64]>::len), Some(202));
    // u = −y on that line, at all times.
    let u = table.column("velocity.x").expect("a column");
    assert!(u.iter().all(|u| u.is_nan() || (u + 0.3).abs() < 1e-12));
}

#[test]
fn tracks_follow_identities_through_other_orders() {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = frames(folder.path());
    let start = frames.read(frames.at(Some(0.0))).expect("a frame");
    let mut who = evenly(&start, 5).expect("identities");
    who.push(nearest(&start, [0.52, -0.31, 0.0]).expect("a particle"));
    let all = tracks(&frames, &who).expect("tracks");
    assert_eq!(all.len(), 6);
    let home = square();
    for track in &all {
        let [x, y, _] = home[track.identity as usize];
        assert_eq!(track.places.len(), 5);
        for (time, place) in &track.places {
            let (s, c) = time.sin_cos();
            assert_eq!(*place, [c * x - s * y, s * x + c * y, 0.0]);
        }
    }
    let path = folder.path().join("tracks.png");
    sph_io::curves::draw_tracks(&frames, &all, "speed", &path).expect("drawn");
    let rows = sph_io::read_table(path.with_extension("csv")).expect("a table");
    assert_eq!(rows.column("identity").map(<[f64]>::len), Some(30));
    let lost = tracks(&frames, &[999_999]).unwrap_err();
    assert!(
        matches!(&lost, DrawError::Unfit(why) if why.ends_with(" 999999")),
        "{lost}"
    );
}

#[test]
fn missing_columns_are_named_with_the_written_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let frames = frames(folder.path());
    let snapshot = frames.read(frames.at(None)).expect("a frame");
    let told = snapshot
        .column("vorticity")
        .err()
        .expect("none")
        .to_string();
    told.says("no field `vorticity` was written (there are: height, velocity, identity)");
    let told = snapshot.column("height.x").map(|c| c.values.len());
    assert_eq!(told.ok(), Some(41 * 41), "a number is its component");
    assert!(snapshot.column("height.y").is_err());
    let drawn = sph_io::curves::draw_streamlines(
        &frames,
        None,
        "height",
        (None, None),
        &folder.path().join("s.png"),
    );
    assert!(drawn.expect("drawn") > 10);
    assert!(Frames::from_folder(&folder.path().join("gone")).is_err());
}

/// Two particles beside each other tell of the slope across them by a hair: nothing is guessed from it.
#[test]
fn a_value_is_not_stretched_over_a_slope_that_particles_hardly_tell() {
    let thread: Vec<[f64; 3]> = (0..10)
        .map(|k| [SPACING * k as f64, 0.02 * SPACING * (k % 2) as f64, 0.0])
        .collect();
    let cloud = Cloud::new(&thread, SPACING);
    assert!(cloud.weights([4.5 * SPACING, 0.5 * SPACING, 0.0]).is_none());
    let along = cloud
        .weights([4.5 * SPACING, 0.01 * SPACING, 0.0])
        .expect("in the fluid");
    let sum: f64 = along.iter().map(|(_, share)| share).sum();
    assert!((sum - 1.0).abs() < 1e-12, "shares add up to {sum}");
    // The corner of a full box, half a spacing beyond the outer particles both ways, is in the fluid.
    let full: Vec<[f64; 3]> = (0..100)
        .map(|k| [SPACING * (k % 10) as f64, SPACING * (k / 10) as f64, 0.0])
        .collect();
    let corner = [-0.5 * SPACING, -0.5 * SPACING, 0.0];
    assert!(Cloud::new(&full, SPACING).weights(corner).is_some());
}
