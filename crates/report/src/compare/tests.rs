//! What is told of two reports.

use super::*;
use crate::Effort;

fn report(times: [f64; 3], errors: [f64; 3]) -> Report {
    let mut report = Report::begun(Effort::Quick);
    report.rows = (0..3)
        .map(|i| Row {
            cost_ns: Some(times[i]),
            cost_spread: Some(0.01),
            error_rms: Some(errors[i]),
            ..Row::new("d", ["a", "b", "c"][i], "all")
        })
        .collect();
    report
}

fn whats(old: &Report, new: &Report) -> Vec<&'static str> {
    changes(old, new).iter().map(|change| change.what).collect()
}

#[test]
fn only_what_is_worse_beyond_noise_is_told() {
    let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
    assert_eq!(changes(&old, &old), []);
    // Another machine: three times as slow throughout, a little noise.
    assert_eq!(changes(&old, &report([3.0, 6.3, 12.0], [0.1, 0.2, 1e-12])), []);
    let worse = changes(&old, &report([1.0, 2.0, 6.0], [0.1, 0.3, 0.0]));
    assert_eq!(
        worse.iter().map(|c| (c.what, c.method.as_str())).collect::<Vec<_>>(),
        [("slower", "c"), ("less accurate", "b")]
    );
    assert!(worse[0].to_string().starts_with("slower: d c: one call takes 6.000 ns, was 4.000 ns; 1.50 times"));
}

/// What a quiet machine sees, 1.3 times, and what both runs were unsure of, they do not tell apart.
#[test]
fn a_slowdown_is_told_beyond_the_spreads_of_both_runs() {
    let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
    let mut new = report([1.0, 2.0, 1.3 * 4.0], [0.1, 0.2, 0.0]);
    assert_eq!(changes(&old, &new).len(), 1);
    new.rows[2].cost_spread = Some(0.2);
    assert_eq!(changes(&old, &new), []);
}

/// A slow moment of the machine meets the yardstick, too.
#[test]
fn a_slow_moment_is_not_a_slow_method() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
    old.rows.iter_mut().for_each(|row| row.yardstick_ns = Some(4.0));
    let mut new = report([1.0, 2.0, 8.0], [0.1, 0.2, 0.0]);
    new.rows.iter_mut().for_each(|row| row.yardstick_ns = Some(4.0));
    assert_eq!(changes(&old, &new).len(), 1);
    new.rows[2].yardstick_ns = Some(8.0);
    assert_eq!(changes(&old, &new), []);
    // It slows one method more than the yardstick.
    (new.rows[2].cost_ns, new.rows[2].yardstick_ns) = (Some(1.6 * 4.0), Some(1.3 * 4.0));
    new.rows[2].cost_spread = Some(0.0);
    assert_eq!(changes(&old, &new), []);
}

#[test]
fn a_batch_has_its_own_spread_and_needs_a_difference_that_is_seen() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
    (old.rows[0].cost_batch_ns, old.rows[0].cost_batch_spread) = (Some(0.1), Some(0.01));
    let mut new = old.clone();
    new.rows[0].cost_batch_ns = Some(0.14);
    assert_eq!(changes(&old, &new), []);
    new.rows[0].cost_batch_ns = Some(0.2);
    assert_eq!(changes(&old, &new)[0].figure, "an element of a batch");
}

/// Errors of other inputs, or found by another search, are not held against each other.
#[test]
fn errors_of_other_points_are_not_compared() {
    let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    let mut new = report([1.0, 2.0, 4.0], [0.1, 0.9, 0.3]);
    assert_eq!(whats(&old, &new), ["less accurate"]);
    new.rows[1].points = Some(16_384);
    assert_eq!(changes(&old, &new), []);

    // A search may end a little elsewhere on another machine.
    let of = |most: f64| {
        let mut report = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
        (report.rows[1].error_max, report.rows[1].searched) = (Some(most), true);
        report
    };
    assert_eq!(changes(&of(1.0), &of(1.2)), []);
    assert_eq!(whats(&of(1.0), &of(1.3)), ["less accurate"]);
}

