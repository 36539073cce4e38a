//! What each node costs in the exported shader: bars, and on demand the graph coloured by them. The counting is
//! `halfvector_codegen::cost`.

use std::collections::BTreeMap;
use std::sync::Arc;

use eframe::egui::{self, Align, Layout, Sense};
use halfvector_codegen::{Cost as Counted, Fold, Instructions, cost, shader};
use halfvector_graph::document::{Document, NodeId};
use halfvector_graph::flatten::find;
use halfvector_graph::library::Library;
use halfvector_graph::needs::Needs;

use crate::action::{Action, found};
use crate::panes::code::{needs_of, path_label};
use crate::session::Session;
use crate::stage::Stage;
use crate::theme;
use crate::work::Worker;

/// A count that is wanted.
#[derive(Debug)]
struct Job {
    document: Arc<Document>,
    needs: Needs,
}

/// The costs of nodes.
#[derive(Debug)]
pub(crate) struct Cost {
    worker: Option<Worker<Job, Result<Counted, String>>>,
    /// Revision and needs of the job that was given last.
    asked: Option<(u64, Needs)>,
    counted: Option<Result<Counted, String>>,
    /// What the counted nodes are called, in the order of the count.
    labels: Vec<String>,
    colors_graph: bool,
    /// Whether the pane was drawn since the last frame: nothing is counted for nobody.
    is_seen: bool,
}

impl Cost {
    /// Starts the thread that counts.
    pub(crate) fn new(context: &egui::Context) -> Cost {
        let worker = Worker::start("cost", context, |job: Job, _| {
            let made = shader(&job.document, Library::standard(), &job.needs, Fold::Export);
            let made = made.map_err(|error| error.to_string());
            Some(made.and_then(|shader| cost(&shader).map_err(|error| error.to_string())))
        });
        Cost {
            worker: worker.ok(),
            asked: None,
            counted: None,
            labels: Vec::new(),
            colors_graph: false,
            is_seen: false,
        }
    }

    /// Whether nothing is being counted.
    pub(crate) fn is_idle(&self) -> bool {
        self.worker.as_ref().is_none_or(|worker| !worker.is_busy())
    }

    /// Has the shader counted after a change, while somebody looks, and returns how costly each node is compared with the
    /// costliest: 0 to 1. Empty while the graph is not to be coloured.
    pub(crate) fn hear(&mut self, session: &Session, stage: &Stage) -> BTreeMap<NodeId, f32> {
        while let Some(counted) = self.worker.as_ref().and_then(Worker::poll) {
            let nodes = counted.as_ref().map(|counted| counted.nodes.as_slice()).unwrap_or_default();
            self.labels = nodes.iter().map(|part| path_label(session, &part.node)).collect();
            self.counted = Some(counted);
        }
        let wanted = (session.revision(), needs_of(stage));
        if (std::mem::take(&mut self.is_seen) || self.colors_graph)
            && let Some(worker) = self.worker.as_ref().filter(|_| self.asked.as_ref() != Some(&wanted))
        {
            worker.submit(Job { document: session.document().clone(), needs: wanted.1.clone() });
            self.asked = Some(wanted);
        }
        let Some(Ok(counted)) = self.counted.as_ref().filter(|_| self.colors_graph) else { return BTreeMap::new() };
        let costs = on_level(session, counted);
        let most = costs.values().copied().max().unwrap_or(0).max(1);
        costs.into_iter().map(|(node, cost)| (node, cost as f32 / most as f32)).collect()
    }

    /// Draws the bars.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        self.is_seen = true;
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                crate::panes::toggle(ui, &mut self.colors_graph, "Colour the graph")
                    .on_hover_text("The costlier a node, the redder");
                ui.separator();
                if let Some(Ok(counted)) = &self.counted {
                    ui.label(total(counted)).on_hover_text(
                        "Estimated for the exported shader under the viewport's lights: an operation on a scalar or vector is one \
                         instruction, a loop that ends by a value counts once, both sides of a branch count. A driver may need fewer.",
                    );
                }
            });
            ui.add_space(4.0);
            match &self.counted {
                None => {
                    ui.spinner();
                }
                Some(Err(why)) => {
                    ui.label(why);
                }
                Some(Ok(counted)) => bars(ui, session, counted, &self.labels, actions),
            }
        });
    }
}

