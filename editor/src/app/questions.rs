//! The window's questions: dialogs that wait for an answer, and strips at its top that do not.

use std::path::PathBuf;

use eframe::egui;

use crate::app::Editor;
use crate::app::files::Next;
use crate::files::clerk::Order;
use crate::files::difference::differences;
use crate::theme;

/// How many changes of what was left are listed.
const CHANGES_SHOWN: usize = 3;

/// What a dialog asks.
#[derive(Debug)]
pub(crate) enum Question {
    /// The document is not saved, and this would lose it.
    Unsaved(Next),
    /// Others have changed the file that is to be written.
    Overwrite(PathBuf),
    /// Another file has the name that the material is to be saved under.
    Replace(PathBuf),
    /// Windows that are gone have left unsaved work.
    Lost,
    /// The file that was to be opened cannot be read: which, and why.
    Broken(PathBuf, String),
    /// The sheet of keys.
    Keys,
    /// What this program is.
    About,
}

/// The answers to a dialog.
#[derive(Clone, Copy)]
enum Answer {
    Save,
    SaveAs,
    Discard,
    Cancel,
    Overwrite,
    Reload,
    Recover(usize),
    Forget(usize),
    Later,
    OpenAgain,
    OpenOther,
}

impl Editor {
    /// Draws the dialog that is open, and takes its answer.
    pub(crate) fn show_question(&mut self) {
        let Some(question) = &self.files.question else { return };
        let mut answer = None;
        let context = self.context.clone();
        let modal = egui::Modal::new(egui::Id::new("question")).show(&context, |ui| {
            ui.set_width(460.0);
            match question {
                Question::Unsaved(next) => answer = self.ask_unsaved(ui, next),
                Question::Overwrite(path) => answer = ask_overwrite(ui, path, self.files.is_recovered),
                Question::Replace(path) => answer = ask_replace(ui, path),
                Question::Lost => answer = self.ask_lost(ui),
                Question::Broken(path, why) => answer = self.ask_broken(ui, path, why),
                Question::Keys => answer = crate::app::sheet::keys(ui).then_some(Answer::Cancel),
                Question::About => answer = crate::app::sheet::about(ui).then_some(Answer::Cancel),
            }
        });
        if answer.is_none() && modal.should_close() {
            answer = Some(if matches!(question, Question::Lost) { Answer::Later } else { Answer::Cancel });
        }
        if let Some(answer) = answer {
            self.take(answer);
        }
    }

    fn take(&mut self, answer: Answer) {
        let question = self.files.question.take();
        match (answer, question) {
            (Answer::Save, Some(Question::Unsaved(next))) => self.save_then(next),
            (Answer::Discard, Some(Question::Unsaved(next))) => self.go(next),
            (Answer::Overwrite, Some(Question::Overwrite(path) | Question::Replace(path))) => self.save_as(path, true),
            (Answer::OpenAgain, Some(Question::Broken(path, _))) => self.ask(Next::Open(path)),
            (Answer::OpenOther, _) => self.choose(crate::action::Choose::Open),
            (Answer::SaveAs, _) => self.choose(crate::action::Choose::SaveAs),
            (Answer::Reload, _) => {
                self.cancel();
                self.reload_file();
            }
            (Answer::Recover(place), question) => {
                let lost = self.files.lost.remove(place);
                let more = !self.files.lost.is_empty();
                self.ask(Next::Recover(Box::new(lost)));
                if more && self.files.question.is_none() {
                    self.files.question = question;
                }
            }
            (Answer::Forget(place), question) => {
                let lost = self.files.lost.remove(place);
                self.files.order(Order::Forget(lost));
                self.files.question = question.filter(|_| !self.files.lost.is_empty());
            }
            (Answer::Later, _) => {}
            // What was to be recovered is offered again.
            (_, Some(Question::Unsaved(Next::Recover(lost)))) => {
                self.files.lost.push(*lost);
                self.cancel();
            }
            _ => self.cancel(),
        }
    }

    /// Reads the open file again, whatever is lost.
    fn reload_file(&mut self) {
        if let Some(path) = self.session.file() {
            self.go(Next::Open(path.to_owned()));
        }
    }

