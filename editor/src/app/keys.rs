//! The one table of the window's keys: it drives them, the menus show them, and the help sheet is made of it. Panes list their
//! own keys for the sheet.

use eframe::egui::{self, Key, KeyboardShortcut, Modifiers};

use crate::app::Pane;

/// What the window does by key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Command {
    /// A new material.
    New,
    /// A file dialog to open one.
    Open,
    /// Writes the document to its file.
    Save,
    /// A file dialog to write it elsewhere.
    SaveAs,
    /// Closes the window.
    Close,
    /// Takes a step back.
    Undo,
    /// Does it again.
    Redo,
    /// The help sheet.
    Help,
    /// Brings a part of the window to the front and gives it the focus.
    Pane(Pane),
    /// Gives the focus to the menu.
    Menu,
}

/// A command with its keys; any of them does it.
pub(crate) struct Shortcut {
    /// What it does.
    pub(crate) command: Command,
    /// The first one is shown.
    pub(crate) keys: &'static [KeyboardShortcut],
    /// What it does, in the sheet.
    pub(crate) what: &'static str,
    /// Whether it also holds while text is written.
    pub(crate) while_writing: bool,
}

/// A key that a pane takes itself, for the sheet.
pub(crate) struct Hint {
    /// The keys or the gesture, as people write them.
    pub(crate) keys: &'static str,
    /// What it does.
    pub(crate) what: &'static str,
}

const fn command(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn shifted(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), key)
}

const fn alone(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

/// All of the window's. Longer combinations stand before the shorter ones that would take them.
pub(crate) const SHORTCUTS: &[Shortcut] = &[
    Shortcut { command: Command::New, keys: &[command(Key::N)], what: "New material", while_writing: true },
    Shortcut { command: Command::Open, keys: &[command(Key::O)], what: "Open a material", while_writing: true },
    Shortcut {
        command: Command::SaveAs,
        keys: &[shifted(Key::S)],
        what: "Save under another name",
        while_writing: true,
    },
    Shortcut { command: Command::Save, keys: &[command(Key::S)], what: "Save", while_writing: true },
    Shortcut { command: Command::Close, keys: &[command(Key::Q)], what: "Close the window", while_writing: true },
    Shortcut {
        command: Command::Redo,
        keys: &[shifted(Key::Z), command(Key::Y)],
        what: "Do again what was undone",
        while_writing: false,
    },
    Shortcut { command: Command::Undo, keys: &[command(Key::Z)], what: "Undo", while_writing: false },
    Shortcut {
        command: Command::Help,
        keys: &[alone(Key::F1), alone(Key::Questionmark)],
        what: "This sheet",
        while_writing: false,
    },
    Shortcut { command: Command::Menu, keys: &[alone(Key::F10)], what: "Go to the menu", while_writing: true },
    Shortcut {
        command: Command::Pane(Pane::Canvas),
        keys: &[command(Key::Num1)],
        what: "Go to the graph",
        while_writing: true,
    },
    Shortcut {
        command: Command::Pane(Pane::Viewport),
        keys: &[command(Key::Num2)],
        what: "Go to the viewport",
        while_writing: true,
    },
    Shortcut {
        command: Command::Pane(Pane::Inspector),
        keys: &[command(Key::Num3)],
        what: "Go to the inspector: the values of what is selected",
        while_writing: true,
    },
    Shortcut {
        command: Command::Pane(Pane::Code),
        keys: &[command(Key::Num4)],
        what: "Go to the code",
        while_writing: true,
    },
    Shortcut {
        command: Command::Pane(Pane::Problems),
        keys: &[command(Key::Num5)],
        what: "Go to the problems",
        while_writing: true,
    },
];

/// Keys that egui itself takes.
pub(crate) const EVERYWHERE: &[Hint] = &[
    Hint { keys: "Tab, Shift+Tab", what: "Next or previous control" },
    Hint { keys: "Space or Enter", what: "Press the control that has the focus" },
    Hint { keys: "Arrow keys", what: "Change the slider that has the focus" },
    Hint { keys: "Double click on a number", what: "Write it" },
    Hint { keys: "Esc", what: "Leave a dialog, a menu or a text" },
    Hint { keys: "Ctrl +, Ctrl -, Ctrl 0", what: "Larger, smaller, usual size of everything" },
];

/// The commands whose keys were pressed, in the order of the table; one that was pressed twice since the last frame, twice.
pub(crate) fn pressed(context: &egui::Context) -> Vec<Command> {
    let writes = context.text_edit_focused();
    context.input_mut(|input| {
        let mut pressed = Vec::new();
        for shortcut in SHORTCUTS.iter().filter(|shortcut| shortcut.while_writing || !writes) {
            // All are consumed, so that none does two things.
            let hits = |keys: &KeyboardShortcut| input.count_and_consume_key(keys.modifiers, keys.logical_key);
            let hits = shortcut.keys.iter().map(hits).sum();
            pressed.extend(std::iter::repeat_n(shortcut.command, hits));
        }
        pressed
    })
}

/// The keys of a command as people write them.
pub(crate) fn text(context: &egui::Context, command: Command) -> String {
    let shortcut = SHORTCUTS.iter().find(|shortcut| shortcut.command == command);
    shortcut.and_then(|shortcut| shortcut.keys.first()).map_or_else(String::new, |keys| context.format_shortcut(keys))
}
