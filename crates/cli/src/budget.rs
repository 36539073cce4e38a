//! `export --max-error`: of the methods whose error and cost are measured, the cheapest with which the material stays within
//! an error.
//!
//! The error E is the root mean square of the difference of linear radiance over the mean radiance, of the whole material on the
//! sphere under `studio`, against the reference. Fresnel and visibility methods shade punctual lights alone: a shader that
//! serves some is held to E under a lamp, too. What a method approximates is true; where methods are models, each of
//! another surface, the material's own is. What the choice is made among stands in the committed table of
//! methods; whether it holds is measured here, on this material.

mod pictures;

use std::cell::RefCell;
use std::collections::BTreeMap;

use halfvector_codegen::{CodegenError, Fold, Remark, Shader};
use halfvector_graph::figures::{Figure, figure, figures};
use halfvector_graph::library::Library;
use halfvector_graph::method::{Methods, term};
use halfvector_graph::needs::Needs;
use halfvector_scene::Scene;
use serde_json::{Value, json};

use crate::failure::Failure;
use pictures::{LAMP, Lamp, Measured, SIZE, Studio};

/// The terms that are chosen for.
const TERMS: [&str; 6] = ["fresnel", "v", "dfg", "diffuse", "irradiance", "compensation"];

/// The terms among them whose methods are no approximations of one thing but models of different surfaces. The one that the material has,
/// which is the default where none is named, is what it means: it is kept, and true. (Lambert's reflection is a matt surface's, and no bad
/// Oren-Nayar. It costs least of all, so that a choice within any error would be the same.)
const MODELS: [&str; 1] = ["diffuse"];

/// Paths for each pixel of the reference: more of them while noise leaves a choice open.
const ROUNDS: [u64; 3] = [64, 256, 1024];

/// What is asked for.
pub(crate) struct Asked<'w> {
    /// The material on the sphere under `studio`, its images loaded.
    pub(crate) scene: Scene,
    /// What the exported shader serves, with the methods that are taken where none is chosen.
    pub(crate) needs: &'w Needs,
    /// Terms whose method stays: it is what the material means, and true.
    pub(crate) kept: Vec<&'w str>,
    /// What the target makes of needs.
    pub(crate) target: &'w dyn Fn(Needs) -> Needs,
    /// The largest error.
    pub(crate) max_error: f64,
}

/// What was chosen, and what it reached.
#[derive(Debug)]
pub(crate) struct Chosen {
    /// All methods.
    pub(crate) methods: Methods,
    max_error: f64,
    terms: Vec<&'static Figure>,
    kept: Vec<String>,
    /// Terms with their true methods.
    truth: Vec<String>,
    paths: u64,
    studio: Measured,
    lamp: Option<f64>,
    /// Whether the material has a displacement, which what is reached leaves out.
    is_flattened: bool,
    faults: Vec<String>,
}

/// Methods to try, one for each term that has a choice.
struct Candidate {
    methods: Methods,
    terms: Vec<&'static Figure>,
    /// Instructions, by the table.
    cost: u64,
}

