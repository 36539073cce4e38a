//! The program `halfvector`: the command line, and nothing of the work itself.

mod backend;
mod budget;
mod commands;
mod environment;
mod failure;
mod harmonics_file;
mod input;
mod output;
mod picture_file;
mod reference;
mod set_value;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::commands::{bake, check, compare, edit, export, methods, nodes, render, report};

/// Materials as node graphs: draw them, take their shaders, check them.
///
/// Without a command it opens the editor; with no display it draws an embedded example to the folder out/ instead.
#[derive(Parser, Debug)]
#[command(
    name = "halfvector",
    version,
    after_help = "Example:
  halfvector render examples/surface.material.json --set metallic=1 -o metal.png

Exit codes: 0 done, 1 the input is wrong, 2 the command line is wrong, 3 `check` or\n\
`report --compare` found something, 130 `report` was interrupted."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand, Debug)]
enum Command {
    Render(Box<render::RenderArgs>),
    Export(export::ExportArgs),
    Check(check::CheckArgs),
    Compare(compare::CompareArgs),
    Edit(edit::EditArgs),
    Bake(Box<bake::BakeArgs>),
    Nodes(nodes::NodesArgs),
    Methods(methods::MethodsArgs),
    Report(report::ReportArgs),
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = match &cli.command {
        None => edit::run_or_draw(),
        Some(Command::Render(args)) => render::run(args),
        Some(Command::Export(args)) => export::run(args),
        Some(Command::Check(args)) => check::run(args),
        Some(Command::Compare(args)) => compare::run(args),
        Some(Command::Edit(args)) => edit::run(args),
        Some(Command::Bake(args)) => bake::run(args),
        Some(Command::Nodes(args)) => nodes::run(args),
        Some(Command::Methods(args)) => methods::run(args),
        Some(Command::Report(args)) => report::run(args),
    };
    match result {
        Ok(code) => ExitCode::from(code),
        Err(failure) => {
            output::note(&failure);
            ExitCode::from(failure.code)
        }
    }
}