#[test]
fn longer_shaders_are_told() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.rows[0].instructions = Some(400);
    let mut new = old.clone();
    new.rows[0].instructions = Some(430);
    assert_eq!(whats(&old, &new), ["longer"]);
    new.rows[0].instructions = Some(404);
    assert_eq!(changes(&old, &new), []);
}

/// An error that noise hides has not grown, and one that it hid has grown when it is more than it can have been.
#[test]
fn errors_below_noise_are_weighed_by_their_bounds() {
    let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    let mut new = old.clone();
    (new.rows[1].error_rms, new.rows[1].error_bound) = (None, Some(0.4));
    assert_eq!(changes(&old, &new), []);
    assert_eq!(changes(&new, &old), []);
    // What is less sure than before is told.
    let hidden = |bound| {
        let mut report = old.clone();
        (report.rows[1].error_rms, report.rows[1].error_bound) = (None, Some(bound));
        report
    };
    assert_eq!(whats(&old, &hidden(0.5)), ["less sure"]);
    assert_eq!(whats(&hidden(0.4), &hidden(0.41)), [""; 0]);
    let found = changes(&hidden(0.4), &hidden(0.5));
    assert!(
        found[0]
            .to_string()
            .starts_with("less sure: d b: the noise hides an rms error of at most 5.000e-1, was at most 4.000e-1"),
        "{}",
        found[0]
    );
    new.rows[1].error_bound = Some(0.15);
    assert_eq!(changes(&new, &old).iter().map(|c| c.what).collect::<Vec<_>>(), ["less accurate"]);
}

#[test]
fn a_lost_row_and_lost_numbers_are_told_and_other_points_are_not_compared() {
    let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    let mut new = old.clone();
    new.rows[0].not_finite = Some(2);
    new.rows[1].error_rms = None;
    new.rows.pop();
    (new.parts, new.rows[0].part) = (vec!["brdf".into()], "brdf".into());
    let found: Vec<_> = changes(&old, &new).iter().map(|c| c.what).collect();
    assert_eq!(found, ["more results that are no numbers", "less accurate", "gone"]);
    new.effort = Effort::Full;
    assert_eq!(changes(&old, &new).iter().map(|c| c.what).collect::<Vec<_>>(), ["gone"]);
}

/// A part that was not measured again has lost nothing.
#[test]
fn rows_of_other_parts_are_not_missed() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.parts = vec!["brdf".into(), "shaders".into()];
    for (row, part) in old.rows.iter_mut().zip(["brdf", "brdf", "shaders"]) {
        row.part = part.into();
    }
    let mut new = Report { parts: vec!["brdf".into()], ..old.clone() };
    new.rows.truncate(2);
    assert_eq!(changes(&old, &new), []);
    new.rows.truncate(1);
    assert_eq!(changes(&old, &new).iter().map(|c| (c.what, c.method.as_str())).collect::<Vec<_>>(), [("gone", "b")]);
}

#[test]
fn what_is_slower_once_is_measured_again_and_told_when_it_stays_so() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.rows[2].part = "brdf".into();
    let mut new = old.clone();
    (new.rows[2].cost_ns, new.rows[0].error_rms) = (Some(8.0), Some(0.2));
    let mut found = changes(&old, &new);
    assert_eq!(found.iter().map(|c| c.what).collect::<Vec<_>>(), ["slower", "less accurate"]);
    assert_eq!(doubtful(&found, &new), HashSet::from(["brdf"]));
    let mut again = found.clone();
    confirm(&mut found, &again, &new);
    assert_eq!(found.len(), 2);
    // Another figure of the row says nothing of this one.
    again[0].figure = "an element of a batch";
    let mut of_another = found.clone();
    confirm(&mut of_another, &again, &new);
    assert_eq!(of_another.len(), 1);
    confirm(&mut found, &[], &new);
    assert_eq!(found.iter().map(|c| c.what).collect::<Vec<_>>(), ["less accurate"]);
}

