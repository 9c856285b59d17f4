use dem_coupled::*;
use dem_grains::*;
fn env(k: &str, d: f64) -> f64 { std::env::var(k).map_or(d, |s| s.parse().unwrap()) }
fn conf() -> f64 { env("CONF", 5e4) }
fn laws() -> Vec<Box<dyn ContactLaw>> {
    let f = env("FRICTION", 0.577);
    vec![Box::new(LinearElastic::new(15e6, env("KT", 0.5), f)), Box::new(LinearElastic::new(15e6, 0.0, 0.0))]
}
fn press(g: &mut GrainSystem, stress: f64) {
    let mass = env("PISTON", 0.1) * g.grains().masses().iter().sum::<f64>();
    g.walls_mut()[5].control = Control::Piston { stress, mass };
}
fn main() {
    let text = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let grains: Vec<_> = text.lines().filter(|l| !l.starts_with('#')).map(|l| {
        let n: Vec<f64> = l.split_whitespace().map(|w| w.parse().unwrap()).collect();
        Grain::new([n[0], n[1], n[2]], n[3], env("RHO", 2600.0))
    }).collect();
    let mut setup = Setup { grains, laws: laws(), ..Setup::default() };
    setup = setup.walls(Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1))).damping(0.4);
    let mut g = GrainSystem::new(setup).unwrap();
    let load = env("LOAD", 5e3);
    press(&mut g, conf());
    println!("settle {}", settle(&mut g, 0.8, 1e-5, 100000).unwrap());
    let st = g.save();
    let h0 = g.box_lengths().unwrap()[2];
    press(&mut g, conf() + load);
    settle(&mut g, 0.8, 1e-6, 100000).unwrap();
    let dry = (h0 - g.box_lengths().unwrap()[2]) / h0;
    let mut g = GrainSystem::resume(st, laws()).unwrap();
    g.set_damping(env("DAMP", 0.0)).unwrap();
    press(&mut g, conf() + load);
    let mut fs = FlowSetup::new(Fluid::new(env("MU", 125.0), 0.0));
    if env("STICK", 0.0) > 0.0 { fs = fs.sticking(); }
    let side = |p| Side { sticks: env("STICK", 0.0) > 0.0, ..Side::drained(p) };
    fs = fs.side(4, side(0.0)).side(5, side(0.0)).remeshing(if env("NEVER", 0.0) > 0.0 { Remeshing::never() } else { Remeshing::default() });
    let t0 = g.time();
    let mut s = CoupledSystem::new(g, fs).unwrap();
    let k = s.mobility(2).unwrap();
    let e = load / dry;
    let d50 = 2.0 * s.grains().grains().radii()[100];
    let full = Terzaghi { coefficient: k * e, drainage: 0.5 * h0 };
    println!("dry {dry:e} E {e:e} K {k:e} Cv {} {:?}", k * e, s.step_limit().unwrap());
    let mut tau = 0.0;
    let mut n = 0;
    for tv in [0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0] {
        if tv > env("END", 2.0) { break; }
        let mut u = 0.0;
        while s.time() - t0 < full.time(tv) {
            let dt = 0.8 * s.step_limit().unwrap().step;
            s.step_unchecked(dt).unwrap();
            u = (h0 - s.grains().box_lengths().unwrap()[2]) / h0 / dry;
            tau += (1.0 - u) * dt;
            n += 1;
        }
        let p = s.layer_pressure(2, 0.5 - 0.5 * d50, 0.5 + 0.5 * d50).unwrap() / load;
        let top = s.grains().wall_stress(5).unwrap(); let inner = s.layer_pressure(2, 0.25, 0.75).unwrap() / load;
        let sig = (s.effective_stress(2, 0.5).unwrap() - conf()) / load;
        println!("{tv:6} n {n:5} p {p:.3} inner {inner:.3} U {u:.3} | T {:.3} {:.3} | s+p {:.3} m {} unb {:.1e} top {:.3}", full.pressure(0.5, full.time(tv)), full.consolidation(full.time(tv)), sig + p, s.meshes(), s.grains().unbalanced_force(), (top - conf()) / load);
    }
    println!("tau {} ratio {}", tau, full.time(1.0 / 3.0) / tau);
}
