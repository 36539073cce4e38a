//! How the program says that something is wrong: what, where, why, what to try; and with which exit code it ends.

use std::fmt;
use std::path::Path;

/// The input is wrong.
pub(crate) const WRONG_INPUT: u8 = 1;
/// The command line is wrong.
pub(crate) const WRONG_USAGE: u8 = 2;
/// A check found something.
pub(crate) const FOUND: u8 = 3;

/// What stopped a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Failure {
    /// Exit code.
    pub(crate) code: u8,
    what: String,
    place: Option<String>,
    why: Vec<String>,
    remedy: Option<String>,
}

impl Failure {
    /// Something in the input is wrong.
    pub(crate) fn input(what: impl Into<String>) -> Failure {
        Failure { code: WRONG_INPUT, what: what.into(), place: None, why: Vec::new(), remedy: None }
    }

    /// Something on the command line is wrong that only shows with the input at hand.
    pub(crate) fn usage(what: impl Into<String>) -> Failure {
        Failure { code: WRONG_USAGE, ..Failure::input(what) }
    }

    /// In which file.
    pub(crate) fn at(mut self, path: &Path) -> Failure {
        self.place = Some(path.display().to_string());
        self
    }

    /// The reason; one line for each call.
    pub(crate) fn because(mut self, why: impl fmt::Display) -> Failure {
        self.why.push(why.to_string());
        self
    }

    /// What may help.
    pub(crate) fn try_to(mut self, remedy: impl Into<String>) -> Failure {
        self.remedy = Some(remedy.into());
        self
    }

    /// The same on one line, for messages that are not shown on a terminal.
    pub(crate) fn line(&self) -> String {
        let mut line = self.what.clone();
        if let Some(place) = &self.place {
            line += &format!(" ({place})");
        }
        if !self.why.is_empty() {
            line += &format!(": {}", self.why.join("; "));
        }
        if let Some(remedy) = &self.remedy {
            line += &format!("; try: {remedy}");
        }
        line.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}", self.what)?;
        let indented = |text: &str| text.trim_end().replace('\n', "\n         ");
        if let Some(place) = &self.place {
            write!(f, "\n  where: {}", indented(place))?;
        }
        for why in &self.why {
            write!(f, "\n  why:   {}", indented(why))?;
        }
        if let Some(remedy) = &self.remedy {
            write!(f, "\n  try:   {}", indented(remedy))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stand_on_lines_of_their_own() {
        let failure = Failure::input("no picture").at(Path::new("a.png")).because("one\ntwo").try_to("another");
        assert_eq!(
            failure.to_string(),
            "error: no picture\n  where: a.png\n  why:   one\n         two\n  try:   another"
        );
        assert_eq!(failure.line(), "no picture (a.png): one two; try: another");
        assert_eq!((failure.code, Failure::usage("x").code), (1, 2));
    }
}
