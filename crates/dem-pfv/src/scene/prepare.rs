//! Grains and walls at the start: placed, grown, rained, settled; the names of those at fault.

use scene_text::unit_factor;

use crate::grains::{
    Cloud, Control, Grain, GrainError, GrainSystem, Mesh, Partner, Setup, Wall, rain, step_to_rest,
    uniform_radii,
};
use crate::scene::{BOX, DemError, Fluid, Lattice, Laws, Loaded, Oedometer, Scene, Weight, tables};
use crate::sphere;

/// Distance of a wall that is not there, m.
pub(crate) const FAR: f64 = 1e4;
/// Porosity at which a poured bed is expected to lie.
pub(crate) const POURED: f64 = 0.4;
/// A listener to the steps of a preparation.
type Listener<'a> = &'a mut dyn FnMut(&str);
/// Share of the box that grains fill before they grow.
const BEFORE_GROWTH: f64 = 0.25;

/// The grains of a scene, prepared, with the laws of the run.
pub fn grains(
    loaded: &Loaded,
    mut laws: Laws,
    tell: Listener<'_>,
) -> Result<GrainSystem, DemError> {
    let scene = &loaded.scene;
    let placed = place(loaded)?;
    let prepared = std::mem::take(&mut laws.prepared);
    let mut setup = setup(loaded, placed, laws)?;
    let top = scene.planes().iter().position(|p| p == "top");
    let poured = scene.start.rained.is_some();
    if let (true, Some(top)) = (poured, top) {
        setup.walls[top].point.z += FAR;
    }
    let mut swap = |(k, law)| (k, std::mem::replace(&mut setup.laws[k], law));
    let run_laws: Vec<_> = prepared.into_iter().map(&mut swap).collect();
    let told = |e: GrainError| {
        let file = scene.start.file.as_ref();
        let message = format!("{e}{}", named(loaded, &e));
        DemError::at(file.map_or("start", |_| "start.file"), message)
    };
    let mut system = GrainSystem::new(setup).map_err(told)?;
    if let Some(grown) = &scene.start.grown {
        tell("growing the grains");
        // Under its own weight a heap would press on the floor before there is a packing.
        let gravity = system.gravity;
        system.gravity = Default::default();
        let steps = grown.run(&mut system, scene.start.safety, scene.start.most_steps);
        system.gravity = gravity;
        let steps = steps.map_err(|e| DemError::at("start.grown", e))?;
        let porosity = system.porosity().map(|n| format!(", porosity {n:.4}"));
        let porosity = porosity.unwrap_or_default();
        tell(&format!("grown in {steps} steps{porosity}"));
    }
    settled(loaded, &mut system, tell)?;
    for (number, law) in run_laws {
        system.set_law(number, law).map_err(told)?;
    }
    if let Some(top) = top {
        lower_the_top(scene, &mut system, top)?;
    }
    Ok(system)
}

/// Lets the grains come to rest under their `weight` and the prepared stress of pistons.
fn settled(loaded: &Loaded, system: &mut GrainSystem, tell: Listener<'_>) -> Result<(), DemError> {
    let scene = &loaded.scene;
    let poured = scene.start.rained.as_ref().map(|_| 1e-2);
    let Some(tolerance) = scene.start.settle.or(poured) else {
        return Ok(());
    };
    if tolerance >= 1.0 {
        let why = "and 1 is free fall: the grains start as they are";
        tell(&format!("`start.settle` is {tolerance}, {why}"));
        return Ok(());
    }
    tell("letting the grains settle");
    let mass: f64 = system.grains.mass.iter().sum();
    let pistons = scene.planes_with_tables();
    for (number, table) in pistons.filter(|(_, w)| w.piston.is_some()) {
        let before = control(table, mass, |p| p.prepared.unwrap_or(p.stress));
        system.walls[number].control = before;
    }
    let gravity = system.gravity;
    let lift = |fluid: &Fluid| fluid.given.density / scene.grains.density;
    let buoyant = 1.0 - scene.fluid.as_ref().map_or(0.0, lift);
    let shares: &[f64] = match scene.start.weight {
        Weight::Buoyant => &[buoyant],
        Weight::Dry => &[1.0, buoyant],
    };
    for share in shares {
        system.gravity = gravity * *share;
        let (safety, most) = (scene.start.safety, scene.start.most_steps);
        let steps = step_to_rest(system, safety, tolerance, most);
        system.gravity = gravity;
        let told = |e| DemError::at("start", format!("{e}{}", named(loaded, &e)));
        let steps = steps.map_err(told)?;
        tell(&format!("settled in {steps} steps"));
    }
    Ok(())
}

