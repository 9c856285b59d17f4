//! `study.json`: all that came out of a study.

pub mod compare;
pub mod scaling;
pub mod variant_result;

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use sph_core::comma_list;

use crate::results::variant_result::pareto;
use crate::{
    Frontier, MeansPlot, Orders, Origin, Record, Scale, SeriesResult, Study, Variant, VariantResult,
};

/// Version of the layout of `study.json`.
pub const SCHEMA_VERSION: u32 = 1;

/// All that came out of a study.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Results {
    pub(crate) schema_version: u32,
    pub(crate) study: String,
    /// Title of the study.
    pub title: String,
    pub(crate) description: Option<String>,
    pub(crate) scene: String,
    pub(crate) definition: String,
    /// Settings put on top of every variant, as of `--set`.
    pub(crate) set: Vec<String>,
    /// Judged errors, the first one by plots.
    pub(crate) errors: Vec<String>,
    pub(crate) axes: Vec<String>,
    /// Key over which orders are computed.
    pub(crate) refinement: Option<String>,
    /// References whose means are plotted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) means: Option<MeansPlot>,
    /// True if variants ran one by one.
    pub(crate) serial: bool,
    /// Machine and program of the last run.
    #[serde(flatten)]
    pub origin: Origin,
    /// Range of each axis, of studies that go along axes until they break.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frontiers: Vec<Frontier>,
    /// Variants in the order of the study.
    pub variants: Vec<VariantResult>,
    /// Variants that differ in their refinement only.
    pub series: Vec<SeriesResult>,
    /// Variants that no other one beats in both error and time, fastest first.
    pub(crate) pareto: Vec<String>,
    /// Costs against the number of particles, of studies that have them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
}

impl Results {
    /// The results of a study from one record per variant.
    pub fn new(study: &Study, records: &[Record], origin: Origin) -> Self {
        let axes: Vec<String> = study.axes.iter().map(|a| a.name.clone()).collect();
        let variants = study.variants.iter().zip(records);
        let judge = |v: &Variant| v.rung.map(|r| &study.ladders[r.ladder].frontier.judge);
        let variants = variants.map(|(v, record)| VariantResult::new(v, record, judge(v), &axes));
        let variants = variants.collect();
        let mut results = Results {
            schema_version: SCHEMA_VERSION,
            study: study.name.clone(),
            title: study.file.title.clone(),
            description: study.file.description.clone(),
            scene: study.scene.clone(),
            definition: study.source.text().to_string(),
            set: study.set.clone(),
            errors: study.errors.clone(),
            refinement: study.refinement.clone(),
            means: study.file.means.clone(),
            serial: study.file.serial,
            origin,
            frontiers: Vec::new(),
            variants,
            axes,
            series: Vec::new(),
            pareto: Vec::new(),
            scale: None,
        };
        if !study.ladders.is_empty() {
            results.frontiers = Frontier::all(study, &results.variants);
            return results;
        }
        results.series = results.make_series(study);
        results.note_orders();
        results.pareto = results.make_pareto();
        results.scale = results.make_scale(study);
        results
    }

    /// The variant of that name.
    pub fn variant(&self, name: &str) -> Option<&VariantResult> {
        self.variants.iter().find(|v| v.name == name)
    }

    /// The error by which plots judge.
    pub fn judged(&self) -> &str {
        self.errors.first().map_or("", String::as_str)
    }

    /// Numbers of threads of the variants that have run.
    pub fn threads(&self) -> String {
        let ran = self.variants.iter().filter(|v| v.size.threads > 0);
        let all: BTreeSet<usize> = ran.map(|v| v.size.threads).collect();
        comma_list(all)
    }

    fn make_series(&self, study: &Study) -> Vec<SeriesResult> {
        let key = self.refinement.as_deref();
        let refining = |k: usize| key.is_some_and(|key| study.axes[k].touches(key));
        let mut series: Vec<SeriesResult> = Vec::new();
        for (variant, result) in study.variants.iter().zip(&self.variants) {
            let labels = variant.labels.iter().enumerate();
            let others = labels.filter(|(k, _)| !refining(*k));
            let name = comma_list(others.map(|(_, label)| label));
            match series.iter_mut().find(|s| s.name == name) {
                Some(found) => found.variants.push(result.name.clone()),
                None => series.push(SeriesResult {
                    name,
                    variants: vec![result.name.clone()],
                    orders: BTreeMap::new(),
                }),
            }
        }
        for one in &mut series {
            let of = |name: &String| self.variant(name).and_then(|v| v.refinement);
            one.variants
                .sort_by(|a, b| of(b).unwrap_or(0.0).total_cmp(&of(a).unwrap_or(0.0)));
            if key.is_some() {
                let orders = self.errors.iter().map(|error| {
                    let points = self.convergence(&one.variants, error);
                    let points: Vec<_> = points.into_iter().map(|(_, p)| p).collect();
                    (error.clone(), Orders::from_points(&points))
                });
                one.orders = orders.collect();
            }
        }
        series
    }

    /// Refinement and error of those variants that have both, with their names.
    pub fn convergence(&self, variants: &[String], error: &str) -> Vec<(String, [f64; 2])> {
        let point = |name: &String| {
            let variant = self.variant(name)?;
            let e = variant.error(error).filter(|e| *e > 0.0)?;
            Some((name.clone(), [variant.refinement?, e]))
        };
        variants.iter().filter_map(point).collect()
    }

    fn note_orders(&mut self) {
        if self.refinement.is_none() {
            return;
        }
        let mut found = BTreeMap::new();
        for series in &self.series {
            for pair in self.convergence(&series.variants, self.judged()).windows(2) {
                let orders = Orders::from_points(&[pair[0].1, pair[1].1]);
                found.insert(pair[1].0.clone(), orders.main());
            }
        }
        for variant in &mut self.variants {
            variant.order = found.get(&variant.name).copied().flatten();
            variant.order = variant.order.filter(|o| o.is_finite());
        }
    }

    fn make_scale(&self, study: &Study) -> Option<Scale> {
        let scaling = study.file.scaling.as_ref()?;
        let key = self.refinement.as_deref();
        let others = study.axes.iter().filter(|axis| {
            let refines = key.is_some_and(|key| axis.touches(key));
            !refines && scaling.between.as_ref() != Some(&axis.name)
        });
        let others: Vec<&str> = others.map(|axis| axis.name.as_str()).collect();
        Some(Scale::new(scaling, self, &others))
    }

    fn make_pareto(&self) -> Vec<String> {
        let points = self.variants.iter().filter_map(|v| {
            let error = v.error(self.judged())?;
            Some((v.name.clone(), [v.wall_seconds.min?, error]))
        });
        pareto(points.collect())
    }
}