    fn ask_unsaved(&self, ui: &mut egui::Ui, next: &Next) -> Option<Answer> {
        let what = match next {
            Next::New | Next::NewFrom(_) => "before a new one is begun",
            Next::Open(_) => "before another one is opened",
            Next::Recover(_) => "before the other one is recovered",
            Next::Close => "before the window closes",
        };
        ui.heading(format!("Save “{}”?", self.session.document().name));
        ui.label(format!("It has changes that no file holds. Save them {what}?"));
        buttons(
            ui,
            &[
                ("Save", "Write the changes to the file", Answer::Save),
                ("Discard", "The changes are lost", Answer::Discard),
                ("Cancel", "Go on as before", Answer::Cancel),
            ],
        )
    }

    fn ask_broken(&self, ui: &mut egui::Ui, path: &std::path::Path, why: &str) -> Option<Answer> {
        ui.heading("The file cannot be opened");
        ui.add(egui::Label::new(why).wrap());
        ui.add_space(4.0);
        ui.add(egui::Label::new(format!(
            "{} stays as it is: “{}” is open here instead, and saving it asks for a file of its own. Mend the file in a text \
             editor and try again, or open another one.",
            path.file_name().unwrap_or(path.as_os_str()).display(),
            self.session.document().name
        )).wrap());
        buttons(
            ui,
            &[
                ("Try again", "Read the file again, after it was mended", Answer::OpenAgain),
                ("Open another…", "Choose another material", Answer::OpenOther),
                ("Close", "Go on with what is open here", Answer::Cancel),
            ],
        )
    }

    fn ask_lost(&self, ui: &mut egui::Ui) -> Option<Answer> {
        let mut answer = None;
        ui.heading("Recover unsaved work?");
        ui.label("Halfvector ended without saving this:");
        ui.add_space(4.0);
        for (place, lost) in self.files.lost.iter().enumerate() {
            ui.separator();
            ui.horizontal(|ui| {
                ui.vertical(|ui| {
                    ui.set_width(300.0);
                    ui.strong(&lost.record.name);
                    let file = lost.record.file.as_ref().map(|file| file.display().to_string());
                    ui.add(
                        egui::Label::new(egui::RichText::new(file.as_deref().unwrap_or("never saved")).weak()).wrap(),
                    );
                    ui.weak(format!("kept {}", lost.record.age()));
                    let shown = lost.changes.iter().take(CHANGES_SHOWN);
                    shown.for_each(|line| drop(ui.add(egui::Label::new(egui::RichText::new(line).small()).truncate())));
                    let more = lost.changes.len().saturating_sub(CHANGES_SHOWN);
                    if more > 0 {
                        let rest = lost.changes[CHANGES_SHOWN..].join("\n");
                        ui.label(
                            egui::RichText::new(format!("and {more} more change{}", if more == 1 { "" } else { "s" }))
                                .small(),
                        )
                        .on_hover_text(rest);
                    }
                });
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    if ui.button("Discard").on_hover_text("It is lost for good").clicked() {
                        answer = Some(Answer::Forget(place));
                    }
                    if ui.button("Recover").on_hover_text("Open it here, not saved yet").clicked() {
                        answer = Some(Answer::Recover(place));
                    }
                });
            });
        }
        answer.or(buttons(ui, &[("Later", "The File menu offers it again, and the next start", Answer::Later)]))
    }

    /// Draws what is to be known of the open file, above the panes.
    pub(crate) fn show_strips(&mut self, ui: &mut egui::Ui) {
        if !self.files.also_open.is_empty() {
            let processes: Vec<String> = self.files.also_open.iter().map(u32::to_string).collect();
            let text = format!(
                "This file is open in another window too (process {}). What is saved last stays.",
                processes.join(", ")
            );
            strip(ui, "also_open", &text, |ui| {
                if ui.button("Got it").on_hover_text("Hide this line").clicked() {
                    self.files.also_open.clear();
                }
            });
        }
        self.show_instance(ui);
        self.show_outside(ui);
    }

    fn show_instance(&mut self, ui: &mut egui::Ui) {
        let Some(base) = self.session.base().map(str::to_owned) else { return };
        let text = if self.session.fits_its_file() {
            format!("This is an instance of {base}: its name and the values of its parameters are its own.")
        } else {
            format!(
                "This is an instance of {base} and cannot hold all that was changed. Undo that, or make a material of it."
            )
        };
        let (mut open, mut make) = (false, false);
        strip(ui, "instance", &text, |ui| {
            open = ui.button("Open the base").on_hover_text("The material that this one follows").clicked();
            let hint = "Write it whole to another file: it does not follow its base any more";
            make = ui.button("Make a material of it…").on_hover_text(hint).clicked();
        });
        if open {
            self.ask(Next::Open(self.session.directory().join(base)));
        } else if make {
            self.choose(crate::action::Choose::SaveAs);
        }
    }

    fn show_outside(&mut self, ui: &mut egui::Ui) {
        let Some(outside) = &self.files.outside else { return };
        let (can_reload, is_shown) = (outside.read.is_ok(), outside.is_shown);
        let changed = match self.files.is_recovered {
            true => "The file was changed or saved after this work was left",
            false => "The file was changed by another program",
        };
        let text = match &outside.read {
            Ok(_) => format!("{changed}."),
            Err(why) => format!("{changed} and cannot be read: {why}"),
        };
        let (mut reload, mut keep, mut show) = (false, false, is_shown);
        strip(ui, "outside", &text, |ui| {
            let button = egui::Button::new("Reload");
            let hint = "Take what stands in the file; changes made here are lost";
            reload = ui.add_enabled(can_reload, button).on_hover_text(hint).clicked();
            keep =
                ui.button("Keep mine").on_hover_text("Stay with what is here; saving writes over the file").clicked();
            if can_reload {
                crate::panes::toggle(ui, &mut show, "Show what changed").on_hover_text("List the differences");
            }
        });
        if let Some(outside) = &mut self.files.outside {
            outside.is_shown = show;
            if let (true, Ok(theirs)) = (show, &outside.read) {
                let lines = differences(self.session.document(), &theirs.document);
                egui::Panel::top("differences").show(ui, |ui| {
                    ui.weak("In the file, compared with what is here:");
                    egui::ScrollArea::vertical().max_height(160.0).auto_shrink([false, true]).show(ui, |ui| {
                        lines.iter().for_each(|line| {
                            ui.label(line);
                        });
                    });
                });
            }
        }
        if reload {
            self.reload();
        } else if keep {
            self.keep_mine();
        }
    }
}

