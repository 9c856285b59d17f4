//! Walls from CAD files and what fills them.

use serde_json::Value as Json;
use sph_tests::{Says, bench, near};

use crate::Field;

/// Facets of a text STL file, as the lines of each.
fn facets(text: &str) -> Vec<Vec<String>> {
    let lines: Vec<String> = text.lines().map(str::to_string).collect();
    let all = lines[1..lines.len() - 1].chunks(7);
    all.map(<[String]>::to_vec).collect()
}

/// A text STL file of facets, some of which are turned round.
fn turned(text: &str, which: &[usize]) -> String {
    let mut facets = facets(text);
    for k in which {
        facets[*k].swap(3, 4);
        facets[*k][0] = " facet normal 0 0 0".to_string();
    }
    let body: Vec<String> = facets.into_iter().flatten().collect();
    format!("solid tank\n{}\nendsolid tank\n", body.join("\n"))
}

#[test]
fn an_open_tank_that_faces_away_is_refused_with_the_count_and_filled_when_it_is_turned() {
    let field = Field::new();
    let words = "0 of 1000 particles | 1000 are behind wall `tank` | flip = true";
    field.refuses("open-tank", "", words);
    // A clipped box as well.
    let clipped = "--set body.water={phase='water',clip=true,box=[[0.0,0.0,0.0],[0.8,0.4,0.2]]}";
    field.refuses("open-tank", clipped, words);
    for key in ["wall.tank.flip=true", "wall.tank.fluid=inside"] {
        let found = field.examined("open-tank", &format!("--set {key}"));
        assert_eq!(found["particles"], 1000, "{key}");
    }
    // The weight of the water, 1000 kg/m³ · 9.81 m/s² · 0.064 m³, is on the floor.
    let short = "--set wall.tank.flip=true --set run.end=0.01 --threads 1";
    let weight = field.ran("open-tank", short).column("tank.pressure.z")[0];
    near(weight, -627.84, 0.01, "N");
}

#[test]
fn water_is_told_from_far_away_in_a_deep_open_tank_that_lies_on_its_side() {
    // Its opening looks along x: a ray upwards meets the lid from within, one to the side nothing.
    let field = Field::new();
    let more = "--set wall.tank.rotate={axis=[0.0,1.0,0.0],angle='90deg'} --set numerics.spacing=0.025 \
                --set body.water={phase='water',fill='walls',box=[[0.0,0.0,-0.8],[0.3,0.4,0.0]]}";
    let found = field.examined("open-tank", &format!("{more} --set wall.tank.flip=true"));
    assert_eq!(found["particles"], 12 * 16 * 32);
    field.refuses("open-tank", more, "0 of 6144 particles | flip = true");
}

#[test]
fn an_open_polyline_that_faces_away_is_refused_with_the_count() {
    let field = Field::new();
    let scene = "title = \"t\"\ndimension = 2\nrun.end = 0.01\nnumerics.spacing = 0.02\nnumerics.smoothing_ratio = 2\n\
                 numerics.gravity = [0, -9.81]\nwalls.usaw.vertices = false\nwall.tank.file = \"u.csv\"\n\
                 phase.water = { density = 1000, rheology.newtonian = { viscosity = 1e-3 } }\n\
                 body.water = { phase = \"water\", fill = \"walls\", box = [[0, 0], [0.6, 0.2]] }\n";
    field.write("u.toml", scene);
    field.write("u.csv", "x [mm]; y [mm]\n600; 400\n600; 0\n0; 0\n0; 400\n");
    field.refuses(
        "u",
        "",
        "0 of 300 particles | behind wall `tank` | flip = true",
    );
    let found = field.examined("u", "--set wall.tank.flip=true");
    assert_eq!(found["particles"], 300);
}

#[test]
fn flipped_facets_are_told_and_turned_on_request() {
    let field = Field::new();
    let text = field.read("open_tank.stl");
    field.write("open_tank.stl", turned(&text, &[2, 7]));
    let words = "2 of 10 facets face the other way | facet 3 at | align = true";
    field.refuses("open-tank", "--set wall.tank.fluid=inside", words);
    let more = "--set wall.tank.fluid=inside --set wall.tank.align=true";
    assert_eq!(field.examined("open-tank", more)["particles"], 1000);
    let told = field.call("check open_tank.stl --json");
    let told = told.json();
    assert_eq!(told["flipped"], serde_json::json!([3, 8]));
    assert_eq!(told["facing"], "outwards");
}

#[test]
fn a_hole_below_water_is_told_with_its_place_and_size() {
    let field = Field::new();
    let words = "wall `tank` is open: 3 edge(s) | an opening of 0.5657 m around (0.4, 0.2, 0.2)";
    field.refuses("stl-hole", "", words);
}

/// What `sph check FILE.stl` says as JSON.
fn surface(field: &Field, file: &str) -> Json {
    let outcome = field.done(&format!("check {file} --json"));
    outcome.json()
}