/// One number for all classes, for comparing: a transcendental function runs at a quarter of the rate of arithmetic, a read of a
/// texture costs about as much as sixteen sums.
fn weight(part: Instructions) -> u32 {
    let plain = part.arithmetic.saturating_add(part.choices);
    plain.saturating_add(part.transcendental.saturating_mul(4)).saturating_add(part.samples.saturating_mul(16))
}

/// What the nodes of the level that is worked on cost: a group all that is in it, a node of a group all uses of it.
fn on_level(session: &Session, counted: &Counted) -> BTreeMap<NodeId, u32> {
    let document = session.document();
    let mut costs: BTreeMap<NodeId, u32> = BTreeMap::new();
    for part in &counted.nodes {
        let ends = part.node.match_indices('/').map(|(end, _)| end).chain([part.node.len()]);
        let places = ends.filter_map(|end| find(document, &part.node[..end]));
        for (_, node, _) in places.filter(|(group, ..)| *group == session.group()) {
            let cost = costs.entry(node.to_owned()).or_default();
            *cost = cost.saturating_add(weight(part.instructions));
        }
    }
    costs
}

fn total(counted: &Counted) -> String {
    let Counted { fragment, vertex, uniform_bytes, .. } = counted;
    let [in_fragment, in_vertex] = [fragment.total(), vertex.total()];
    format!(
        "{} instructions: {in_fragment} fragment, {in_vertex} vertex · {} texture reads · {uniform_bytes} bytes of uniforms",
        in_fragment.saturating_add(in_vertex),
        fragment.samples.saturating_add(vertex.samples),
    )
}

/// A row: whose cost, how much.
struct Bar<'a> {
    node: Option<&'a NodeId>,
    label: String,
    instructions: Instructions,
}

fn bars(ui: &mut egui::Ui, session: &Session, counted: &Counted, labels: &[String], actions: &mut Vec<Action>) {
    let left = |class: fn(&Instructions) -> u32| {
        let of_nodes = counted.nodes.iter().map(|part| class(&part.instructions)).fold(0, u32::saturating_add);
        class(&counted.fragment).saturating_add(class(&counted.vertex)).saturating_sub(of_nodes)
    };
    let rest = Instructions {
        arithmetic: left(|of| of.arithmetic),
        transcendental: left(|of| of.transcendental),
        choices: left(|of| of.choices),
        samples: left(|of| of.samples),
    };
    let mut bars: Vec<Bar> = counted
        .nodes
        .iter()
        .zip(labels)
        .map(|(part, label)| Bar { node: Some(&part.node), label: label.clone(), instructions: part.instructions })
        .collect();
    bars.push(Bar { node: None, label: "Light and transforms".to_owned(), instructions: rest });
    bars.sort_by_key(|bar| std::cmp::Reverse(weight(bar.instructions)));
    let most = bars.first().map_or(1, |bar| weight(bar.instructions)).max(1);
    ui.weak("Instructions of each node, fragment and vertex together").on_hover_text(
        "As long as the bar: a transcendental function weighs four instructions, a read of a texture sixteen.",
    );
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for bar in &bars {
            ui.horizontal(|ui| row(ui, session, bar, weight(bar.instructions) as f32 / most as f32, actions));
        }
    });
}

fn row(ui: &mut egui::Ui, session: &Session, bar: &Bar<'_>, share: f32, actions: &mut Vec<Action>) {
    let height = ui.spacing().interact_size.y;
    let name = egui::vec2((ui.available_width() * 0.34).min(220.0), height);
    ui.allocate_ui_with_layout(name, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(name.x);
        match bar.node {
            Some(node) => {
                let link = ui.add(egui::Link::new(&bar.label));
                if link.on_hover_text("Show the node").clicked() {
                    actions.extend(found(session.document(), node));
                }
            }
            None => {
                ui.weak(&bar.label).on_hover_text("What is not any node's: lobes, lights, interpolation");
            }
        }
    });
    let figures = 210.0;
    let width = (ui.available_width() - figures).max(40.0);
    let (rect, _) = ui.allocate_exact_size(egui::vec2(width, height), Sense::hover());
    let track = rect.shrink2(egui::vec2(0.0, 5.0));
    ui.painter().rect_filled(track, 3.0, ui.visuals().extreme_bg_color);
    let mut filled = track;
    filled.set_width(track.width() * share.clamp(0.0, 1.0));
    ui.painter().rect_filled(filled, 3.0, theme::heat(share));
    let mut text = format!("{:>6}", bar.instructions.total());
    if bar.instructions.samples > 0 {
        text += &format!("  {} tex", bar.instructions.samples);
    }
    ui.monospace(text);
}