/// Chooses.
///
/// # Errors
/// No choice stays within the error: then the smallest that one reaches is told. The material cannot be drawn.
pub(crate) fn choose(wanted: Asked<'_>) -> Result<Chosen, Failure> {
    let Asked { scene, needs, kept, target, max_error } = wanted;
    let Some(material) = scene.materials.first() else { return Err(Failure::input("there is no material")) };
    let made = |methods: &Methods| -> Result<Shader, CodegenError> {
        let needs = target(Needs { methods: methods.clone(), ..needs.clone() });
        halfvector_codegen::shader(&material.document, Library::standard(), &needs, Fold::Export)
    };
    let failed = |error: CodegenError| Failure::input("no shader could be made of the material").because(error);
    let has_metal = !made(&needs.methods).map_err(failed)?.dropped.iter().any(|dropped| dropped.what == "metal");
    let free = |term: &&str| !(kept.contains(term) || MODELS.contains(term) || (*term == "fresnel" && has_metal));

    let mut truth = needs.methods.clone();
    for term in TERMS.iter().filter(|term| free(term)) {
        let exact = measured(term).min_by(|a, b| by_error(a).total_cmp(&by_error(b)));
        exact.map_or(Ok(()), |exact| truth.set(term, &exact.method)).map_err(|error| unknown(&error))?;
    }
    let used = made(&truth).map_err(failed)?.methods;
    let of_target = |methods: &Methods| target(Needs { methods: methods.clone(), ..needs.clone() }).methods;
    let is_used = |term: &str| used.iter().any(|(used, _)| *used == term);
    let choices: Vec<Vec<&'static Figure>> = TERMS
        .iter()
        .filter(|term| free(term) && is_used(term))
        .map(|term| worth_trying(term, &truth, &of_target))
        .collect();
    let candidates = candidates(&truth, &choices)?;

    let before = material.document.clone();
    let scene = pictures::scene(scene, &truth);
    let is_flattened = scene.materials.first().is_some_and(|material| material.document != before);
    let mut studio = Studio::new(&scene)?;
    let is_lit = needs.directional_lights + needs.point_lights + needs.spot_lights > 0;
    let lamp = if is_lit { Some(Lamp::new(&scene)?) } else { None };
    let lamp_errors = Memo::default();
    let lamp_error = |candidate: &Candidate| match &lamp {
        None => Ok(None),
        Some(lamp) => lamp_errors.of(&candidate.key(&TERMS), || lamp.error(&candidate.methods)).map(Some),
    };
    let studio_pictures = Memo::default();
    let kept: Vec<String> =
        TERMS.iter().filter(|term| !free(term) && is_used(term)).map(|term| named(term, &needs.methods)).collect();
    let truths = TERMS.iter().filter(|term| free(term)).map(|term| named(term, &truth)).collect();

    for paths in ROUNDS {
        studio.sample(paths)?;
        for candidate in &candidates {
            let picture = studio_pictures.of(&candidate.key(&STUDIO_TERMS), || studio.draw(&candidate.methods))?;
            let found = studio.measure(&picture);
            if found.most > max_error {
                if found.least <= max_error && paths < ROUNDS[ROUNDS.len() - 1] {
                    // Noise hides whether it would do.
                    break;
                }
                continue;
            }
            let lamp = lamp_error(candidate)?;
            if lamp.is_none_or(|error| error <= max_error) {
                return Ok(Chosen {
                    methods: candidate.methods.clone(),
                    max_error,
                    terms: candidate.terms.clone(),
                    kept,
                    truth: truths,
                    paths,
                    studio: found,
                    lamp,
                    is_flattened,
                    faults: studio.faults(),
                });
            }
        }
    }
    // None does.
    let mut reached: Vec<(Measured, &Candidate)> = Vec::new();
    for candidate in &candidates {
        let picture = studio_pictures.of(&candidate.key(&STUDIO_TERMS), || studio.draw(&candidate.methods))?;
        reached.push((studio.measure(&picture), candidate));
    }
    reached.sort_by(|a, b| a.0.most.total_cmp(&b.0.most).then(a.1.errors().total_cmp(&b.1.errors())));
    let mut smallest: Option<(f64, Measured, Option<f64>, &Candidate)> = None;
    for (measured, candidate) in reached {
        if smallest.as_ref().is_some_and(|(most, ..)| measured.most >= *most) {
            break;
        }
        let lamp = lamp_error(candidate)?;
        let most = measured.most.max(lamp.unwrap_or(0.0));
        if smallest.as_ref().is_none_or(|(known, ..)| most < *known) {
            smallest = Some((most, measured, lamp, candidate));
        }
    }
    Err(refusal(max_error, smallest, &studio.faults()))
}

/// The terms that show under `studio`, where no punctual light is.
const STUDIO_TERMS: [&str; 3] = ["dfg", "irradiance", "compensation"];

/// What is known of choices, by their methods.
struct Memo<T>(RefCell<BTreeMap<String, T>>);

impl<T> Default for Memo<T> {
    fn default() -> Memo<T> {
        Memo(RefCell::new(BTreeMap::new()))
    }
}

impl<T: Clone> Memo<T> {
    fn of(&self, key: &str, make: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
        if let Some(known) = self.0.borrow().get(key) {
            return Ok(known.clone());
        }
        let made = make()?;
        self.0.borrow_mut().insert(key.to_owned(), made.clone());
        Ok(made)
    }
}

impl Candidate {
    fn key(&self, terms: &[&str]) -> String {
        terms.iter().map(|term| self.methods.get(term).name).collect::<Vec<_>>().join(" ")
    }

    /// The table's errors together: which of two choices that look alike is likely to be the better one.
    fn errors(&self) -> f64 {
        self.terms.iter().map(|figure| by_error(figure)).sum()
    }
}

/// The methods of a term whose error and cost are known.
fn measured(name: &str) -> impl Iterator<Item = &'static Figure> {
    let is_whole = |figure: &&Figure| figure.error_rms.is_some() && figure.instructions.is_some();
    figures().iter().filter(move |figure| figure.term == name).filter(is_whole)
}

fn by_error(figure: &Figure) -> f64 {
    figure.error_rms.unwrap_or(f64::INFINITY)
}