/// Puts the top of the box above the grains, or finds that they fit under it.
fn lower_the_top(scene: &Scene, system: &mut GrainSystem, top: usize) -> Result<(), DemError> {
    let (highest, given) = (system.highest(), &scene.r#box);
    let at = match (scene.start.headroom, given) {
        (Some(room), _) => highest + room,
        (None, Some(given)) if scene.start.rained.is_some() => given.high[2],
        _ => return Ok(()),
    };
    if highest > at {
        let above = "above the top of the box: give `start.headroom`";
        let message = format!("the grains lie {highest} m high, {above}");
        return Err(DemError::at("box.high", message));
    }
    system.walls[top].point.z = at;
    Ok(())
}

/// Volume of spheres, m³.
pub(crate) fn volume(radii: &[f64]) -> f64 {
    radii.iter().map(|r| sphere(*r)).sum()
}

/// Grains at their first places.
fn place(loaded: &Loaded) -> Result<Vec<Grain>, DemError> {
    let scene = &loaded.scene;
    let (start, seed) = (&scene.start, scene.grains.seed);
    let told = |e: GrainError| DemError::at("start", e);
    let density = scene.grains.density;
    if let Some(file) = &start.file {
        return from_file(loaded, file);
    }
    let [small, large] = scene.grains.radius.unwrap_or_default();
    let draw = |count: usize| uniform_radii(count, small, large, seed);
    let given = scene.r#box.as_ref();
    let (low, high) = given.map_or_else(Default::default, |b| (b.low, b.high));
    let size: [f64; 3] = std::array::from_fn(|k| high[k] - low[k]);
    let count = scene.grains.count.unwrap_or_default();
    if let Some(lattice) = &start.lattice {
        return Ok(lattice_of(scene, lattice, low, size));
    }
    if let Some(rained) = &start.rained {
        let mean = volume(&draw(10_000)) / 1e4;
        let solid = |height: f64| (1.0 - POURED) * size[0] * size[1] * height;
        let wanted = |height| (solid(height) / mean).round().max(1.0) as usize;
        let wanted = rained.height.map(wanted);
        let (radii, porosity) = (draw(wanted.unwrap_or(count)), rained.porosity);
        let grains = rain(low, [high[0], high[1]], &radii, density, porosity, seed);
        return grains.map_err(told);
    }
    let mut radii = draw(count);
    let mut cloud = Cloud::new(low, high);
    match &start.cloud {
        Some(part) => cloud = Cloud::new(part.low.unwrap_or(low), part.high.unwrap_or(high)),
        None => {
            let room = BEFORE_GROWTH * size.iter().product::<f64>();
            let factor = (room / volume(&radii)).cbrt();
            radii.iter_mut().for_each(|r| *r *= factor);
        }
    }
    let whole = start.cloud.as_ref().is_none_or(|c| c.low.is_none());
    for axis in given.iter().filter(|_| whole).flat_map(|b| &b.periodic) {
        cloud = cloud.periodic(axis.number());
    }
    cloud.grains(&radii, density, seed).map_err(told)
}

fn lattice_of(scene: &Scene, lattice: &Lattice, low: [f64; 3], size: [f64; 3]) -> Vec<Grain> {
    let [nx, ny, nz] = lattice.count.map(|n| n as usize);
    let [small, large] = scene.grains.radius.unwrap_or_default();
    let (count, seed) = (nx * ny * nz, scene.grains.seed);
    let radii = uniform_radii(count, small, large, seed);
    // Even numbers, drawn as radii are.
    let (jitter, of_shifts) = (lattice.jitter, seed.wrapping_add(1));
    let shifts = uniform_radii(3 * count, -jitter, jitter, of_shifts);
    let grain = |k: usize| {
        let cell = [k % nx, k / nx % ny, k / (nx * ny)];
        let at = std::array::from_fn(|axis| {
            let step = size[axis] / f64::from(lattice.count[axis]);
            low[axis] + step * (cell[axis] as f64 + 0.5 + shifts[3 * k + axis])
        });
        Grain::new(at, radii[k], scene.grains.density)
    };
    (0..count).map(grain).collect()
}

pub(crate) fn from_file(loaded: &Loaded, file: &str) -> Result<Vec<Grain>, DemError> {
    let key = "start.file";
    let path = loaded.resolve(key, file)?;
    let told = |why: String| DemError::at(key, format!("`{}`: {why}", path.display()));
    let text = scene_text::read_text(&path).map_err(told)?;
    let unit = loaded.scene.start.unit.as_deref();
    let factor = unit.map_or(Ok(1.0), |unit| unit_factor(unit, "m"));
    let factor = factor.map_err(|why| DemError::at("start.unit", why))?;
    let mut grains = Vec::new();
    for (line, row) in rows(&text) {
        let words = row.split(|c: char| c == ',' || c.is_whitespace());
        let words = words.filter(|w| !w.is_empty());
        let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
        let found = match numbers.as_deref() {
            Ok([x, y, z, r]) => {
                let at = [x, y, z].map(|c| factor * c);
                grains.push(Grain::new(at, factor * r, loaded.scene.grains.density));
                continue;
            }
            Ok(other) => format!("{} numbers", other.len()),
            Err(_) => format!("`{row}`"),
        };
        let problem = format!("line {line}: expected x y z r, found {found}");
        return Err(told(problem));
    }
    match grains.is_empty() {
        true => Err(told("holds no spheres".into())),
        false => Ok(grains),
    }
}

/// Strain of the box along z under the load of an oedometer when it comes dry and in parts that settle.
pub fn dry_strain(scene: &Scene, test: &Oedometer, grains: &GrainSystem) -> Result<f64, DemError> {
    let key = "oedometer";
    let told = |e: GrainError| DemError::at(key, e);
    let laws = Laws::from_scene(scene)?.all;
    let mut dry = GrainSystem::resume(grains.save(), laws).map_err(told)?;
    let wall = scene.planes().iter().position(|p| *p == test.wall);
    let piston = scene.wall.get(&test.wall).and_then(|w| w.piston.as_ref());
    let (Some(wall), Some(piston)) = (wall, piston) else {
        return Err(DemError::at(key, "has no piston"));
    };
    let height = |s: &GrainSystem| s.box_lengths().map_or(f64::NAN, |l| l[2]);
    let before = piston.prepared.unwrap_or(piston.stress);
    let mass = piston.mass_share * grains.grains.mass.iter().sum::<f64>();
    let (safety, most) = (0.8, scene.start.most_steps);
    for part in 1..=test.parts {
        let share = f64::from(part) / f64::from(test.parts);
        let stress = before + (piston.stress - before) * share;
        dry.walls[wall].control = Control::Piston { stress, mass };
        step_to_rest(&mut dry, safety, 1e-4, most).map_err(told)?;
    }
    step_to_rest(&mut dry, safety, 1e-6, most).map_err(told)?;
    Ok((height(grains) - height(&dry)) / height(grains))
}

/// The names of the walls and the lines of the grains that an error numbers, in brackets; empty if it has none.
pub fn named(loaded: &Loaded, error: &GrainError) -> String {
    let mut names = Vec::new();
    if let GrainError::InWall(_, wall, ..)
    | GrainError::BadWall(wall, _)
    | GrainError::TooDeep(_, _, Partner::Wall(wall), ..) = error
        && let Some(name) = loaded.scene.planes().get(*wall)
    {
        names.push(format!("wall {wall} is `{name}`"));
    }
    if let Some(file) = &loaded.scene.start.file {
        for grain in error.grains() {
            if let Some(line) = line(loaded, file, grain) {
                names.push(format!("grain {grain} is line {line} of `{file}`"));
            }
        }
    }
    match names.is_empty() {
        true => String::new(),
        false => format!(" ({})", names.join(", ")),
    }
}

/// Line of the file in which a grain stands, from 1.
fn line(loaded: &Loaded, file: &str, grain: usize) -> Option<usize> {
    let path = loaded.source.resolve("start.file", file).ok()?;
    let text = scene_text::read_text(&path).ok()?;
    rows(&text).nth(grain).map(|(line, _)| line)
}

/// Rows of a file of spheres with the numbers of their lines, from 1; without comments and empty lines.
pub fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().filter_map(|(line, row)| {
        let row = row.split('#').next().unwrap_or_default().trim();
        (!row.is_empty()).then_some((line + 1, row))
    })
}

