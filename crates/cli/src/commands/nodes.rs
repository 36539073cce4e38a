//! `halfvector nodes`: the node library.

use halfvector_graph::docs;
use halfvector_graph::library::Library;

use crate::failure::Failure;
use crate::output::{print, print_json};

/// Lists the nodes that materials are made of.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:\n  halfvector nodes --format json | jq '.nodes[].id'")]
pub(crate) struct NodesArgs {
    /// How the list is written.
    #[arg(long, value_enum, default_value_t)]
    format: ListFormat,
}

/// How a list is written.
#[derive(clap::ValueEnum, Clone, Copy, Debug, Default)]
pub(crate) enum ListFormat {
    /// Markdown
    #[default]
    Md,
    /// One JSON object
    Json,
}

/// Runs the command.
pub(crate) fn run(args: &NodesArgs) -> Result<u8, Failure> {
    let library = Library::standard();
    match args.format {
        ListFormat::Md => print(&docs::nodes_markdown(library))?,
        ListFormat::Json => print_json(&docs::nodes_json(library))?,
    }
    Ok(0)
}
