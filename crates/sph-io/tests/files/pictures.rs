//! Pictures have the right size and colours in the right places.

use std::fs;

use sph_io::{Colour, ColourMap, IoError, Picture, Plot, Series, Style, View};
use tiny_skia::Pixmap;

fn pixel(map: &Pixmap, x: u32, y: u32) -> Colour {
    let p = map.pixel(x, y).expect("a pixel inside");
    Colour([p.red(), p.green(), p.blue()])
}

fn drawn(picture: &Picture) -> Pixmap {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    picture.save(&path).unwrap();
    Pixmap::load_png(&path).unwrap()
}

fn count(map: &Pixmap, colour: Colour) -> usize {
    let all = (0..map.height()).flat_map(|y| (0..map.width()).map(move |x| (x, y)));
    all.filter(|&(x, y)| pixel(map, x, y) == colour).count()
}

#[test]
fn discs_have_the_colours_of_their_values() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let picture = Picture {
        diameter: 0.9,
        title: "three",
        time: Some(0.1),
        label: "value [1]",
        width: 600,
        ..Picture::new(&points, &[0.0, f64::NAN, 1.0])
    };
    let map = drawn(&picture);
    assert_eq!(map.width(), 600);
    assert_eq!(pixel(&map, 0, 0), Colour([255; 3]));
    for (value, least) in [(0.0, 5000), (1.0, 5000)] {
        let found = count(&map, ColourMap::Viridis.at(value));
        assert!(found > least, "{found} pixels of value {value}");
    }
    assert!(
        count(&map, Colour([255, 0, 255])) > 5000,
        "the missing value"
    );
}

#[test]
fn a_ring_is_drawn_around_its_place_and_not_outside_the_frame() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0]];
    let red = Colour([0xd0, 0x02, 0x1b]);
    let ringed = |ring: Option<[f64; 3]>| {
        let picture = Picture {
            diameter: 0.3,
            width: 1200,
            ring,
            ..Picture::new(&points, &[f64::NAN, 1.0, 2.0])
        };
        count(&drawn(&picture), red)
    };
    assert_eq!(ringed(None), 0);
    let found = ringed(Some([1.0, 0.0, 0.0]));
    assert!(found > 200, "{found} pixels of a ring");
    for nowhere in [[50.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0], [1e308, -1e308, 0.0]] {
        assert_eq!(ringed(Some(nowhere)), 0, "{nowhere:?}");
    }
}

#[test]
fn in_front_view_the_nearest_is_on_top() {
    let near_last = [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
    let near_first = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for (points, values) in [(near_last, [0.0, 1.0]), (near_first, [1.0, 0.0])] {
        let picture = Picture {
            diameter: 1.0,
            view: View::Front,
            width: 400,
            ..Picture::new(&points, &values)
        };
        let map = drawn(&picture);
        assert_eq!(
            pixel(&map, 180, map.height() / 2),
            ColourMap::Viridis.at(1.0)
        );
    }
}

#[test]
fn any_shape_of_scene_gives_a_bounded_picture() {
    let values = [0.0, 1.0];
    for [x, y] in [
        [1e6, 1.0],
        [1.0, 1e6],
        [0.0, 0.0],
        [1e-9, 1e-9],
        [f64::NAN, 1.0],
        [1e300, 1.0],
    ] {
        let points = [[0.0; 3], [x, y, 0.0]];
        for width in [0, 300] {
            let picture = Picture {
                diameter: 0.01,
                width,
                ..Picture::new(&points, &values)
            };
            let map = drawn(&picture);
            assert_eq!(map.width(), width.max(200));
            assert!(
                map.height() >= 100 && map.height() <= 2 * map.width(),
                "{x} {y}"
            );
        }
    }
    let nothing = drawn(&Picture::new(&[], &[]));
    assert_eq!(nothing.width(), 1200);
    let flat = [[0.0; 3], [1.0, 0.0, 0.0]];
    let huge = drawn(&Picture {
        width: 100_000,
        ..Picture::new(&flat, &values)
    });
    assert_eq!(huge.width(), 8192);
}

#[test]
fn walls_and_ranges_are_drawn() {
    let wall = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]];
    let points = [[0.5, 0.3, 0.0]];
    let picture = Picture {
        diameter: 0.2,
        walls: &wall,
        range: Some([-1.0, 1.0]),
        colours: ColourMap::CoolWarm,
        ..Picture::new(&points, &[0.0])
    };
    let map = drawn(&picture);
    assert!(count(&map, ColourMap::CoolWarm.at(0.5)) > 5000);
    assert!(count(&map, Colour([0x3a, 0x3a, 0x3a])) > 500, "the wall");
}

