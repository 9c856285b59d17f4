//! Profiles averaged along homogeneous directions and in time.

use std::sync::{Mutex, MutexGuard};

use sph_core::{Axis, StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::measure::particles::AXES;
use crate::measure::quantity::Quantity;
use crate::norm::at;
use crate::{Curves, Gathers, Needs, Probe, ProbeColumn, ProbeEntry};

/// Means and root mean squares of the fluctuations in layers across an axis, over all particles of a layer and all rows of the
/// series from a time on: ⟨f⟩ = Σ V f/Σ V and √(⟨f²⟩ − ⟨f⟩²), f being a component of the velocity or a scalar field.
///
/// Its curve has every component's, and −⟨u'w'⟩, u along the first axis and w along the axis of the profile. Where the flow is the
/// same along an axis, as along a periodic one, no other key is needed; `within` is for the others. A layer's distance is the
/// mean of its particles, so that a mean of a linear profile lies on it wherever rows stand in their layers; there it is compared
/// with a `file` of distances and values. A resumed run goes on with the gathered values.
///
/// Source: Issa 2004, Eq. 6.46–6.50, with layers in the place of points.
///
/// ```toml
/// [probe.means]
/// kind = "mean-profile"
/// axis = "y"
/// from = 0.0
/// to = "0.4 m"
/// layers = 40
/// after = "20 s"
/// ```
#[plugin(ProbeEntry [2, 3], "mean-profile", "means and root mean squares over time and along homogeneous directions",
    source: "Issa 2004, Eq. 6.46–6.50")]
pub struct MeanProfile {
    /// The axis that layers are cut across.
    pub axis: Axis,
    /// Start of the first layer.
    #[parameter(unit: "m")]
    pub from: f64,
    /// End of the last layer.
    #[parameter(unit: "m")]
    pub to: f64,
    /// Number of layers.
    #[parameter(min: 1, max: 10000)]
    pub layers: usize,
    /// The time from which rows of the series count.
    #[parameter(default, unit: "s")]
    pub after: f64,
    /// Two corners of a box outside of which particles do not count.
    pub within: Option<[Vec<f64>; 2]>,
    /// A quantity in the place of the velocity: a scalar field, or `pressure_acceleration.x`.
    pub field: Option<String>,
    /// Component of the velocity that is compared.
    #[parameter(default)]
    pub component: Axis,
    /// CSV file of the reference, relative to the scene's folder: distance from `from` in m, value in SI.
    pub file: Option<String>,
    /// The distances from `from` between which it is compared; all if left out.
    #[parameter(unit: "m")]
    pub compared: Option<[f64; 2]>,
    #[serde(skip)]
    reference: Vec<[f64; 2]>,
    /// Σ V, Σ V f and Σ V f² of every component, Σ V u w, and Σ V z of the distance, layer by layer.
    #[serde(skip)]
    sums: Mutex<Vec<f64>>,
}

type Reader<'a> = Box<dyn Fn(usize, &mut Vec<f64>) + 'a>;

impl MeanProfile {
    fn components<const D: usize>(&self) -> usize {
        if self.field.is_some() { 1 } else { D }
    }

    fn stride<const D: usize>(&self) -> usize {
        3 + 2 * self.components::<D>()
    }

    /// Mean distance of the particles of a layer from `from`, m; the middle of an empty one.
    fn distance(&self, layer: usize, sums: &[f64], components: usize) -> f64 {
        match sums[0] > 0.0 {
            true => sums[2 + 2 * components] / sums[0],
            false => (self.to - self.from) * (layer as f64 + 0.5) / self.layers as f64,
        }
    }

    /// The layer of a place, if it is in one.
    fn layer<const D: usize>(&self, x: &Vect<D>) -> Option<usize> {
        if let Some([low, high]) = &self.within {
            let out = |k: usize| x[k] < low[k] || x[k] >= high[k];
            if (0..D.min(low.len()).min(high.len())).any(out) {
                return None;
            }
        }
        let share = (x[self.axis as usize] - self.from) / (self.to - self.from);
        let layer = || ((share * self.layers as f64) as usize).min(self.layers - 1);
        (0.0..1.0).contains(&share).then(layer)
    }