fn by_cost(figure: &Figure) -> u64 {
    figure.instructions.unwrap_or(u64::MAX)
}

/// The methods of a term that no other one beats in both error and cost, the cheapest first; of those that the target has.
fn worth_trying(name: &str, truth: &Methods, of_target: &dyn Fn(&Methods) -> Methods) -> Vec<&'static Figure> {
    let has = |figure: &&Figure| {
        let mut methods = truth.clone();
        methods.set(&figure.term, &figure.method).is_ok() && of_target(&methods).is(&figure.term, &figure.method)
    };
    let mut figures: Vec<_> = measured(name).filter(has).collect();
    figures.sort_by(|a, b| by_cost(a).cmp(&by_cost(b)).then(by_error(a).total_cmp(&by_error(b))));
    let mut least = f64::INFINITY;
    figures.retain(|figure| {
        let is_better = by_error(figure) < least;
        least = least.min(by_error(figure));
        is_better
    });
    figures
}

/// All choices, the cheapest first.
fn candidates(truth: &Methods, choices: &[Vec<&'static Figure>]) -> Result<Vec<Candidate>, Failure> {
    let mut candidates = vec![Candidate { methods: truth.clone(), terms: Vec::new(), cost: 0 }];
    for choice in choices.iter().filter(|choice| !choice.is_empty()) {
        let mut longer = Vec::with_capacity(candidates.len() * choice.len());
        for candidate in &candidates {
            for figure in choice {
                let mut methods = candidate.methods.clone();
                methods.set(&figure.term, &figure.method).map_err(|error| unknown(&error))?;
                let terms = candidate.terms.iter().copied().chain([*figure]).collect();
                longer.push(Candidate { methods, terms, cost: candidate.cost.saturating_add(by_cost(figure)) });
            }
        }
        candidates = longer;
    }
    candidates.sort_by(|a, b| a.cost.cmp(&b.cost).then(a.errors().total_cmp(&b.errors())));
    Ok(candidates)
}

fn unknown(error: &impl std::fmt::Display) -> Failure {
    Failure::input("the table of methods names one that there is not").because(error)
}

fn named(term: &str, methods: &Methods) -> String {
    format!("{term}={}", methods.get(term).name)
}

/// A method with its figures: `dfg=karis (error 0.18, -1 instructions)`, beside the term's default.
fn in_words(chosen: &Figure) -> String {
    let error = chosen.error_in_words();
    format!(
        "{}={} (error {error}{})",
        chosen.term,
        chosen.method,
        beside_default(chosen).map_or(String::new(), cost_in_words)
    )
}

fn beside_default(chosen: &Figure) -> Option<i64> {
    let default = figure(&chosen.term, term(&chosen.term)?.methods.first()?.name)?;
    Some(chosen.instructions? as i64 - default.instructions? as i64)
}

fn cost_in_words(beside: i64) -> String {
    match beside {
        0 => ", as costly as the default".to_owned(),
        _ => format!(", {beside:+} instructions beside the default"),
    }
}

/// A number with three digits, never rounded down: a budget of it is kept.
fn rounded_up(x: f64) -> String {
    if !x.is_finite() || x <= 0.0 {
        return format!("{x}");
    }
    let decimals = (2.0 - x.log10().floor()).clamp(0.0, 12.0);
    let unit = 10.0_f64.powf(decimals);
    format!("{:.*}", decimals as usize, (x * unit).ceil() / unit)
}

/// A number with two digits.
fn in_digits(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.*}", (1.0 - x.log10().floor()).clamp(0.0, 12.0) as usize) }
}

fn reached_in_words(studio: &Measured, paths: u64, lamp: Option<f64>) -> String {
    let lamp = lamp.map_or(String::new(), |error| format!("; under one directional light {}", in_digits(error)));
    let (error, most) = (in_digits(studio.error), rounded_up(studio.most));
    format!("under studio {error}, with the reference's noise ({paths} paths a pixel) at most {most}{lamp}")
}

fn refusal(max_error: f64, smallest: Option<(f64, Measured, Option<f64>, &Candidate)>, faults: &[String]) -> Failure {
    let failure = Failure::input(format!("no choice of methods keeps the error within {max_error}"));
    let Some((most, studio, lamp, candidate)) = smallest else { return failure };
    let methods: Vec<String> = candidate.terms.iter().map(|figure| in_words(figure)).collect();
    let methods = if methods.is_empty() { "the only choice".to_owned() } else { methods.join(", ") };
    let failure = failure
        .because(format!("the smallest that can be reached is {}", rounded_up(most)))
        .because(format!("{methods}: {}", reached_in_words(&studio, ROUNDS[ROUNDS.len() - 1], lamp)));
    let failure = faults.iter().fold(failure, |failure, fault| failure.because(fault));
    failure.try_to(format!(
        "--max-error {}; or --method TERM=NAME for a term whose method is what the material means: it is kept, and true",
        rounded_up(most)
    ))
}

