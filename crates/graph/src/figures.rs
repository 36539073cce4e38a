//! How wrong each method is and what it costs, as measured: the committed table `data/methods.csv`, which
//! `halfvector report` is made into. It measures nothing.

use std::sync::OnceLock;

const TABLE: &str = include_str!("../data/methods.csv");

/// The measured figures of a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The term's name.
    pub term: String,
    /// The method's name.
    pub method: String,
    /// Root mean square error, on the inputs where it is largest; none where it was not measured against a truth.
    pub error_rms: Option<f64>,
    /// The largest error, where it is known.
    pub error_max: Option<f64>,
    /// `relative` (parts of the truth), `degrees` or `absolute`; empty without an error.
    pub unit: String,
    /// Its time over that of the term's default, where both were timed together, on the CPU.
    pub time_beside_default: Option<f64>,
    /// SPIR-V instructions of a plain shader's whole fragment stage with this method, all other terms having their defaults:
    /// what a method costs beside another one is the difference, which can be compared and added across terms.
    pub instructions: Option<u64>,
    /// Time of a pixel of that shader on the measured device [ns].
    pub gpu_ns: Option<f64>,
    /// Memory that it reads [bytes].
    pub bytes: Option<u64>,
    /// The inputs that were measured.
    pub inputs: String,
}

/// All figures, in the order of the terms.
pub fn figures() -> &'static [Figure] {
    static FIGURES: OnceLock<Vec<Figure>> = OnceLock::new();
    FIGURES.get_or_init(|| TABLE.lines().skip(1).filter_map(read).collect())
}

/// The figures of a method; none where it was not measured.
pub fn figure(term: &str, method: &str) -> Option<&'static Figure> {
    figures().iter().find(|figure| figure.term == term && figure.method == method)
}

fn read(line: &str) -> Option<Figure> {
    let fields: Vec<&str> = line.splitn(10, ',').collect();
    let [term, method, error_rms, error_max, unit, time, instructions, gpu_ns, bytes, inputs] = fields[..] else {
        return None;
    };
    Some(Figure {
        term: term.into(),
        method: method.into(),
        error_rms: error_rms.parse().ok(),
        error_max: error_max.parse().ok(),
        unit: unit.into(),
        time_beside_default: time.parse().ok(),
        instructions: instructions.parse().ok(),
        gpu_ns: gpu_ns.parse().ok(),
        bytes: bytes.parse().ok(),
        inputs: inputs.trim_matches('"').into(),
    })
}

impl Figure {
    /// The error in words: 13 %, 5.1e-8, 12 deg; empty where there is none.
    pub fn error_in_words(&self) -> String {
        error_in_words(self)
    }
}

/// The error in words.
pub(crate) fn error_in_words(figure: &Figure) -> String {
    let Some(x) = figure.error_rms else { return String::new() };
    let number = |x: f64| match x {
        0.0 => "0".to_owned(),
        _ if (0.01..1e4).contains(&x) => format!("{x:.*}", (1.0 - x.log10().floor()).max(0.0) as usize),
        _ => format!("{x:.1e}"),
    };
    match figure.unit.as_str() {
        "relative" if x >= 1e-4 => format!("{} %", number(100.0 * x)),
        "degrees" => format!("{} deg", number(x)),
        _ => number(x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::term;

    #[test]
    fn every_line_is_read_and_names_a_method() {
        assert_eq!(figures().len() + 1, TABLE.lines().count());
        for figure in figures() {
            let term = term(&figure.term).unwrap_or_else(|| panic!("{figure:?}"));
            assert!(term.methods.iter().any(|method| method.name == figure.method), "{figure:?}");
        }
        let default = figure("v", "correlated").expect("a line");
        assert_eq!(default.time_beside_default, Some(1.0));
        assert!(default.error_rms < Some(1e-6) && default.instructions > Some(100), "{default:?}");
        // What `export --max-error` chooses among.
        for term in
            ["fresnel", "v", "dfg", "diffuse", "irradiance", "compensation"].map(|name| term(name).expect("a term"))
        {
            for method in term.methods {
                let figure = figure(term.name, method.name);
                let is_whole = |figure: &Figure| figure.error_rms.is_some() && figure.instructions.is_some();
                assert!(figure.is_some_and(is_whole), "{} {}: {figure:?}", term.name, method.name);
            }
        }
    }

    #[test]
    fn errors_are_said_with_their_unit() {
        let said = |error_rms, unit: &str| {
            let line = format!("d,ggx,{error_rms},,{unit},,,,,\"all, of them\"");
            error_in_words(&read(&line).expect("a line"))
        };
        assert_eq!([said("0.134", "relative"), said("5.12e-8", "relative")], ["13 %", "5.1e-8"]);
        assert_eq!([said("12.34", "degrees"), said("0.0115", "absolute")], ["12 deg", "0.011"]);
    }
}
