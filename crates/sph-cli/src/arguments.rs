//! Arguments of the command line, and its help.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

use crate::tool_arguments::{DrawCommand, MeasureArguments, PluginArguments};

/// Smoothed particle hydrodynamics, and grains one by one, from scene files.
#[derive(Debug, Parser)]
#[command(
    name = "sph",
    version,
    propagate_version = true,
    after_help = "\
Examples:
  sph scenes                              what is there to run
  sph run dam-break-koshizuka             run a shipped scene into results/dam-break-koshizuka
  sph study poiseuille-order              what error in what time, over several variants
  sph new pool && sph check pool.toml     start a scene of your own
  sph plugins rheology                    what can stand in [phase.NAME.rheology.…]
  sph run grains-oedometer                grains one by one, and the fluid in their pores

Exit codes: 0 done, 1 the run failed or was interrupted, 2 bad usage or a bad scene \
(then nothing was written)."
)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene
    #[command(after_help = "\
Examples:
  sph run scenes/couette-2d.toml
  sph run pool.toml --set numerics.spacing='5 mm' --out results/fine --threads 4
  sph run pool.toml --out results/fine --set numerics.spacing='5 mm' --resume
  sph run pool.toml --from results/pool --set integrator.leap-frog={} --out results/other
  sph run pool.toml --resume --changed --set run.safety=0.5    go on after a failure with shorter steps

