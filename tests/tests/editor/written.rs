//! Numbers as people write them: what is read, and what becomes of what is not.

use egui_kittest::kittest::Queryable;
use halfvector_editor::written::{Kind, numbers};
use halfvector_editor::{Action, Options, egui};
use halfvector_graph::document::SocketRef;
use halfvector_graph::value::Value;

use super::hands::*;
use super::open;

const NONE: egui::Modifiers = egui::Modifiers::NONE;

#[test]
fn numbers_are_read_with_a_point_or_a_comma() {
    let read = |text: &str, count: usize| numbers(text, count, Kind::default());
    for (text, count, expected) in [
        ("0.5", 1, vec![0.5]),
        (" 0,5 ", 1, vec![0.5]),
        ("-0,25", 1, vec![-0.25]),
        ("\u{2212}2", 1, vec![-2.0]),
        (",5", 1, vec![0.5]),
        ("0,125", 1, vec![0.125]),
        ("1234,567", 1, vec![1234.567]),
        ("1e-3", 1, vec![0.001]),
        ("1, 2, 3", 3, vec![1.0, 2.0, 3.0]),
        ("1,2,3", 3, vec![1.0, 2.0, 3.0]),
        ("1 2 3", 3, vec![1.0, 2.0, 3.0]),
        ("0,5; 0,2; 1", 3, vec![0.5, 0.2, 1.0]),
        ("0,5 0,2 0,1", 3, vec![0.5, 0.2, 0.1]),
        ("0,5, 0,2, 0,1", 3, vec![0.5, 0.2, 0.1]),
        ("0,5", 3, vec![0.5; 3]),
        ("0.5", 4, vec![0.5; 4]),
        // As the field itself writes two numbers.
        ("0,5", 2, vec![0.0, 5.0]),
        ("0,5 0,2", 2, vec![0.5, 0.2]),
    ] {
        assert_eq!(read(text, count), Ok(expected), "{text}");
    }
    let degrees = Kind { unit: "°", ..Kind::default() };
    assert_eq!(numbers("45°", 1, degrees), Ok(vec![45.0]));
    assert_eq!(numbers("45", 1, degrees), Ok(vec![45.0]));
}

#[test]
fn what_is_no_number_says_why() {
    let why = |text: &str, count: usize| numbers(text, count, Kind::default()).expect_err(text);
    assert_eq!(why("abc", 1), "“abc” is no number");
    assert_eq!(why("0.5x", 1), "“0.5x” is no number");
    assert_eq!(why("", 1), "nothing was written");
    assert!(why("1,000", 1).contains("1.000 or 1000"), "{}", why("1,000", 1));
    assert_eq!(why("1.000,5", 1), "“1.000,5” is no number");
    assert_eq!(why("1,2,3", 1), "“1,2,3” is no number");
    assert!(why("1e39", 1).contains("beyond the largest"));
    assert!(why("1e999", 1).contains("beyond the largest"));
    assert_eq!(why("inf", 1), "“inf” is no number");
    assert_eq!(why("NaN", 1), "“NaN” is no number");
    assert_eq!(why("1, 2", 3), "“1, 2” are 2 numbers; write 3, or one for all");
    assert_eq!(why("1, x, 3", 3), "“x” is no number");
    assert_eq!(numbers("1.5", 1, Kind { is_whole: true, unit: "" }), Err("“1.5” is no whole number".to_owned()));
}

proptest::proptest! {
    /// Whatever is written: as many finite numbers as wanted, or words.
    #[test]
    fn any_text_is_numbers_or_a_reason(text in ".{0,16}", digits in "[-+0-9,.; e]{0,16}", count in 1..5usize) {
        for text in [text, digits] {
            match numbers(&text, count, Kind::default()) {
                Ok(numbers) => {
                    assert_eq!(numbers.len(), count);
                    assert!(numbers.iter().all(|x| (*x as f32).is_finite()));
                }
                Err(why) => assert!(!why.is_empty()),
            }
        }
    }
}

