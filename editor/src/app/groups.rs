//! Groups as files: one of the document's is written with all that it needs, and one that was read becomes a node.

use std::path::Path;

use halfvector_graph::check::node_label;
use halfvector_graph::file::GroupFile;
use halfvector_graph::library::Library;
use halfvector_graph::operation::{Pasted, Refusal, export_group, group_as_copied, paste};

use crate::action::Action;
use crate::app::Editor;
use crate::app::files::absolute;
use crate::files::clerk::Order;
use crate::session::with_images_moved;

impl Editor {
    /// Writes a group to a file, from where its pictures are the same files.
    pub(crate) fn save_group(&self, id: &str, path: &Path) -> Result<(), String> {
        let path = absolute(path);
        let document = self.session.document();
        let folder = path.parent().unwrap_or(Path::new(""));
        let moved = with_images_moved(document, &self.session.directory(), folder);
        let group = export_group(moved.as_ref().unwrap_or(document), id)
            .map_err(|Refusal(why)| format!("the group cannot be saved: {why}"))?;
        self.files.order(Order::SaveGroup { path, group: Box::new(group) });
        Ok(())
    }

    /// Adds a node of a group that was read, in the middle of what is seen of the graph.
    pub(crate) fn add_group(&mut self, path: &Path, read: Result<GroupFile, String>) {
        let added = read
            .and_then(|file| self.group_added(path, file).map_err(|Refusal(why)| format!("{}: {why}", path.display())));
        match added {
            Ok(actions) => actions.into_iter().for_each(|action| self.act(action)),
            Err(why) => self.messages.fail(why),
        }
    }

    fn group_added(&self, path: &Path, file: GroupFile) -> Result<[Action; 3], Refusal> {
        let (session, library) = (&self.session, Library::standard());
        let copied = group_as_copied(file)?;
        let from = absolute(path).parent().map(Path::to_owned).unwrap_or_default();
        let copied = with_images_moved(&copied, &from, &session.directory()).unwrap_or(copied);
        let label = copied.graph.nodes.keys().next().map(|id| node_label(&copied.graph, &library.of(&copied), id));
        let label = label.unwrap_or_default();
        let at = self.panes.canvas.middle();
        let Pasted { edit, pick, .. } = paste(session.document(), library, session.group(), &copied, at)?;
        let shown = pick.nodes.into_iter().next().map_or(Action::Select(Vec::new()), Action::Show);
        Ok([Action::edit(format!("Add {label}"), edit), shown, Action::Say(format!("Added {label}"))])
    }
}