#[test]
fn a_file_of_facets_is_checked_without_a_scene() {
    let field = Field::new();
    let tube = surface(&field, "tube.stl");
    assert_eq!(tube["facets"], 192);
    assert_eq!(tube["unit"], "mm");
    assert_eq!(tube["openings"].as_array().map(Vec::len), Some(0));
    assert_eq!(tube["facing"], "outwards");
    assert_eq!(tube["extent"][0], 200.0);
    let hole = surface(&field, "tank_hole.stl");
    let hole = &hole["openings"][0];
    // Half of a face of 400 × 400 is missing: three edges, √2 · 400 across.
    assert_eq!(hole["edges"], 3);
    assert_eq!(hole["centre"][0], 400.0);
    assert!((hole["size"].as_f64().expect("a size") - 400.0 * 2f64.sqrt()).abs() < 1e-9);
    let text = field.read("open_tank.stl");
    field.write("in.stl", turned(&text, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]));
    assert_eq!(surface(&field, "in.stl")["facing"], "inwards");
    let plain = field.call("check open_tank.stl").out;
    plain.says("0.8 × 0.4 × 0.4 | 4 edges, 0.8944 across | consistent, outwards");
    // Corners that differ in the last figures are one.
    field.write(
        "loose.stl",
        text.replacen("4.000000e-01", "4.0000002e-01", 7),
    );
    let openings = &surface(&field, "loose.stl")["openings"];
    assert_eq!(openings.as_array().map(Vec::len), Some(1));
}

#[test]
fn invalid_surfaces_are_refused_with_their_defect() {
    let field = Field::new();
    let text = field.read("open_tank.stl");
    field.write("empty.stl", "");
    field.write(
        "page.stl",
        "<html><body>not found, not found, not found, not found, not found, no</body></html>",
    );
    field.write("nan.stl", text.replacen("8.000000e-01", "nan", 1));
    for (file, word) in [
        ("gone.stl", "cannot read `gone.stl`"),
        ("empty.stl", "is empty"),
        ("page.stl", "is no STL file"),
        ("nan.stl", "facet 1: expected finite"),
    ] {
        let outcome = field.refused(&format!("check {file} --json"));
        outcome.says(word);
        let told = outcome.json();
        told[0]["message"].says(word);
    }
}

/// What passed the inlet and the outlet until the end of the last run, and the speed on the axis.
fn passed(field: &Field) -> [f64; 3] {
    let series = field.series();
    ["in.entered", "out.left", "u.x"].map(|name| series.last(name))
}

/// The pipe of `pipe-thick` without a thickness: what the fluid sees of it.
const BORE: &str =
    "--set wall.pipe={cylinder={from=[0,0,0],to=[0.2,0,0],radius=0.05,sides=24,open_ends=true}}";

#[test]
fn a_pipe_with_a_thickness_is_its_bore() {
    let field = Field::new();
    let count = |more: &str| {
        let found = field.examined("pipe-thick", more);
        (found["particles"].clone(), found["wall_elements"].clone())
    };
    let (thick, bore) = (count(""), count(BORE));
    assert_eq!(thick.1, bore.1);
    // Single precision of the file decides about a row just where a particle is too near to the wall.
    let rows = |n: &Json| n.as_u64().expect("a count") / 20;
    let apart = rows(&thick.0).abs_diff(rows(&bore.0));
    assert!(apart <= 1, "{thick:?} {bore:?}");
    let end = "--set run.end=0.4 --threads 1";
    field.run("pipe-thick", &format!("{end} {BORE}"));
    let bore = passed(&field);
    field.run("pipe-thick", end);
    let thick = passed(&field);
    // Each of the 80 ports of a face may hold half of a particle more or less, and they know nothing of each other.
    let held = 0.5 * 80f64.sqrt() * 900.0 * 1e-6;
    // The speed is interpolated to second order, with five rows to the radius.
    let bounds = [0.01 * bore[0], held, 0.04 * bore[2]];
    for ((thick, bore), bound) in thick.iter().zip(bore).zip(bounds) {
        assert!((thick - bore).abs() < bound, "{thick} for {bore}");
    }
    // 900 kg/m³ · 0.1 m/s through a polygon of 24 sides, ½ · 24 · sin 15° · (50 mm)².
    let flux = 900.0 * 0.1 * 12.0 * 15f64.to_radians().sin() * 0.0025;
    near(thick[0], 0.4 * flux, 0.03, "kg that came in");
}

#[test]
fn a_disc_that_covers_the_end_of_a_pipe_closes_it_as_well() {
    // The inlet reaches to the outer edge of the pipe and lies on its end.
    let field = Field::new();
    let text = field.read("inlet.stl");
    let scaled = text
        .lines()
        .map(|line| match line.trim().strip_prefix("vertex") {
            None => line.to_string(),
            Some(numbers) => {
                let numbers: Vec<f64> = numbers
                    .split_whitespace()
                    .map(|n| n.parse().expect("a number"))
                    .collect();
                // Of the tube's own outer corners: bit for bit those of its file.
                format!(
                    "   vertex {:e} {:.6e} {:.6e}",
                    numbers[0],
                    1.2 * numbers[1],
                    1.2 * numbers[2]
                )
            }
        });
    let scaled: Vec<String> = scaled.collect();
    let thick = field.examined("pipe-thick", "")["particles"].clone();
    field.write("inlet.stl", scaled.join("\n"));
    assert_eq!(field.examined("pipe-thick", "")["particles"], thick);
}

