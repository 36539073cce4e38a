//! The measured half of `check --cost`: how long the device works on a pixel of the material, and how much of that goes when a
//! node's outputs are held.
//!
//! The material fills a picture on a square of two triangles, under the light that the estimate has, drawn by the exported shader.
//! Runs are interleaved, so that a slow moment of the machine meets all alike; a node's time is the median of the differences
//! within each round.

use std::time::{Duration, Instant};

use halfvector_codegen::{Fold, NodeCost};
use halfvector_graph::document::{Document, Link, Node, Parameter, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::resolve::resolve_types;
use halfvector_graph::value::{SocketType, Type, Value};
use halfvector_render::{Cache, RenderOptions, Renderer};
use halfvector_report::timing::median;
use halfvector_scene::{Scene, SceneMaterial};

/// Rounds of interleaved runs, and the fewest.
const ROUNDS: usize = 11;
const FEWEST: usize = 5;
/// Pixels along a side that are tried, the smallest first; more are taken while a picture takes less than [`SHORT`].
const EDGES: [u32; 4] = [64, 128, 256, 1024];
/// A picture of this is long beside the clock's step [s].
const SHORT: f64 = 2e-3;
/// How long the nodes of all documents of a command may take together.
const FOR_NODES: Duration = Duration::from_secs(4);

/// Nanoseconds for a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nanoseconds {
    /// Median of the rounds.
    pub(super) median: f64,
    /// Half the distance between the rounds' quartiles.
    pub(super) spread: f64,
}

/// What was measured of a material.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    /// The device's name, for people.
    pub(super) device: String,
    /// Whether the device is a program on the CPU.
    pub(super) is_software: bool,
    /// Of the whole fragment stage.
    pub(super) whole: Nanoseconds,
    /// Of each node of the estimate, or why not.
    pub(super) nodes: Vec<Result<Nanoseconds, String>>,
}

/// The device, if there is one, and what it has compiled.
pub(super) struct Meter {
    device: Result<(Renderer, Cache), String>,
    /// What is left of [`FOR_NODES`].
    left: Duration,
}

impl Meter {
    /// Opens the best device.
    pub(super) fn open() -> Meter {
        let device = Renderer::new().map(|renderer| (renderer, Cache::default())).map_err(|error| error.to_string());
        Meter { device, left: FOR_NODES }
    }

    /// The time of a material and of its costliest nodes (at most `most`), or why nothing could be measured.
    pub(super) fn measure(
        &mut self,
        material: &SceneMaterial,
        nodes: &[NodeCost],
        most: usize,
    ) -> Result<Measured, String> {
        let (renderer, cache) = self.device.as_mut().map_err(|why| why.clone())?;
        let scene = Scene::filling_square(material.clone()).map_err(|error| error.to_string())?;
        let no_clock = || format!("{} gives no timestamps", renderer.adapter());
        let mut draw = |scene: &Scene, edge: u32| -> Result<f64, String> {
            let size = RenderOptions { width: edge, height: edge, samples_per_side: 1, ..RenderOptions::default() };
            let options = RenderOptions { fold: Fold::Export, ..size };
            let drawn = renderer.render_timed(cache, scene, None, &options).map_err(|error| error.to_string())?;
            drawn.1.filter(|seconds| *seconds > 0.0).ok_or_else(no_clock)
        };
        // The first picture waits for the compiler.
        draw(&scene, EDGES[0])?;
        let mut edge = EDGES[0];
        for larger in EDGES {
            edge = larger;
            if draw(&scene, larger)? > SHORT {
                break;
            }
        }

        let start = Instant::now();
        let mut order: Vec<usize> = (0..nodes.len()).collect();
        order.sort_by_key(|&at| std::cmp::Reverse(nodes[at].instructions.total()));
        let mut found: Vec<Result<Nanoseconds, String>> =
            vec![Err(format!("only the {most} costliest nodes are measured")); nodes.len()];
        let mut subjects = Vec::new();
        for &at in order.iter().take(most) {
            // Half the time is the compiler's.
            if start.elapsed() > self.left / 2 {
                found[at] = Err("the time for measuring was used on costlier nodes".to_owned());
                continue;
            }
            match held(&material.document, &nodes[at].node) {
                Err(why) => found[at] = Err(why.to_owned()),
                Ok(document) => {
                    let material = SceneMaterial { document, ..material.clone() };
                    let without = Scene { materials: vec![material], ..scene.clone() };
                    match draw(&without, EDGES[0]) {
                        Ok(_) => subjects.push((at, without, Vec::new())),
                        Err(why) => found[at] = Err(why),
                    }
                }
            }
        }
        let to_ns = 1e9 / f64::from(edge * edge);
        let mut whole = Vec::new();
        for round in 0..ROUNDS {
            if round >= FEWEST && start.elapsed() > self.left {
                break;
            }
            let own = draw(&scene, edge)? * to_ns;
            whole.push(own);
            for (_, without, saved) in &mut subjects {
                saved.push(own - draw(without, edge)? * to_ns);
            }
        }
        self.left = self.left.saturating_sub(start.elapsed());
        for (at, _, saved) in subjects {
            let saved = of_rounds(saved);
            let is_seen = saved.median > saved.spread;
            found[at] = if is_seen { Ok(saved) } else { Err(format!("below the spread, {:.2} ns", saved.spread)) };
        }
        let (device, is_software) = (renderer.adapter().to_owned(), renderer.is_software());
        Ok(Measured { device, is_software, whole: of_rounds(whole), nodes: found })
    }
}

