//! Arguments of the commands around a run.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand};
use serde::{Deserialize, Deserializer};
use sph_core::Axis;
use sph_probes::{Reduction, Weight};

/// Arguments of `sph measure`.
#[derive(Debug, Default, Args, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MeasureArguments {
    /// Folder of the results of a run
    pub results: PathBuf,
    /// The field, of a vector its length, or a component (velocity.x), or a coordinate (x, y, z), or speed,
    /// kinetic_energy, potential_energy
    pub field: String,
    /// Reductions of its values
    #[arg(long, value_name = "HOW,…", value_delimiter = ',')]
    #[arg(default_value = "mean", value_parser = named(&Reduction::ALL))]
    pub reduce: Vec<Reduction>,
    /// Shares q: the least value that a share q of the weight does not exceed
    #[arg(long, value_name = "Q,…", value_delimiter = ',', value_parser = share)]
    #[serde(deserialize_with = "shares")]
    pub quantile: Vec<f64>,
    /// The weight of a particle
    #[arg(long, default_value = "one", value_parser = named(&Weight::ALL))]
    pub weight: Weight,
    /// Name of the phase whose particles count [default: all]
    #[arg(long, value_name = "NAME")]
    pub phase: Option<String>,
    /// Only particles whose FIELD is above VALUE (may be repeated)
    #[arg(long, value_name = "FIELD=VALUE")]
    pub above: Vec<String>,
    /// Only particles whose FIELD is below VALUE (may be repeated)
    #[arg(long, value_name = "FIELD=VALUE")]
    pub below: Vec<String>,
    /// Fit a straight line to the values along an axis: its slope, the root mean square about it, its value at 0 m
    #[arg(long, value_name = "AXIS", conflicts_with = "along", value_parser = named(&AXES))]
    pub fit: Option<Axis>,
    /// A row for every slice across an axis: a profile
    #[arg(long, value_name = "AXIS", value_parser = named(&AXES))]
    pub along: Option<Axis>,
    /// Width of the slices, m [default: two spacings of the particles in the first frame]
    #[arg(long, value_name = "WIDTH", requires = "along")]
    pub slice: Option<String>,
    /// Gravity, m/s², which potential_energy needs
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
    pub gravity: Option<String>,
    /// Write the table into FILE.csv
    #[arg(long, value_name = "FILE")]
    #[serde(skip)]
    pub out: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    #[serde(skip)]
    pub json: bool,
}

const AXES: [(Axis, &str); 3] = [(Axis::X, "x"), (Axis::Y, "y"), (Axis::Z, "z")];

/// One of some values by its name.
fn named<T: Copy + Default + Send + Sync + 'static>(
    all: &'static [(T, &'static str)],
) -> impl TypedValueParser<Value = T> {
    let names = PossibleValuesParser::new(all.iter().map(|(_, name)| *name));
    let of = move |given| all.iter().find(|(_, name)| *name == given);
    // The parser knows the names.
    names.map(move |given| of(given).map_or_else(T::default, |(one, _)| *one))
}

fn share(text: &str) -> Result<f64, String> {
    let share: f64 = text.parse().map_err(|_| "expected a number".to_string())?;
    match (0.0..=1.0).contains(&share) {
        true => Ok(share),
        false => Err("expected a share from 0 to 1".into()),
    }
}

fn shares<'d, D: Deserializer<'d>>(from: D) -> Result<Vec<f64>, D::Error> {
    let all = Vec::<f64>::deserialize(from)?.into_iter();
    let checked = all.map(|q| share(&q.to_string()));
    checked
        .collect::<Result<_, _>>()
        .map_err(serde::de::Error::custom)
}