/// The planes and surfaces of a scene, at rest; a top that comes down later is out of the way.
pub(crate) fn setup(loaded: &Loaded, grains: Vec<Grain>, laws: Laws) -> Result<Setup, DemError> {
    let scene = &loaded.scene;
    let law_of = |name: &str, otherwise| *laws.of_walls.get(name).unwrap_or(&otherwise);
    let mut setup = Setup {
        grains,
        laws: laws.all,
        gravity: scene.grains.gravity.unwrap_or_default().into(),
        damping: scene.start.damping,
        skin: scene.grains.skin,
        ..Setup::default()
    };
    let cuboid = scene.r#box.as_ref().map(|b| Wall::cuboid(b.low, b.high));
    for name in scene.planes() {
        let boxed = BOX.iter().position(|b| *b == name).zip(cuboid);
        let wall = match (boxed, scene.wall.get(&name)) {
            (Some((number, cuboid)), _) => cuboid[number].with_law(law_of(&name, laws.of_box)),
            (None, Some(table)) => {
                let [point, normal] = [table.point, table.normal].map(Option::unwrap_or_default);
                Wall::new(point, normal).with_law(law_of(&name, laws.of_others))
            }
            (None, None) => continue,
        };
        setup.walls.push(wall);
    }
    if let Some(given) = &scene.r#box {
        for axis in given.periodic.iter().map(|a| a.number()) {
            setup.period[axis] = Some([given.low[axis], given.high[axis]]);
        }
    }
    for (name, table) in scene.surfaces() {
        let mut mesh = surface(loaded, name, table)?;
        mesh.centre = table.point.unwrap_or_default().into();
        mesh.law = law_of(name, laws.of_others);
        setup.meshes.push(mesh);
    }
    Ok(setup)
}

