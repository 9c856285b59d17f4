//! From the arguments to the subcommand, and from its result to the exit code.

use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};
use crate::{check, console, explain, new, plugins, run, scenes, schema, study};

/// Runs the command that the process was called with.
///
/// Exit codes: 0 done, 1 the run failed or was interrupted, 2 bad usage or a bad scene.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refused) => {
            // Help and version are no errors; a closed pipe is none of ours.
            let _ = refused.print();
            return ExitCode::from(u8::try_from(refused.exit_code()).unwrap_or(2));
        }
    };
    let json = arguments.command.json();
    let done = match &arguments.command {
        Command::Run(a) => run::command(a),
        Command::Study(a) => study::command(a),
        Command::Check(a) => check::command(a),
        Command::Explain(a) => explain::command(a),
        Command::Plugins(a) => plugins::command(a),
        Command::Schema(a) => schema::command(a),
        Command::Scenes(a) => scenes::command(a),
        Command::New(a) => new::command(a),
    };
    match done {
        Ok(()) => ExitCode::from(u8::from(!console::complete())),
        Err(trouble) => {
            trouble.report(json);
            ExitCode::from(trouble.exit_code())
        }
    }
}
