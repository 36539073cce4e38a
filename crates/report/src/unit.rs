//! What errors are counted in, and how large an error each budget allows.

/// What errors are counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Parts of the truth.
    Relative,
    /// Angles.
    Degrees,
    /// Distances in units in the last place.
    Ulps,
    /// The quantity's own.
    Plain,
}

impl Unit {
    /// Of the errors on a domain.
    pub fn of(domain: &str) -> Unit {
        // What stands before the last semicolon are the inputs, which have units of their own.
        let said = domain.rsplit(';').next().unwrap_or(domain);
        let has = |words: [&str; 2]| words.iter().any(|word| said.contains(word));
        if has(["degrees", "in deg"]) {
            Unit::Degrees
        } else if has(["ulps", "ulp of"]) {
            Unit::Ulps
        } else if has(["relative", "parts of the"]) {
            Unit::Relative
        } else {
            Unit::Plain
        }
    }

    /// Title of an axis or a column.
    pub fn title(self) -> &'static str {
        match self {
            Unit::Relative => "rms error, relative",
            Unit::Degrees => "rms error [degrees]",
            Unit::Ulps => "rms error [ulp]",
            Unit::Plain => "rms error, absolute",
        }
    }

    /// The rms error that each budget allows; film asks for the least there is, and counts less than this as nothing. Absolute errors are of
    /// quantities from 0 to 1, so that a part of them is as large as a part of the most that there can be.
    pub fn limit(self, budget: Budget) -> f64 {
        let [mobile, desktop, film] = match self {
            Unit::Relative | Unit::Plain => [0.1, 0.01, 1e-6],
            Unit::Degrees => [5.0, 1.0, 1e-3],
            Unit::Ulps => [1024.0, 32.0, 2.0],
        };
        match budget {
            Budget::Mobile => mobile,
            Budget::Desktop => desktop,
            Budget::Film => film,
        }
    }
}

/// How much time there is for a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Budget {
    /// The cheapest that nobody sees at a glance.
    Mobile,
    /// The cheapest that nobody sees beside the truth.
    Desktop,
    /// The most accurate.
    Film,
}

impl Budget {
    /// All, from the smallest.
    pub const ALL: [Budget; 3] = [Budget::Mobile, Budget::Desktop, Budget::Film];

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Budget::Mobile => "mobile",
            Budget::Desktop => "desktop",
            Budget::Film => "film",
        }
    }
}
