use dem_coupled::*;
use dem_grains::*;
fn main() {
    for f in ["box200.txt", "box1000_mono.txt"] {
        let text = std::fs::read_to_string(format!("crates/dem-coupled/tests/packings/{f}")).unwrap();
        let grains: Vec<_> = text.lines().filter(|l| !l.starts_with('#')).map(|l| {
            let n: Vec<f64> = l.split_whitespace().map(|w| w.parse().unwrap()).collect();
            Grain::new([n[0], n[1], n[2]], n[3], 2600.0)
        }).collect();
        for (axis, stick) in [(1, true), (2, true), (1, false), (2, false), (0, true)] {
            let setup = Setup::new(grains.clone(), LinearElastic::new(15e6, 0.5, 0.5)).walls(Wall::cuboid([0.0; 3], [1.0; 3]));
            let side = |d: bool| Side { sticks: stick, ..if d { Side::drained(0.0) } else { Side::closed() } };
            let mut fs = FlowSetup::new(Fluid::new(250.0, 0.0));
            for w in 0..6 { fs = fs.side(w, side(w / 2 == axis)); }
            let mut s = CoupledSystem::new(GrainSystem::new(setup).unwrap(), fs).unwrap();
            let l = s.step_limit().unwrap();
            let d = 2.0 * s.grains().grains().radii().iter().copied().fold(f64::MAX, f64::min);
            let dm = 2.0 * s.grains().grains().radii().iter().sum::<f64>() / grains.len() as f64;
            let r = std::f64::consts::PI * 2600.0 / (1200.0 * 250.0);
            println!("{f} axis {axis} stick {stick}: {:.4} {:.4}", l.viscous / (r * d * d), l.viscous / (r * dm * dm));
        }
    }
}