#[test]
fn plates_with_a_thickness_hold_a_channel_between_open_faces() {
    // In the plane: two plates with fluid outside, closed by an inlet and an outlet from corner to corner.
    let scene = "title = \"t\"\ndimension = 2\nrun.end = 0.5\nnumerics.spacing = 0.01\nnumerics.smoothing_ratio = 2\n\
                 walls.usaw.vertices = false\nviscous-operator.morris = {}\nsmoother.brezzi-pitkaranta.strength = 0.1\n\
                 wall.inlet.polyline = [[0.0, 0.1], [0.0, 0.0]]\n\
                 wall.inlet.open-boundary.velocity-inlet.velocity = 0.1\n\
                 wall.outlet.polyline = [[0.2, 0.0], [0.2, 0.1]]\nwall.outlet.open-boundary.pressure.pressure = 0\n\
                 phase.oil = { density = 900, speed_of_sound = 3.0, rheology.newtonian = { viscosity = 0.9 } }\n\
                 body.oil = { phase = \"oil\", fill = \"walls\", box = [[0, 0], [0.2, 0.1]] }\n\
                 probe.in = { kind = \"passed\", wall = \"inlet\" }\n\
                 probe.out = { kind = \"passed\", wall = \"outlet\" }\n";
    let thick = "wall.floor = { box = [[0.0, -0.02], [0.2, 0.0]], fluid = \"outside\" }\n\
                 wall.roof = { polygon = [[0.0, 0.1], [0.2, 0.1], [0.2, 0.12], [0.0, 0.12]], fluid = \"outside\" }\n";
    let thin = "wall.floor.polyline = [[0.0, 0.0], [0.2, 0.0]]\nwall.roof.polyline = [[0.2, 0.1], [0.0, 0.1]]\n";
    let field = Field::new();
    let mass = |walls: &str| {
        field.write("duct.toml", format!("{scene}{walls}"));
        let series = field.ran("duct", "--threads 1");
        ["in.entered", "out.left"].map(|name| series.last(name))
    };
    let (thick, thin) = (mass(thick), mass(thin));
    for (thick, thin) in thick.iter().zip(thin) {
        assert!((thick / thin - 1.0).abs() < 1e-6, "{thick} for {thin}");
    }
}

#[test]
fn a_disc_that_faces_out_of_a_pipe_is_named() {
    let field = Field::new();
    let other = "--set wall.outlet.flip=true";
    field.refuses(
        "pipe-thick",
        other,
        "wall `outlet` meets it there | faces the other way",
    );
    let flipped = "--set wall.inlet.flip=true";
    field.refuses(
        "pipe-thick",
        flipped,
        "wall `inlet` meets it there | faces the other way",
    );
}

/// A plate of two triangles, in millimetres.
const PLATE: &str = "solid plate\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 100 0 0\n\
                     vertex 100 100 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n\
                     vertex 100 100 0\nvertex 0 100 0\nendloop\nendfacet\nendsolid plate\n";

const BALL: &str = "title = \"b\"\nrun.end = \"0.5 s\"\n[grains]\ndensity = 2600\ngravity = [0, 0, -9.81]\n\
    [grains.contact.linear-elastic]\nmodulus = \"5 MPa\"\nstiffness_ratio = 0.5\nfriction = 0.3\ndamping = 0.3\n\
    [start]\nfile = \"ball.txt\"\nunit = \"mm\"\nsettle = 1e9\n[box]\nlow = [0, 0, 0]\nhigh = [0.1, 0.1, 0.1]\n\
    [probe.top]\nkind = \"top\"\n[output]\nseries_every = \"10 ms\"\n[wall.plate]\nfile = \"plate.stl\"\n";

/// Height of the top of a ball of 5 mm radius that falls on a plate at 20 mm.
fn rests(keys: &str) -> f64 {
    let bench = bench!(&format!("{BALL}{keys}"),);
    bench.write("plate.stl", PLATE);
    bench.write("ball.txt", "50 50 27 5\n");
    bench.done("run scene.toml --quiet --out r");
    bench.series("r").last("top")
}

#[test]
fn walls_of_grains_from_files_take_unit_scale_and_shift() {
    for keys in ["unit = \"mm\"", "scale = 1e-3"] {
        let top = rests(&format!("{keys}\ntranslate = [0, 0, \"20 mm\"]\n"));
        assert!((top - 0.030).abs() < 1e-4, "{keys}: {top} m");
    }
    let bench = bench!(&format!("{BALL}unit = \"kg\"\nscale = 2\n"),);
    let told = bench.call("check scene.toml");
    told.says("`kg` is no unit of length | not both");
}