fn ask_overwrite(ui: &mut egui::Ui, path: &std::path::Path, is_recovered: bool) -> Option<Answer> {
    let [heading, changed] = match is_recovered {
        true => ["Write over what was saved since?", "was changed or saved after this work was left"],
        false => ["Write over changes of another program?", "was changed since it was opened here"],
    };
    ui.heading(heading);
    ui.label(format!("{} {changed}.", path.display()));
    buttons(
        ui,
        &[
            ("Save as", "Write to another file", Answer::SaveAs),
            ("Overwrite", "The other changes are lost", Answer::Overwrite),
            ("Reload", "Take what stands in the file; changes made here are lost", Answer::Reload),
            ("Cancel", "Do nothing", Answer::Cancel),
        ],
    )
}

fn ask_replace(ui: &mut egui::Ui, path: &std::path::Path) -> Option<Answer> {
    ui.heading("Replace the file?");
    ui.label(format!("{} is there already.", path.display()));
    buttons(
        ui,
        &[
            ("Save as", "Choose another name", Answer::SaveAs),
            ("Replace", "What stands in the file is lost", Answer::Overwrite),
            ("Cancel", "Do nothing", Answer::Cancel),
        ],
    )
}

/// A row of buttons; the first one answers to Enter: never what loses something.
fn buttons(ui: &mut egui::Ui, answers: &[(&str, &str, Answer)]) -> Option<Answer> {
    ui.add_space(12.0);
    ui.horizontal(|ui| {
        let mut answer = None;
        for (place, (text, hint, meaning)) in answers.iter().enumerate() {
            let response = ui.button(*text).on_hover_text(*hint);
            if place == 0 && ui.memory(|memory| memory.focused().is_none()) {
                response.request_focus();
            }
            if response.clicked() {
                answer = Some(*meaning);
            }
        }
        answer
    })
    .inner
}

/// A line across the window with something to know and what can be done.
fn strip(ui: &mut egui::Ui, id: &str, text: &str, add_buttons: impl FnOnce(&mut egui::Ui)) {
    let fill = theme::WARNING.gamma_multiply(0.18);
    let frame = egui::Frame::new().fill(fill).inner_margin(egui::Margin::symmetric(8, 4));
    egui::Panel::top(egui::Id::new(id)).frame(frame).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.label(text);
            add_buttons(ui);
        });
    });
}