    fn reader<'a, const D: usize>(&self, world: &'a World<D>) -> Result<Reader<'a>, StepError> {
        let Some(name) = &self.field else {
            let velocity = world.free.get(fields::VELOCITY)?;
            return Ok(Box::new(move |i, into| into.extend(velocity[i].iter())));
        };
        let (value, _) = Quantity::named(name).values(world)?;
        Ok(Box::new(move |i, into| into.push(value(i))))
    }

    fn sums(&self) -> Result<MutexGuard<'_, Vec<f64>>, StepError> {
        self.sums.lock().map_err(|_| refused("a thread failed"))
    }

    fn check<const D: usize>(&self) -> Result<(), StepError> {
        let grows = self.to > self.from && self.to.is_finite() && self.from.is_finite();
        Err(refused(match self.layers {
            _ if self.axis as usize >= D => "this scene has no such `axis`",
            _ if !grows => "`to` is to be larger than `from`",
            0 => "one layer at least was expected",
            _ => return Ok(()),
        }))
    }

    /// Means and root mean squares of all components, and −⟨u'w'⟩, of a layer; NaN where nothing was.
    fn of_layer(&self, sums: &[f64], components: usize) -> [Vec<f64>; 3] {
        let weight = sums[0];
        let mean = |k: usize| sums[1 + k] / weight;
        let square = |k: usize| sums[1 + components + k] / weight;
        let means: Vec<f64> = (0..components).map(mean).collect();
        let fluctuation = |k: usize| (square(k) - means[k] * means[k]).max(0.0).sqrt();
        let fluctuations = (0..components).map(fluctuation).collect();
        let axis = (self.axis as usize).min(components - 1);
        let stress = means[0] * means[axis] - sums[1 + 2 * components] / weight;
        match weight > 0.0 {
            true => [means, fluctuations, vec![stress]],
            false => [components, components, 1].map(|count| vec![f64::NAN; count]),
        }
    }

    fn expected(&self, distance: f64) -> Option<f64> {
        let rows = self.reference.iter().map(|[place, value]| (*place, *value));
        let (places, values): (Vec<f64>, Vec<f64>) = rows.unzip();
        at(&places, &values, distance)
    }

    /// Mean and reference of the layers that are compared.
    fn compared(&self, sums: &[f64], components: usize) -> Vec<[f64; 2]> {
        let [low, high] = self.compared.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let component = (self.component as usize).min(components - 1);
        let layers = sums.chunks(3 + 2 * components).enumerate();
        let placed = layers.map(|(k, sums)| (self.distance(k, sums, components), sums));
        let inside = placed.filter(|(distance, _)| (low..=high).contains(distance));
        let both = inside.filter_map(|(distance, sums)| {
            let [means, ..] = self.of_layer(sums, components);
            Some([means[component], self.expected(distance)?])
        });
        both.filter(|[u, _]| u.is_finite()).collect()
    }
}

fn refused(reason: &str) -> StepError {
    StepError::stage("probe `mean-profile`", reason)
}

impl<const D: usize> Probe<D> for MeanProfile {
    fn columns(&self) -> Vec<ProbeColumn> {
        match self.file {
            Some(_) => {
                ProbeColumn::several(&[(".rms", "SI"), (".largest", "SI"), (".relative", "1")])
            }
            None => vec![ProbeColumn::named(".layers", "1")],
        }
    }

    fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    fn load_reference(&mut self, rows: Vec<[f64; 2]>) -> Result<(), String> {
        let finite = rows.iter().flatten().all(|v| v.is_finite());
        let grows = rows.windows(2).all(|w| w[0][0] < w[1][0]);
        if rows.len() < 2 || !finite || !grows {
            return Err("is no profile: expected rows of a growing distance and a value".into());
        }
        self.reference = rows;
        Ok(())
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            fields: {
                (self.field.iter())
                    .filter_map(|name| Quantity::named(name).column().map(String::from))
                    .collect()
            },
            ..Needs::default()
        }
    }

    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        Some(self)
    }

    fn as_gathers(&self) -> Option<&dyn Gathers<D>> {
        Some(self)
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        self.check::<D>()?;
        drop(self.reader(world)?);
        let sums = self.sums()?;
        let components = self.components::<D>();
        if self.file.is_none() {
            let filled = sums.chunks(self.stride::<D>()).filter(|s| s[0] > 0.0);
            return Ok(vec![filled.count() as f64]);
        }
        let rows = self.compared(&sums, components);
        if rows.is_empty() {
            return Ok(vec![f64::NAN; 3]);
        }
        let squares: f64 = rows.iter().map(|[u, e]| (u - e).powi(2)).sum();
        let largest = rows.iter().map(|[u, e]| (u - e).abs()).fold(0.0, f64::max);
        let shares = rows.iter().map(|[u, e]| ((u - e) / e).abs());
        let relative = shares.fold(0.0, f64::max);
        let rms = (squares / rows.len() as f64).sqrt();
        Ok(vec![rms, largest, relative])
    }
}

impl<const D: usize> Curves<D> for MeanProfile {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let mut all = vec![ProbeColumn::named("distance", "m")];
        let of = |what: &str, k: usize| match self.field {
            Some(_) => ProbeColumn::named(what, "SI"),
            None => ProbeColumn::named(&format!("{what}.{}", AXES[k]), "m/s"),
        };
        let components = self.components::<D>();
        all.extend((0..components).map(|k| of("mean", k)));
        all.extend((0..components).map(|k| of("rms", k)));
        if self.field.is_none() {
            all.push(ProbeColumn::named("stress", "m²/s²"));
        }
        if self.file.is_some() {
            all.push(ProbeColumn::named("reference", "SI"));
        }
        all
    }

    fn curves(&self, _: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        let sums = self.sums()?;
        let (stride, components) = (self.stride::<D>(), self.components::<D>());
        let empty = vec![0.0; stride];
        let row = |k: usize| {
            let sums = sums.get(k * stride..(k + 1) * stride).unwrap_or(&empty);
            let [means, fluctuations, stress] = self.of_layer(sums, components);
            let distance = self.distance(k, sums, components);
            let mut row = vec![distance];
            row.extend(means);
            row.extend(fluctuations);
            if self.field.is_none() {
                row.extend(stress);
            }
            if self.file.is_some() {
                row.push(self.expected(distance).unwrap_or(f64::NAN));
            }
            row
        };
        Ok((0..self.layers).map(row).collect())
    }
}

impl<const D: usize> Gathers<D> for MeanProfile {
    fn gather(&self, world: &World<D>) -> Result<(), StepError> {
        if world.time < self.after {
            return Ok(());
        }
        let mut sums = self.sums()?;
        let (stride, components) = (self.stride::<D>(), self.components::<D>());
        sums.resize(self.layers * stride, 0.0);
        let (positions, volumes) = world.free.all((fields::POSITION, fields::VOLUME))?;
        let read = self.reader(world)?;
        let mut values = Vec::new();
        for (i, x) in positions.iter().enumerate() {
            let Some(layer) = self.layer(x) else {
                continue;
            };
            values.clear();
            read(i, &mut values);
            let sums = &mut sums[layer * stride..(layer + 1) * stride];
            sums[0] += volumes[i];
            for (k, value) in values.iter().enumerate() {
                sums[1 + k] += volumes[i] * value;
                sums[1 + components + k] += volumes[i] * value * value;
            }
            let axis = (self.axis as usize).min(components - 1);
            sums[1 + 2 * components] += volumes[i] * values[0] * values[axis];
            sums[2 + 2 * components] += volumes[i] * (x[self.axis as usize] - self.from);
        }
        Ok(())
    }

    fn gathered(&self) -> Vec<u64> {
        let sums = self.sums.lock();
        sums.map_or(Vec::new(), |s| s.iter().map(|v| v.to_bits()).collect())
    }

    fn recall(&self, gathered: &[u64]) {
        // Values gathered by another scene are of other layers.
        let fits = gathered.len() == self.layers * self.stride::<D>();
        if let (true, Ok(mut sums)) = (fits, self.sums.lock()) {
            *sums = gathered.iter().map(|v| f64::from_bits(*v)).collect();
        }
    }
}
