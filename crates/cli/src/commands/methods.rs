//! `halfvector methods`: the terms of shading that have a choice, and the choices; the options that choose.

use halfvector_graph::docs;
use halfvector_graph::method::Methods;

use crate::failure::Failure;
use crate::output::{print, print_json};

/// Lists the methods that --method chooses from.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:\n  halfvector methods --format json")]
pub(crate) struct MethodsArgs {
    /// How the list is written.
    #[arg(long, value_enum, default_value_t)]
    format: super::nodes::ListFormat,
}

/// Runs the command.
pub(crate) fn run(args: &MethodsArgs) -> Result<u8, Failure> {
    match args.format {
        super::nodes::ListFormat::Md => print(&docs::methods_markdown())?,
        super::nodes::ListFormat::Json => print_json(&docs::methods_json())?,
    }
    Ok(0)
}

/// The options that choose methods, shared by commands.
#[derive(clap::Args, Debug)]
pub(crate) struct MethodChoice {
    /// Chooses the method of a term of shading; may be given several times; `halfvector methods` lists them
    #[arg(long, value_name = "TERM=NAME", value_parser = parse_method)]
    method: Vec<[String; 2]>,
    /// Where the choice starts: default, or the forms of the report that started the project
    #[arg(long, value_enum, value_name = "NAME")]
    preset: Option<Preset>,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Preset {
    /// The first method of each term
    Default,
    /// The report's own forms
    Report,
}

impl MethodChoice {
    /// The terms that have a method by name.
    pub(crate) fn terms(&self) -> Vec<&str> {
        self.method.iter().map(|[term, _]| term.as_str()).collect()
    }

    /// Replaces what was chosen on the command line.
    pub(crate) fn apply(&self, methods: &mut Methods) {
        match self.preset {
            None => {}
            Some(Preset::Default) => *methods = Methods::default(),
            Some(Preset::Report) => *methods = Methods::report(),
        }
        for [term, name] in &self.method {
            // The names were looked up when they were read.
            let _ = methods.set(term, name);
        }
    }
}

fn parse_method(text: &str) -> Result<[String; 2], String> {
    let (term, name) = text.split_once('=').ok_or("write TERM=NAME, such as v=separable")?;
    Methods::default().set(term, name).map_err(|error| error.to_string())?;
    Ok([term.to_owned(), name.to_owned()])
}