/// Arguments of `sph plugins`.
#[derive(Debug, Args)]
pub struct PluginArguments {
    /// Kind of plugin, for example `kernel` or `rheology`
    pub kind: Option<String>,
    /// Name of a plugin of that kind; several to have them in one picture
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// Draw into FILE.svg or FILE.png: stress and viscosity of a law sheared alone, or a kernel and its slope
    #[arg(long, value_name = "FILE", requires = "names")]
    pub picture: Option<PathBuf>,
    /// Put a value on top of the law's example: --set yield_stress='5 Pa', or with several laws
    /// --set bingham.yield_stress='5 Pa' (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "picture")]
    pub set: Vec<String>,
    /// Draw a curve for each value of a list: --vary yield_stress=[1,10,100]
    #[arg(long, value_name = "KEY=[…]", requires = "picture")]
    pub vary: Option<String>,
    /// Pressures at which a law with friction is sheared [default: 1 kPa]
    #[arg(long, value_name = "P,…", value_delimiter = ',')]
    #[arg(requires = "picture", allow_hyphen_values = true)]
    pub pressure: Vec<String>,
    /// The ends of the axis [default: 0.001,100], or for a law with an elastic part the rates at
    /// which it is sheared from rest [default: 0.01,0.1,1,10], 1/s
    #[arg(long, value_name = "RATE,…", value_delimiter = ',')]
    #[arg(requires = "picture", allow_hyphen_values = true)]
    pub strain_rates: Vec<String>,
    /// Strain up to which a law with an elastic part is sheared [default: four times that at which it
    /// yields, 2 at most]
    #[arg(long, requires = "picture", allow_hyphen_values = true)]
    pub strain: Option<f64>,
    /// Print all plugins as a page of Markdown
    #[arg(long, conflicts_with_all = ["kind", "json"])]
    pub markdown: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Drawings of `sph draw`.
#[derive(Debug, Subcommand)]
pub enum DrawCommand {
    /// Lines along the velocity of one moment, over a field
    Streamlines(StreamlineArguments),
    /// A field along a straight line, at one time or at several
    Profile(ProfileArguments),
    /// Paths of single particles
    Tracks(TrackArguments),
}

/// Arguments of `sph draw streamlines`.
#[derive(Debug, Args)]
pub struct StreamlineArguments {
    /// Folder of the results of a run
    pub results: PathBuf,
    /// The picture, FILE.png; the points of the lines go to FILE.csv
    #[arg(long, value_name = "FILE", default_value = "streamlines.png")]
    pub out: PathBuf,
    /// Time of the frame, s, or the one nearest to it [default: the last]
    #[arg(long)]
    pub time: Option<String>,
    /// Field that gives the colours
    #[arg(long, default_value = "speed")]
    pub field: String,
    /// Distance between lines, m [default: a 40th of the longer side]
    #[arg(long)]
    pub apart: Option<String>,
    /// In space: the slice y that is shown, m [default: the middle]
    #[arg(long, allow_hyphen_values = true)]
    pub slice: Option<String>,
}

/// Arguments of `sph draw profile`.
#[derive(Debug, Args)]
pub struct ProfileArguments {
    /// Folder of the results of a run
    pub results: PathBuf,
    /// Start of the line, m
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
    pub from: String,
    /// End of the line, m
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
    pub to: String,
    /// The field, of a vector its length, or a component: velocity.x
    #[arg(long, default_value = "speed")]
    pub field: String,
    /// Times of the frames, s, or those nearest to them [default: the last]
    #[arg(long, value_name = "T,…", value_delimiter = ',')]
    pub time: Vec<String>,
    /// Points on the line
    #[arg(long, default_value_t = 101, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub points: u32,
    /// The picture, FILE.png or FILE.svg; the values go to FILE.csv
    #[arg(long, value_name = "FILE", default_value = "profile.png")]
    pub out: PathBuf,
}

/// Arguments of `sph draw tracks`.
#[derive(Debug, Args)]
pub struct TrackArguments {
    /// Folder of the results of a run
    pub results: PathBuf,
    /// Particles by their identity [default: those of --near, or --count of them]
    #[arg(long, value_name = "N,…", value_delimiter = ',')]
    #[arg(conflicts_with = "count")]
    pub identity: Vec<u32>,
    /// The particle that is nearest to a place in the first frame, m (may be repeated)
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true)]
    #[arg(conflicts_with = "count")]
    pub near: Vec<String>,
    /// Number of particles, evenly spread over the identities
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub count: u32,
    /// Field of the last frame that gives the colours
    #[arg(long, default_value = "speed")]
    pub field: String,
    /// The picture, FILE.png; the places go to FILE.csv
    #[arg(long, value_name = "FILE", default_value = "tracks.png")]
    pub out: PathBuf,
}