/// The triangles of a file, scaled and shifted.
fn surface(loaded: &Loaded, name: &str, table: &tables::Wall) -> Result<Mesh, DemError> {
    let key = format!("wall.{name}.file");
    let file = loaded.resolve(&key, table.file.as_deref().unwrap_or_default())?;
    let read = scene_text::surface::read(&file);
    let corners = read.map_err(|e| DemError::at(&key, e))?.triangles;
    let unit = table.unit.as_deref().and_then(|u| unit_factor(u, "m").ok());
    let factor = table.scale.or(unit).unwrap_or(1.0);
    let shift = table.translate.unwrap_or_default();
    let placed = |x: &[f64; 3]| std::array::from_fn(|k| factor * x[k] + shift[k]);
    let vertices: Vec<[f64; 3]> = corners.iter().flatten().map(placed).collect();
    let triangles = (0..corners.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]);
    Ok(Mesh::new(vertices, triangles.collect()))
}

/// Control of a wall; pistons under their stress, with their share of the grains' mass (kg).
pub(crate) fn control(
    table: &tables::Wall,
    mass: f64,
    stress: impl Fn(&tables::Piston) -> f64,
) -> Control {
    if let Some(piston) = &table.piston {
        return Control::Piston {
            stress: stress(piston),
            mass: piston.mass_share * mass,
        };
    }
    if let Some(servo) = &table.servo {
        return Control::Stress {
            stress: servo.stress,
            largest_speed: servo.speed,
        };
    }
    if table.keeps_volume {
        return Control::Volume;
    }
    match table.strain_rate {
        Some(rate) => Control::StrainRate { rate },
        None => Control::Velocity,
    }
}