/// A run that measured in a slow moment neither confirms nor denies; what no run confirms is not told.
#[test]
fn a_strained_run_abstains() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.rows.iter_mut().for_each(|row| row.yardstick_ns = Some(4.0));
    let mut new = old.clone();
    new.rows[2].cost_ns = Some(8.0);
    let mut strained = new.clone();
    strained.rows[2].yardstick_ns = Some(6.0);
    assert_eq!(changes(&old, &strained), []);

    let mut found = changes(&old, &new);
    confirm(&mut found, &[], &strained);
    assert_eq!(found.len(), 1);
    let mut unconfirmed = found.clone();
    settle(&mut unconfirmed);
    assert_eq!(unconfirmed, []);
    confirm(&mut found, &changes(&old, &new), &new);
    confirm(&mut found, &[], &strained);
    settle(&mut found);
    assert_eq!(found.len(), 1);
    // A calm run that does not see it denies it.
    confirm(&mut found, &[], &old);
    assert_eq!(found, []);
}

/// Bakes and pictures run too seldom to know their spread: half as much again is told.
#[test]
fn times_without_a_spread_have_a_tolerance() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.rows[2].cost_spread = None;
    let mut new = old.clone();
    new.rows[2].cost_ns = Some(1.4 * 4.0);
    assert_eq!(changes(&old, &new), []);
    new.rows[2].cost_ns = Some(1.6 * 4.0);
    assert_eq!(whats(&old, &new), ["slower"]);
}

/// The device has a speed of its own, no yardstick, and no ratio to another device.
#[test]
fn times_of_the_device_are_compared_by_themselves() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    for (row, time) in old.rows.iter_mut().zip([200.0, 300.0, 400.0]) {
        (row.gpu_ns, row.gpu_spread, row.gpu, row.yardstick_ns) = (Some(time), Some(0.02), Some("x".into()), Some(4.0));
    }
    let mut new = old.clone();
    // A slower processor is no slower device.
    new.rows.iter_mut().for_each(|row| row.cost_ns = row.cost_ns.map(|time| 3.0 * time));
    assert_eq!(changes(&old, &new), []);
    new.rows[1].gpu_ns = Some(400.0);
    let found = changes(&old, &new);
    assert_eq!(found.iter().map(|c| (c.what, c.figure)).collect::<Vec<_>>(), [("slower", "a pixel on the device")]);
    new.rows.iter_mut().for_each(|row| row.gpu = Some("y".into()));
    assert_eq!(changes(&old, &new), []);
    assert_eq!(other_device(&old, &new), Some(["x", "y"]));
}

#[test]
fn more_memory_and_less_likeness_are_told() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    (old.rows[0].bytes, old.rows[1].flip) = (Some(8100), Some(0.02));
    let mut new = old.clone();
    (new.rows[0].bytes, new.rows[1].flip) = (Some(8200), Some(0.0209));
    assert_eq!(changes(&old, &new), []);
    (new.rows[0].bytes, new.rows[1].flip) = (Some(16200), Some(0.03));
    assert_eq!(whats(&old, &new), ["larger", "less alike"]);
}

/// A figure that is not there any more is told; what is shared among the rows of a method once, and only where it was measured.
#[test]
fn lost_figures_are_told() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.parts = vec!["brdf".into()];
    for row in &mut old.rows {
        (row.part, row.method) = ("brdf".into(), "a".into());
        (row.bytes, row.flip, row.cost_batch_ns) = (Some(4), Some(0.1), Some(1.0));
        (row.instructions, row.gpu_ns, row.gpu) = (Some(300), Some(200.0), Some("x".into()));
    }
    old.rows.iter_mut().zip(["one", "two", "three"]).for_each(|(row, domain)| row.domain = domain.into());
    let mut new = old.clone();
    for row in &mut new.rows {
        (row.instructions, row.gpu_ns) = (None, None);
    }
    assert_eq!(changes(&old, &new), []);
    new.parts.push("shaders".into());
    let figures = |new: &Report| changes(&old, new).iter().map(|c| c.figure).collect::<Vec<_>>();
    assert_eq!(figures(&new), ["instructions", "time of a pixel on the device"]);
    let mut new = old.clone();
    (new.rows[0].bytes, new.rows[0].flip) = (None, None);
    (new.rows[1].cost_ns, new.rows[1].cost_batch_ns) = (None, None);
    assert_eq!(figures(&new), ["memory", "FLIP", "time of one call", "time of an element of a batch"]);
}

