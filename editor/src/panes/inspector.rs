//! What is selected: one node with its inputs, several nodes, or the material itself.

mod channel;
mod color;
mod curve;
mod group;
mod help;
mod image;
mod input;
mod kind;
mod material;
mod metal;
mod node;
mod number;
mod parameter;
mod ramp;
mod row;
mod several;
mod thumbnail;

use eframe::egui;

use halfvector_graph::edit::Edit;

use crate::action::Action;
pub(crate) use crate::panes::inspector::row::named_text;
use crate::panes::inspector::thumbnail::Thumbnails;
use crate::session::Session;

/// The inspector.
#[derive(Debug)]
pub(crate) struct Inspector {
    thumbnails: Thumbnails,
}

impl Inspector {
    /// Starts the thread that reads thumbnails.
    pub(crate) fn new(context: &egui::Context) -> Inspector {
        Inspector { thumbnails: Thumbnails::start(context) }
    }

    /// Whether no thumbnail is being read.
    pub(crate) fn is_idle(&self) -> bool {
        self.thumbnails.is_idle()
    }

    /// Draws what there is to be known and set of the selection.
    pub(crate) fn show(&mut self, ui: &mut egui::Ui, session: &Session, actions: &mut Vec<Action>) {
        self.thumbnails.hear(ui.ctx(), session.pictures());
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(8).show(ui, |ui| {
                let mut selected = session.selection().iter();
                match (selected.next(), selected.next()) {
                    (None, _) => match session.group().and_then(|id| Some((id, session.document().groups.get(id)?))) {
                        Some((id, group)) => group::show(ui, session, id, group, actions),
                        None => material::show(ui, session, actions),
                    },
                    (Some(id), None) => {
                        let before = actions.len();
                        node::show(ui, session, id, &mut self.thumbnails, actions);
                        actions[before..].iter_mut().for_each(|action| at_work(session, action));
                    }
                    _ => {
                        let before = actions.len();
                        several::show(ui, session, actions);
                        actions[before..].iter_mut().for_each(|action| at_work(session, action));
                    }
                }
            });
        });
    }
}

/// An edit of a node is one of the graph that is worked on, which may be the inside of a group.
fn at_work(session: &Session, action: &mut Action) {
    if let Action::Edit { edit, .. } = action {
        let plain = std::mem::replace(edit, Edit::Many(Vec::new()));
        *edit = session.here(plain);
    }
}