Leaves behind in DIR:
  pictures/*.png    pictures of the fields named in output.picture
  fields.pvd        fields over time, for ParaView (fields/*.vtu belong to it)
  series.csv        time, step, energies, momenta, extrema and probes
  summary.json      what the run was, what it cost, errors against the references
  checkpoint.sph    the last state, for --resume
  bad_state.vtu, bad_state.png, bad_state_near.png
                    after a failure: the state in which it failed; pictures of all of it and around
                    the particle at fault

Ctrl-C or SIGTERM writes a checkpoint and stops; a second one stops at once. A resumed run gives bit for \
bit what the uninterrupted one gives, also with another number of threads. --from takes the particles \
alone: other plugins, steps or materials go on from there.

Exit codes: 0 done, 1 failed or interrupted, 2 bad usage or a bad scene (nothing written).")]
    Run(RunArguments),
    /// Run variants of a scene: which error is reached in which time
    #[command(after_help = "\
Examples:
  sph study studies/poiseuille-order.toml
  sph study operators.toml --out results/operators --threads 4
  sph study operators.toml --only 'morris_*' --set run.end=0.1
  sph study --compare results/before/study.json results/after/study.json

A study file names a scene, what is varied and the error that is judged (docs/studies.md). \
Everything is checked before the first variant runs.

Leaves behind in DIR:
  report.html                  all of the following on one page
  study.json, study.csv        errors, wall seconds, steps, particles, limiters, orders
  error-against-time.*         work-precision plot with the Pareto line, SVG and PNG
  error-against-refinement.*   convergence with its orders, SVG and PNG
  variants/NAME/               summary.json, series.csv and the record of every variant

A variant that fails is recorded and the study goes on. Ctrl-C or SIGTERM stops with what is finished kept; \
the same command goes on from there, and runs nothing twice unless the scene or the program's \
version has changed.

Exit codes: 0 the study is complete (failed variants are results too) or compared, \
1 interrupted or a file cannot be written, 2 bad usage or a bad study (nothing written).")]
    Study(StudyArguments),
    /// Read, validate and assemble a scene without running it
    #[command(after_help = "\
Examples:
  sph check pool.toml
  sph check pool.toml --set numerics.spacing='1 mm' --threads 16    what would it cost?
  sph check pool.toml --picture pool.png                            does it look as it should?
  sph check tank.stl                                                what is in a file from CAD?

Prints what follows from the scene: smoothing length, speeds, dimensionless numbers, time steps, \
particles, and an estimate of time, memory and disk. Of an STL file: extent, facets, openings with their places, which \
way it faces. Writes nothing but the picture.

Exit codes: 0 the scene is good, 2 it is not.")]
    Check(CheckArguments),
    /// Show the parts of a scene: plugins, columns, stages, limits of the time step
    #[command(after_help = "\
Example:
  sph explain dam-break-koshizuka

A column or stage that is not listed does not exist in that scene and costs nothing. \
Writes nothing.")]
    Explain(ExplainArguments),
    /// List the plugins that scenes may name, with parameters, units and defaults
    #[command(after_help = "\
Examples:
  sph plugins                                all kinds with their plugins
  sph plugins rheology                       the plugins of one kind
  sph plugins integrator symplectic-euler    parameters, and a snippet for a scene
  sph plugins rheology bingham casson --picture laws.svg     the laws of their examples, drawn
  sph plugins rheology bingham --picture stronger.svg --vary yield_stress=[1,10,100]

A plugin of another crate appears here if the binary mentions the crate: `use my_plugin as _;`.")]
    Plugins(PluginArguments),
    /// Print the JSON schema of scenes, for completion in editors
    #[command(after_help = "\
Examples:
  sph schema > scene.schema.json
  sph schema --grains > grains.schema.json

Then put `#:schema scene.schema.json` into the first line of a scene; editors with a TOML \
language server (taplo, Even Better TOML) complete and check it.")]
    Schema {
        /// The schema of scenes of grains
        #[arg(long)]
        grains: bool,
    },
    /// List the shipped scenes
    #[command(after_help = "\
The scenes in ./scenes are listed if there are any, otherwise those compiled into the program.
Their names can be given to run, check, explain and new --from.")]
    Scenes {
        /// Print the gallery as a page of Markdown
        #[arg(long, conflicts_with = "json")]
        markdown: bool,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Write a commented starting scene
    #[command(after_help = "\
Examples:
  sph new pool                              writes pool.toml, a dam break in a box
  sph new pool --from hydrostatic-tank      writes pool.toml, a copy of a shipped scene
                                            (and the data files it is compared with)

Never overwrites a scene.")]
    New {
        /// Name of the scene; NAME.toml is written
        name: PathBuf,
        /// Start from this scene file or shipped scene
        #[arg(long, value_name = "SCENE")]
        from: Option<String>,
    },
    /// Compare two runs: whether they have the same bits, or where they differ most
    #[command(after_help = "\
Example:
  sph compare results/before results/after

Compares series.csv, all frames of fields.pvd and the checkpoints, particle by particle. Of every column \
that differs it has the largest difference with time, particle and place. Writes nothing.

Exit codes: 0 the same bits, 1 they differ, 2 there is nothing to compare.")]
    Compare {
        /// Folder of the results of a run
        #[arg(value_name = "A")]
        first: PathBuf,
        /// Folder of those of another
        #[arg(value_name = "B")]
        second: PathBuf,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Draw results that a run has not drawn: streamlines, profiles along a line, tracks of particles
    #[command(after_help = "\
Examples:
  sph draw streamlines results/cavity --out cavity.png
  sph draw profile results/poiseuille-2d --from 0.5,0 --to 0.5,1 --field velocity.x
  sph draw tracks results/dam-break-koshizuka --near 0.07,0.1 --near 0.14,0.28

Reads the frames of fields.pvd, also while the run goes on. Beside every picture a table of the same name is \
written. Between particles values are those of a linear fit, exact for linear fields.

Exit codes: 0 drawn, 1 a file cannot be written, 2 bad usage.")]
    #[command(subcommand)]
    Draw(DrawCommand),
    /// Measure a field of a run afterwards: extrema, means, sums, quantiles over chosen particles
    #[command(after_help = "\
Examples:
  sph measure results/dam-break-koshizuka x --reduce max
  sph measure results/soil-collapse-bui velocity --reduce max,rms --above x=0.2 --below y=50mm
  sph measure results/movable-bed-dambreak-sand y --quantile 0.99 --phase sand --out bed.csv
  sph measure results/bingham-poiseuille-bn0p1 velocity.x --along y --slice 5mm
  sph measure results/dam-break-koshizuka pressure --fit y --below x=50mm

A table with a row for every frame of fields.pvd, with --along for every slice of every frame. The field is a column \
of the frames, of a vector its length, a component (velocity.x), a coordinate (x, y, z), speed, kinetic_energy or \
potential_energy; energies need the column mass. In a scene the probe `statistic` does the same at every row of the \
series.

Exit codes: 0 measured, 1 the file cannot be written, 2 bad usage.")]
    Measure(MeasureArguments),
    /// Show the results of a run in a browser, also while it goes on
    #[command(after_help = "\
Example:
  sph view results/dam-break-koshizuka

Serves a page on 127.0.0.1, for this machine alone, until Ctrl-C: pictures over time, plots, columns of the \
series, errors and remarks. Writes nothing.")]
    View {
        /// Folder of the results of a run, which may be going on
        results: PathBuf,
        /// Port on 127.0.0.1; 0 for one that is free
        #[arg(long, default_value_t = 8377)]
        port: u16,
    },
    /// Print completions for a shell
    #[command(after_help = "\
Example:
  sph completions bash > ~/.local/share/bash-completion/completions/sph")]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print a manual page, or write those of all commands
    #[command(after_help = "\
Examples:
  sph man run | man -l -
  sph man --out ~/.local/share/man/man1")]
    Man {
        /// The command whose page is printed; that of `sph` if left out
        of: Option<String>,
        /// Write the pages of all commands into a folder instead
        #[arg(long, value_name = "DIR", conflicts_with = "of")]
        out: Option<PathBuf>,
    },
}

/// A scene with values put on top.
#[derive(Clone, Debug, Default, Args)]
pub struct SceneArguments {
    /// Scene file, or the name of a shipped scene (see `sph scenes`)
    pub scene: String,
    /// Put a value on top of the scene: --set numerics.spacing=0.01 (may be repeated)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Let the scene read files of a folder other than its own (may be repeated)
    #[arg(long, value_name = "DIR")]
    pub allow_path: Vec<PathBuf>,
}

/// Arguments of `sph run`.
#[derive(Clone, Debug, Default, Args)]
pub struct RunArguments {
    /// The scene
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Folder of the results [default: results/NAME of the scene file]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Divide the particles between so many ranks within this process: same results, as a trial of `mpirun`
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub ranks: Option<u16>,
    /// Go on from the checkpoint in the folder of the results
    #[arg(long)]
    pub resume: bool,
    /// Begin with the particles and the time of another run of the same bodies: its folder or checkpoint
    #[arg(long, value_name = "DIR", conflicts_with = "resume")]
    pub from: Option<PathBuf>,
    /// With --resume: go on although the scene or --set has changed since the checkpoint, for instance to mend a
    /// failure
    #[arg(long, requires = "resume")]
    pub changed: bool,
    /// Print summary.json on stdout; diagnostics as a JSON array if there are any
    #[arg(long)]
    pub json: bool,
    /// No progress and no summary
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `sph study`.
#[derive(Clone, Debug, Default, Args)]
pub struct StudyArguments {
    /// Study file, or the name of a shipped study
    #[arg(required_unless_present = "compare", conflicts_with = "compare")]
    pub study: Option<String>,
    /// Folder of the results [default: results/studies/NAME of the study file]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Run only variants whose names fit, with * and ? (may be repeated)
    #[arg(long, value_name = "PATTERN")]
    pub only: Vec<String>,
    /// Put a value on top of every variant: --set run.end=0.1 (may be repeated)
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Let the study and its scenes read files of a folder other than their own (may be repeated)
    #[arg(long, value_name = "DIR")]
    pub allow_path: Vec<PathBuf>,
    /// Run finished variants again
    #[arg(long)]
    pub fresh: bool,
    /// List the changes between two studies, given by their study.json
    #[arg(long, num_args = 2, value_names = ["A.json", "B.json"])]
    pub compare: Vec<PathBuf>,
    /// Print study.json, or the comparison, on stdout; diagnostics as a JSON array if there are any
    #[arg(long)]
    pub json: bool,
    /// No progress and no table
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `sph check`.
#[derive(Debug, Args)]
pub struct CheckArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Number of threads for the estimate [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Draw walls with ticks to the fluid's side, particles, open faces and probes into FILE.png
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
    /// Print the result, or the diagnostics as an array, as JSON on stdout
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `sph explain`.
#[derive(Debug, Args)]
pub struct ExplainArguments {
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Also the share of each of so many machines, and their messages
    #[arg(long, value_name = "N")]
    pub ranks: Option<std::num::NonZeroUsize>,
    /// Print the result, or the diagnostics as an array, as JSON on stdout
    #[arg(long)]
    pub json: bool,
}