/// A machine without a device loses all that was measured on one: that is said once.
#[test]
fn a_lost_device_is_told_once() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.parts = vec!["shaders".into()];
    for row in &mut old.rows {
        (row.part, row.gpu_ns, row.gpu) = ("shaders".into(), Some(200.0), Some("x".into()));
    }
    let mut new = old.clone();
    new.rows.pop();
    for row in &mut new.rows {
        (row.gpu_ns, row.gpu) = (None, None);
    }
    new.left_out = vec![LeftOut { part: "shaders".into(), what: Some(DEVICE.into()), why: "none was found".into() }];
    let found = changes(&old, &new);
    assert_eq!(found.iter().map(|c| (c.what, c.term.as_str())).collect::<Vec<_>>(), [("gone", "device")]);
}

/// What is not measured is told with its reason: a whole part once, and not as a device that is gone; an example by its rows.
#[test]
fn what_is_left_out_is_told_with_its_reason() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.parts = vec!["pictures".into()];
    for (row, domain) in old.rows.iter_mut().zip(["helmet.scene: a picture", "ball.scene: a picture", "x: a picture"]) {
        (row.part, row.domain, row.gpu) = ("pictures".into(), domain.into(), Some("x".into()));
    }
    let left = |what: Option<&str>| LeftOut {
        part: "pictures".into(),
        what: what.map(str::to_owned),
        why: "no such file".into(),
    };
    let mut new = Report { rows: Vec::new(), left_out: vec![left(None)], ..old.clone() };
    let found = changes(&old, &new);
    assert_eq!(found.len(), 1);
    assert!(found[0].to_string().starts_with("gone: part pictures: ") && found[0].figures.ends_with("no such file"));
    new.rows = old.rows[1..].to_vec();
    new.left_out = vec![left(Some("helmet.scene"))];
    let found = changes(&old, &new);
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].method.as_str(), found[0].figures.ends_with(": no such file")), ("a", true));
    // One drawer of an example.
    new.left_out = vec![left(Some("helmet.scene, a"))];
    assert!(changes(&old, &new)[0].figures.ends_with(": no such file"));
    new.left_out = vec![left(Some("helmet.scene, b"))];
    assert!(!changes(&old, &new)[0].figures.ends_with(": no such file"));
}

/// Peers are compared like all else; what is recorded is not compared, and one that is only recorded now is missed.
#[test]
fn peers_are_compared_where_they_are_measured() {
    let mut old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.3]);
    old.parts = vec!["peers".into()];
    old.rows.iter_mut().for_each(|row| (row.part, row.term) = ("peers".into(), "peer".into()));
    let mut new = old.clone();
    new.rows[2].cost_ns = Some(8.0);
    (new.rows[1].recorded, new.rows[1].note) = (Some("2026-11-23, a machine".into()), Some("no such program".into()));
    let found = changes(&old, &new);
    assert_eq!(found.iter().map(|c| c.what).collect::<Vec<_>>(), ["slower", "gone"]);
    assert!(found[1].to_string().contains("not measured any more: no such program"), "{}", found[1]);
    assert_eq!(changes(&new, &new), []);
}

/// What the noise of either run hides is counted, each time once, with how much it may be.
#[test]
fn what_could_not_be_judged_is_counted() {
    let old = report([1.0, 2.0, 4.0], [0.1, 0.2, 0.0]);
    assert_eq!(hidden(&old, &old), None);
    let mut strained = old.clone();
    strained.rows.iter_mut().for_each(|row| row.yardstick_ns = Some(3.5));
    (strained.rows[1].yardstick_ns, strained.rows[2].cost_spread) = (Some(5.2), Some(0.54));
    strained.rows.push(Row { domain: "elsewhere".to_owned(), ..strained.rows[1].clone() });
    let found = hidden(&strained, &strained).expect("two of three");
    assert_eq!((found.count, found.of), (2, 3));
    assert!((found.most - 2.79).abs() < 0.02, "{found:?}");
    assert!(found.to_string().contains("could not be judged: 2 of 3 times"), "{found}");
}
