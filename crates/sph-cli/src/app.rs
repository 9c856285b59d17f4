//! From the arguments to the subcommand, and from its result to the exit code.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};
use crate::commands::{
    check, compare, draw, explain, manual, measure, new, plugins, run, scenes, study, view,
};
use crate::ranks;
use crate::terminal::console;

/// Runs the command that the process was called with.
///
/// Exit codes: 0 done, 1 the run failed or was interrupted, 2 bad usage or a bad scene.
pub fn main() -> ExitCode {
    let _joined = ranks::join();
    ExitCode::from(command_line(std::env::args_os()))
}

/// Runs the command with these arguments, of which the first is the name of the program; its exit code.
pub fn command_line<A: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = A>) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(refused) => {
            // Help and version are no errors; a closed pipe is none of ours.
            let _ = refused.print();
            return u8::try_from(refused.exit_code()).unwrap_or(2);
        }
    };
    if !ranks::is_first() && !matches!(arguments.command, Command::Run(_)) {
        return 0;
    }
    // Whether errors go to stdout as JSON, and the end of the command.
    let (json, done) = match arguments.command {
        Command::Run(a) => (a.json, run::command(&a)),
        Command::Study(a) => (a.json, study::command(&a)),
        Command::Check(a) => (a.json, check::command(&a)),
        Command::Explain(a) => (a.json, explain::command(&a)),
        Command::Plugins(a) => (a.json, plugins::command(&a)),
        Command::Schema { grains } => (false, scenes::schema(grains)),
        Command::Scenes { markdown, json } => (json, scenes::command(markdown, json)),
        Command::New { name, from } => (false, new::command(&name, from.as_deref())),
        Command::Compare {
            first,
            second,
            json,
        } => (json, compare::command(&first, &second, json)),
        Command::Draw(a) => (false, draw::command(&a)),
        Command::Measure(a) => (a.json, measure::command(&a)),
        Command::View { results, port } => (false, view::command(&results, port)),
        Command::Completions { shell } => (false, manual::completions(shell)),
        Command::Man { of, out } => (false, manual::man(of.as_deref(), out.as_deref())),
    };
    match done {
        Ok(()) => u8::from(!console::complete()),
        Err(trouble) => {
            if ranks::is_first() {
                trouble.report(json);
            }
            trouble.exit_code()
        }
    }
}