#[test]
fn misfits_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let points = [[0.0; 3]];
    let good = Picture::new(&points, &[1.0]);
    let bad = [
        Picture::new(&points, &[]),
        Picture {
            diameter: f64::NAN,
            ..good.clone()
        },
        Picture {
            range: Some([1.0, 1.0]),
            ..good.clone()
        },
        Picture {
            window: Some([[0.0, f64::INFINITY], [0.0, 1.0]]),
            ..good
        },
    ];
    for picture in bad {
        let error = picture.save(&path).unwrap_err();
        assert!(matches!(error, IoError::Input(..)), "{error}");
    }
    assert!(!path.exists());
}

fn plot() -> Plot {
    Plot {
        title: "errors & <orders>".into(),
        x_label: "spacing [m]".into(),
        y_label: "error [1]".into(),
        log_x: true,
        log_y: true,
        series: vec![
            Series::line("computed", vec![[0.01, 1e-4], [0.1, 1e-2], [0.2, -1.0]]),
            Series::markers("measured", vec![[0.03, 1e-3], [f64::NAN, 1.0]]),
            Series::band("scatter", vec![[0.01, 1e-5], [0.1, 1e-4]], vec![1e-3, 1e-2]),
            Series::styled("others", vec![[0.02, 1e-5], [0.2, 1e-4]], Style::Background),
        ],
    }
}

#[test]
fn plots_come_as_pixels_and_as_vectors() {
    let folder = tempfile::tempdir().unwrap();
    let (png, svg) = (folder.path().join("a.png"), folder.path().join("a.svg"));
    plot().save(&png).unwrap();
    plot().save(&svg).unwrap();
    let map = Pixmap::load_png(&png).unwrap();
    assert_eq!((map.width(), map.height()), (1200, 800));
    assert!(
        count(&map, Colour([0x00, 0x72, 0xb2])) > 500,
        "the first line"
    );
    let text = fs::read_to_string(&svg).unwrap();
    assert!(text.contains(">errors &amp; &lt;orders&gt;</text>"));
    assert!(text.contains(">10⁻³</text>") && text.ends_with("</svg>\n"));
    assert!(!text.contains("NaN") && !text.contains("inf"));
    assert!(text.contains("#c4c4c4") && !text.contains(">others<"));
    assert_eq!(plot().to_svg().unwrap(), text);
}

#[test]
fn odd_plots_do_no_harm() {
    let folder = tempfile::tempdir().unwrap();
    let (png, svg) = (folder.path().join("a.png"), folder.path().join("a.svg"));
    let odd = [
        vec![],
        vec![[1.0, 1.0]],
        vec![[0.0, -1.0], [f64::INFINITY, 2.0]],
        vec![[-1e300, 1e300], [1e300, -1e300]],
        vec![[1e-300, 1e-300], [1e100, 1e100]],
    ];
    for points in odd {
        for log in [false, true] {
            let series = vec![Series::styled("odd", points.clone(), Style::LineAndMarkers)];
            let plot = Plot {
                log_x: log,
                log_y: log,
                series,
                ..Plot::default()
            };
            plot.save(&png).unwrap();
            plot.save(&svg).unwrap();
            let text = fs::read_to_string(&svg).unwrap();
            assert!(!text.contains("NaN"), "{text}");
        }
    }
    let mut uneven = plot();
    uneven.series[2].style = Style::Band(vec![]);
    assert!(matches!(uneven.save(&png), Err(IoError::Input(..))));
}

#[test]
fn a_fluid_in_space_shows_its_surface_brighter_where_the_light_falls() {
    // A block, level above and steep in front.
    let grid = |k: usize| [k % 10, k / 10 % 10, k / 100].map(|n| 0.1 * n as f64);
    let points: Vec<[f64; 3]> = (0..1000).map(grid).collect();
    let values = vec![0.5; points.len()];
    let picture = Picture {
        diameter: 0.1,
        view: View::Above,
        range: Some([0.0, 1.0]),
        width: 600,
        ..Picture::new(&points, &values)
    };
    let map = drawn(&picture);
    let brightness = |x: u32, y: u32| pixel(&map, x, y).0.map(u32::from).iter().sum::<u32>();
    let (across, height) = (map.width() / 2, map.height());
    let (above, before) = (
        brightness(across, height * 3 / 10),
        brightness(across, height * 7 / 10),
    );
    assert!(above > before + 60 && above < 3 * 250, "{above} {before}");
    assert_eq!(pixel(&map, 60, 60), Colour([255; 3]));
}

#[test]
fn classes_have_their_names_and_colours_of_their_own() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let names = ["water".to_string(), "air".to_string()];
    let picture = Picture {
        diameter: 0.9,
        width: 600,
        classes: &names,
        labels: &[([0.5, 0.0, 0.0], "between".into())],
        strokes: &[(vec![[0.0; 3], [1.0, 0.0, 0.0]], Colour([1, 2, 3]))],
        ..Picture::new(&points, &[0.0, 1.0])
    };
    let map = drawn(&picture);
    for colour in [[0x00, 0x72, 0xb2], [0xd5, 0x5e, 0x00]] {
        assert!(count(&map, Colour(colour)) > 2000);
    }
    assert!(count(&map, Colour([1, 2, 3])) > 100, "a stroke");
}