fn of_rounds(mut rounds: Vec<f64>) -> Nanoseconds {
    rounds.sort_by(f64::total_cmp);
    let quartile =
        |of_four: usize| rounds.get((rounds.len().saturating_sub(1) * of_four + 2) / 4).copied().unwrap_or(0.0);
    Nanoseconds { spread: 0.5 * (quartile(3) - quartile(1)), median: median(rounds.clone()) }
}

/// The document with a node's outputs held: parameters stand in their place, so that nothing behind them is folded. What only
/// this node reads goes with it.
fn held(document: &Document, node: &str) -> Result<Document, &'static str> {
    if !document.graph.nodes.contains_key(node) {
        return Err("it lies in a group; ungroup it to measure it");
    }
    let library = Library::standard().of(document);
    let types = resolve_types(&document.graph, &library);
    let of_node = types.get(node).ok_or("its kind is not known")?;
    let mut held = document.clone();
    for link in document.graph.links.iter().filter(|link| link.from.node == node) {
        let half = [0.5; 4];
        let (definition, value) = match of_node.output(&link.from.socket) {
            Some(SocketType::Value(Type::F32)) => ("input/number", Value::Number(0.5)),
            Some(SocketType::Value(Type::I32)) => ("input/integer", Value::Number(1.0)),
            Some(SocketType::Value(Type::Bool)) => ("input/condition", Value::Bool(true)),
            Some(SocketType::Value(Type::Vec2)) => ("input/vector2", Value::Vec2([0.5; 2])),
            Some(SocketType::Value(Type::Vec3)) => ("input/vector3", Value::Vec3([0.5; 3])),
            Some(SocketType::Value(Type::Vec4)) => ("input/vector4", Value::Vec4(half)),
            _ => return Err("it gives no numbers that could be held"),
        };
        let id = held.graph.free_id("held");
        held.graph.nodes.insert(id.clone(), Node::new(definition).with("value", value));
        for own in held.graph.links.iter_mut().filter(|own| **own == *link) {
            *own = Link::new(SocketRef::new(&id, "out"), own.to.clone());
        }
        let is_taken = |name: &str| document.parameter(name).is_some();
        let name = halfvector_graph::document::free_name(&id, is_taken);
        held.parameters.push(Parameter { name, label: None, socket: SocketRef::new(&id, "value"), range: None });
    }
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spread_is_half_of_what_lies_between_the_quartiles() {
        let found = of_rounds(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!((found.median, found.spread), (3.0, 1.0));
        assert_eq!(of_rounds(vec![7.0]), Nanoseconds { median: 7.0, spread: 0.0 });
        assert_eq!(of_rounds(Vec::new()), Nanoseconds { median: 0.0, spread: 0.0 });
    }

    #[test]
    fn a_held_node_leaves_the_shader_with_what_only_it_reads() {
        let mut document = Document::with_surface("held");
        let nodes = &mut document.graph.nodes;
        nodes.insert("noise".into(), Node::new("procedural/value_noise_2d"));
        nodes.insert("sine".into(), Node::new("math/sin"));
        let link = |from: &str, to: (&str, &str)| Link::new(SocketRef::new(from, "out"), SocketRef::new(to.0, to.1));
        document.graph.links = vec![link("noise", ("sine", "x")), link("sine", ("surface", "metallic"))];
        let needs = crate::commands::export::plain_needs();
        let nodes = |document: &Document| -> Vec<String> {
            let shader = halfvector_codegen::shader(document, Library::standard(), &needs, Fold::Export).expect("one");
            let cost = halfvector_codegen::cost(&shader).expect("valid");
            cost.nodes.into_iter().map(|node| node.node).collect()
        };
        assert_eq!(nodes(&document), ["noise", "sine"]);
        let first = held(&document, "noise").expect("numbers");
        assert_eq!(nodes(&first), ["held", "sine"], "what reads the held value stays");
        assert_eq!(nodes(&held(&document, "sine").expect("numbers")), ["held"]);
        assert!(held(&document, "group/inside").is_err());
    }
}