impl Chosen {
    /// For the comment of the shader.
    pub(crate) fn remarks(&self) -> Vec<Remark> {
        let methods: Vec<String> = self.terms.iter().map(|figure| in_words(figure)).collect();
        let kept = if self.kept.is_empty() { String::new() } else { format!("; kept: {}", self.kept.join(", ")) };
        let methods = if methods.is_empty() { "nothing to choose".to_owned() } else { methods.join(", ") };
        vec![
            Remark {
                lead: "budget",
                text: format!(
                    "error {} is kept: {}{}",
                    self.max_error,
                    reached_in_words(&self.studio, self.paths, self.lamp),
                    if self.is_flattened { ", without displacement" } else { "" }
                ),
            },
            Remark { lead: "chosen", text: format!("{methods}{kept}") },
        ]
    }

    /// For `--explain`.
    pub(crate) fn json(&self) -> Value {
        let chosen = self.terms.iter().map(|figure| {
            json!({
                "term": figure.term, "method": figure.method, "error_rms": figure.error_rms, "unit": figure.unit,
                "instructions_beside_default": beside_default(figure),
            })
        });
        let Measured { error, least, most } = self.studio;
        json!({
            "max_error": self.max_error,
            "chosen": chosen.collect::<Vec<_>>(),
            "kept": self.kept,
            "reached": {
                "studio": { "error": error, "at_least": least, "at_most": most, "paths": self.paths, "pixels": [SIZE, SIZE] },
                "lamp": self.lamp.map(|error| json!({ "error": error, "light": LAMP, "pixels": [SIZE, SIZE] })),
            },
            "truth": self.truth,
            "not_finite": self.faults,
        })
    }

    /// For the person at the terminal.
    pub(crate) fn in_words(&self) -> String {
        let said: Vec<String> =
            self.remarks().into_iter().map(|remark| format!("{}: {}", remark.lead, remark.text)).collect();
        let faults = self.faults.iter().map(|fault| format!("\nwarning: {fault}")).collect::<String>();
        format!("{}{faults}", said.join("\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beaten_in_error_and_cost_is_not_tried() {
        let same = |methods: &Methods| methods.clone();
        for name in TERMS {
            let tried = worth_trying(name, &Methods::default(), &same);
            assert!(!tried.is_empty(), "{name}");
            for pair in tried.windows(2) {
                assert!(by_cost(pair[0]) <= by_cost(pair[1]) && by_error(pair[0]) > by_error(pair[1]), "{pair:?}");
            }
            let exact = measured(name).map(by_error).fold(f64::INFINITY, f64::min);
            assert_eq!(by_error(tried[tried.len() - 1]), exact, "{name}");
        }
        // A target that has another method in the place of one.
        let fit = |methods: &Methods| {
            let mut methods = methods.clone();
            if methods.is("dfg", "table") {
                methods.set("dfg", "fit").expect("a method");
            }
            methods
        };
        let tried = worth_trying("dfg", &Methods::default(), &fit);
        assert!(
            tried.iter().all(|figure| figure.method != "table") && tried.iter().any(|figure| figure.method == "fit")
        );
    }

    #[test]
    fn the_cheapest_choice_stands_first() {
        let same = |methods: &Methods| methods.clone();
        let choices: Vec<_> =
            ["v", "diffuse"].iter().map(|name| worth_trying(name, &Methods::default(), &same)).collect();
        let candidates = candidates(&Methods::default(), &choices).expect("methods of the list");
        assert_eq!(candidates.len(), choices[0].len() * choices[1].len());
        assert!(candidates.windows(2).all(|pair| pair[0].cost <= pair[1].cost));
        for (candidate, of) in [(&candidates[0], 0), (&candidates[candidates.len() - 1], usize::MAX)] {
            for choice in &choices {
                let figure = choice[of.min(choice.len() - 1)];
                assert!(candidate.methods.is(&figure.term, &figure.method), "{figure:?}");
            }
        }
    }

    #[test]
    fn said_budgets_are_kept() {
        for x in [0.123_412, 0.099_99, 1e-7, 12.345, 0.05] {
            let said: f64 = rounded_up(x).parse().expect("a number");
            assert!(said >= x * (1.0 - 1e-12) && said <= x * 1.011, "{x}: {said}");
        }
        assert_eq!(rounded_up(f64::INFINITY), "inf");
    }
}
