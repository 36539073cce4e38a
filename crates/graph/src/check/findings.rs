//! What is gathered while a document is checked: problems, as many as somebody may read, and how many more there were. Searches for
//! likely names are counted, too, for each goes through a whole library.

use super::{Problem, Severity};

/// Most problems of a severity that are told; the others are counted.
const MAX_TOLD: usize = 10_000;
/// Most searches for a likely name: a hostile document has many wrong ones.
const MAX_SEARCHES: usize = 20;

/// Problems of a document.
#[derive(Debug, Default)]
pub(super) struct Findings {
    pub(super) problems: Vec<Problem>,
    errors: usize,
    warnings: usize,
    searches: usize,
}

impl Findings {
    /// Counts one problem more, and says whether it is told.
    pub(super) fn has_room(&mut self, severity: Severity) -> bool {
        let count = match severity {
            Severity::Error => &mut self.errors,
            Severity::Warning => &mut self.warnings,
        };
        *count += 1;
        *count <= MAX_TOLD
    }

    /// Counts one search more for a likely name, and says whether it is made.
    pub(super) fn may_search(&mut self) -> bool {
        self.searches += 1;
        self.searches <= MAX_SEARCHES
    }

    /// The problems, with a last one of each severity that tells how many were left out.
    pub(super) fn into_problems(mut self) -> Vec<Problem> {
        let counts = [(Severity::Error, self.errors, "errors"), (Severity::Warning, self.warnings, "warnings")];
        for (severity, count, what) in counts {
            if let Some(more) = count.checked_sub(MAX_TOLD).filter(|more| *more > 0) {
                let message = format!("there are {more} more {what}; mend those that are told first");
                self.problems.push(Problem {
                    severity,
                    group: None,
                    node: None,
                    node_label: None,
                    socket: None,
                    message,
                });
            }
        }
        self.problems
    }
}