fn value(window: &Window, node: &str, input: &str) -> Option<Value> {
    document(window).graph.value(&SocketRef::new(node, input)).cloned()
}

/// Writes over what stands in the field that has the focus, and presses a key.
fn over(window: &mut Window, text: &str, done: egui::Key) {
    key(window, egui::Modifiers::COMMAND, egui::Key::A);
    if text.is_empty() {
        key(window, NONE, egui::Key::Backspace);
    } else {
        write(window, text);
    }
    key(window, NONE, done);
    window.run_steps(2);
}

/// Clicks on the value of an input on its card.
fn open_field(window: &mut Window, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

fn is_told(window: &Window, words: &str) -> bool {
    window.query_all_by_label_contains(words).next().is_some()
}

#[test]
fn a_card_takes_a_decimal_comma_and_says_what_it_does_not_take() {
    let mut window = open(Options::default());
    window.run_steps(3);
    let field = "Value perceptual_roughness of Surface";
    let field = if window.query_by_label(field).is_some() { field } else { "Value metallic of Surface" };
    let input = field.split(' ').nth(1).expect("an input").to_owned();
    open_field(&mut window, field);
    over(&mut window, "0,25", egui::Key::Enter);
    assert_eq!(value(&window, "surface", &input), Some(Value::Number(0.25)));
    let before = text(&window);
    for (wrong, why) in [("abc", "“abc” is no number"), ("1,000", "1.000 or 1000"), ("", "Nothing was written")] {
        open_field(&mut window, field);
        over(&mut window, wrong, egui::Key::Enter);
        assert!(is_told(&window, why), "{wrong}");
        assert!(is_told(&window, "it stays 0.25"), "{wrong}");
        assert_eq!(text(&window), before);
        // It is written there still: what is right now is taken.
        assert!(window.query_by_role_and_label(egui::accesskit::Role::TextInput, "Value").is_some(), "{wrong}");
        key(&mut window, NONE, egui::Key::Escape);
        window.run_steps(2);
    }
    open_field(&mut window, field);
    over(&mut window, "abc", egui::Key::Enter);
    over(&mut window, "0.5", egui::Key::Enter);
    assert_eq!(value(&window, "surface", &input), Some(Value::Number(0.5)));
    assert_eq!(window.state().session().steps()[0].map(str::to_owned), Some(format!("Set {input}")));
}

#[test]
fn the_inspector_takes_a_decimal_comma_and_says_what_it_does_not_take() {
    let mut window = open(Options::default());
    window.state_mut().act(Action::Select(vec!["surface".into()]));
    window.run_steps(4);
    let before = text(&window);
    let field = |window: &Window| {
        let fields = window.get_all_by_role_and_label(egui::accesskit::Role::SpinButton, "ior");
        fields.last().expect("a field").rect().center()
    };
    let write_there = |window: &mut Window, text: &str, done: egui::Key| {
        let at = field(window);
        go(window, at);
        press(window, at, true, NONE);
        press(window, at, false, NONE);
        window.run_steps(2);
        over(window, text, done);
    };
    write_there(&mut window, "1,75", egui::Key::Enter);
    assert_eq!(value(&window, "surface", "ior"), Some(Value::Number(1.75)));
    key(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    assert_eq!(text(&window), before);
    // What begins as a number and is none leaves nothing behind, no step either.
    for (wrong, why) in [("1.6abc", "“1.6abc” is no number; it stays 1.5"), ("1,000", "1.000 or 1000")] {
        write_there(&mut window, wrong, egui::Key::Tab);
        assert!(is_told(&window, why), "{wrong}");
        assert_eq!(text(&window), before, "{wrong}");
        assert_eq!(window.state().session().steps()[0], None, "{wrong}");
    }
    // Escape drops what was written.
    write_there(&mut window, "1.9", egui::Key::Escape);
    assert_eq!(text(&window), before);
    assert_eq!(window.state().session().steps()[0], None);
}
