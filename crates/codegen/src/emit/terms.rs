//! What the lobes make of one light or of the environment, as text: the terms of the base, and those of the layers over it.

/// Products, one for each lobe.
#[derive(Default)]
pub(crate) struct Terms {
    /// Lobes of the base.
    pub(crate) base: Vec<String>,
    /// The coat, which lies over the base.
    pub(crate) coat: Option<String>,
    /// The sheen, which lies over both.
    pub(crate) sheen: Option<String>,
}

impl Terms {
    /// Whether a layer dims what lies below it.
    pub(crate) fn is_layered(&self) -> bool {
        self.coat.is_some() || self.sheen.is_some()
    }

    /// Lines that sum the terms up in `variable`, each layer over all that lies below, and the sum: one term alone is its
    /// own.
    pub(crate) fn summed(self, variable: &str) -> (Vec<String>, String) {
        let mut terms: Vec<_> = self.base.into_iter().map(|term| ("", term)).collect();
        terms.extend(self.coat.map(|term| (" * under_coat", term)));
        terms.extend(self.sheen.map(|term| (" * under_sheen", term)));
        if let [(_, term)] = &terms[..] {
            return (Vec::new(), term.clone());
        }
        let mut lines = Vec::new();
        for (kept, term) in terms {
            lines.push(match (lines.is_empty(), kept) {
                (true, _) => format!("var {variable} = {term};"),
                (false, "") => format!("{variable} += {term};"),
                (false, kept) => format!("{variable} = {variable}{kept} + {term};"),
            });
        }
        (lines, variable.to_owned())
    }
}
