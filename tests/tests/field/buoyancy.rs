//! Forces on walls near other walls, and bodies that come down.

use sph_tests::near;

use crate::Field;

/// ρ g V; what is asked of the force, and the disorder of the particles is in both.
fn is_archimedes(force: f64, volume: f64, case: &str) {
    near(force, 1000.0 * 9.81 * volume, 0.03, case);
}

#[test]
fn a_block_bears_its_buoyancy_from_two_spacings_over_the_floor_on() {
    let field = Field::new();
    // Where rows do not fit into the gap the particles are relaxed: else water streams out of it for seconds.
    let relaxed = "--set numerics.relax.steps=400 --set numerics.relax.tolerance=0.001";
    for (gap, more) in [(0.1, ""), (0.15, ""), (0.125, relaxed), (0.175, relaxed)] {
        let block = format!("--set wall.a.box=[[0.6,{gap}],[1.0,{}]]", gap + 0.3);
        let series = field.ran("gap-2", &format!("{block} {more} --set run.end=2"));
        is_archimedes(series.mean("F.y", 0.8), 0.12, &block);
    }
}

#[test]
fn a_block_in_space_bears_its_buoyancy_two_spacings_over_the_floor() {
    let field = Field::new();
    let series = field.ran("gap-space", "");
    is_archimedes(series.mean("F.z", 0.2), 0.3 * 0.3 * 0.25, "in space");
}

/// 2 spacings between them; a side bears ρ g (0.8² − 0.25²)/2 up to half the height of the blocks.
#[test]
fn blocks_side_by_side_do_not_push_each_other() {
    let field = Field::new();
    let blocks = "--set wall.a.box=[[0.4,0.25],[0.7,0.55]] --set run.end=2 \
                  --set wall.b.box=[[0.8,0.25],[1.1,0.55]] --set wall.b.fluid=\"outside\"";
    let series = field.ran("gap-2", blocks);
    is_archimedes(series.mean("F.y", 0.8), 0.09, "beside another");
    let push = series.mean("F.x", 0.8);
    let side = 1000.0 * 9.81 * 0.3 * 0.4;
    assert!(push.abs() < 0.03 * side, "{push} N/m of {side} on a side");
}

/// Half an ellipse of 0.8 × 0.16 m, 4 spacings high, a hundredth of a spacing over the slope: ρ V g sin θ, whatever its bottom bears.
#[test]
fn a_hump_on_a_slope_bears_its_buoyancy_along_the_slope() {
    let field = Field::new();
    let series = field.ran("hump", "");
    let (force, exact) = (-series.mean("F.x", 0.4), 1000.0 * 0.100244 * 2.539015);
    near(force, exact, 0.03, "N/m");
}

/// Surfaces push each other from one spacing on: it rests there, at 0.05 m, as no weight of these compresses the contact by
/// more than 2 % of it (k δr = 2 ρ c²).
#[test]
fn heavy_boxes_come_down_and_stay() {
    let field = Field::new();
    for input in ["hover-1500", "steel-box"] {
        let series = field.ran(input, "--set run.end=3");
        let down = series.mean("A.y", 2.0);
        assert!((down + 0.35).abs() < 0.001, "{input} is at {down} m");
        let turned = series.mean("A.angle", 2.0);
        assert!(turned.abs() < 1e-3, "{input} is turned by {turned}");
        let thin = series.mean("least_density_ratio", 2.0);
        assert!(thin > 0.99, "{input}: water of {thin} of its density");
    }
}
