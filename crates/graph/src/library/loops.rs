//! How often the loops and calls of a function of the user's turn: counted in the text, and what cannot be counted is refused.
//! Nothing is run.

use std::collections::{HashMap, HashSet};

use halfvector_shaders::{Item, ItemKind, Token};

use super::borrowed;
use super::custom::{CodeError, MAX_WORK, error_at, integer};

/// Most words and signs of one function: naga's time for a function grows with their square.
const MAX_TOKENS: usize = 1 << 14;
/// What a call of one of the library's functions that have loops counts for: none of them loops much longer.
const LIBRARY_WORK: u64 = 64;
/// Largest number in the head of a loop: far from where a counter would wrap around.
const MAX_COUNT: u64 = 1 << 20;
/// What a loop looks like.
const SHAPE: &str = "a loop counts from a number of the text to another one, at most 1048576: `for (var i = 0; i < 8; i++)`, \
     `for (var i = -1; i <= 1; i++)`, `for (var i = 8; i > 0; i -= 2)`";

/// A loop's turns, and the byte at which its body ends.
struct Turns {
    count: u64,
    until: usize,
}

/// The turns of loops and calls that each function takes, by name. Refuses loops that are not counted, more turns and calls than
/// [`MAX_WORK`], and functions that are too long.
pub(super) fn work<'i>(text: &str, items: &'i [Item], code: &[Token]) -> Result<HashMap<&'i str, u64>, CodeError> {
    let constants = whole_constants(text, items);
    let functions: Vec<&Item> = items.iter().filter(|item| item.kind == ItemKind::Fn).collect();
    let number: HashMap<&str, usize> = functions.iter().enumerate().map(|(i, item)| (item.name.as_str(), i)).collect();
    let mut calls: Vec<Vec<(usize, u64)>> = Vec::new();
    let mut own: Vec<u64> = Vec::new();
    for item in &functions {
        let first = code.partition_point(|token| token.start < item.name_range.end);
        let last = code.partition_point(|token| token.start < item.end);
        if last - first > MAX_TOKENS {
            let message = format!(
                "`{}` has {} words and signs; {MAX_TOKENS} are the most that one function may have: make several of it",
                item.name,
                last - first
            );
            return Err(error_at(text, item.code_start, message));
        }
        let (turns, called) = function_work(text, &code[first..last], &constants, &number)?;
        own.push(turns);
        calls.push(called);
    }
    // Callees before callers; a ring is left to the judge, who names it.
    let mut total: Vec<Option<u64>> = vec![None; functions.len()];
    for root in 0..functions.len() {
        let mut path = vec![(root, 0)];
        let mut on_path: HashSet<usize> = HashSet::from([root]);
        while let Some((at, next)) = path.last_mut() {
            let at = *at;
            if let Some((callee, _)) = calls[at].get(*next) {
                *next += 1;
                if total[*callee].is_none() && on_path.insert(*callee) {
                    path.push((*callee, 0));
                }
                continue;
            }
            let sum = calls[at].iter().fold(own[at], |sum, (callee, times)| {
                sum.saturating_add(times.saturating_mul(total[*callee].unwrap_or(1)))
            });
            total[at] = Some(sum);
            if sum > MAX_WORK {
                let message = format!(
                    "it takes {sum} turns of loops and calls for each pixel; {MAX_WORK} are the most that a node may take"
                );
                return Err(error_at(text, functions[at].code_start, message));
            }
            on_path.remove(&at);
            path.pop();
        }
    }
    Ok(functions.iter().zip(total).map(|(item, total)| (item.name.as_str(), total.unwrap_or(1))).collect())
}

/// The constants of the text that are a whole number and no more, by the places at which they are read: a local of the same name is
/// another thing.
pub(super) fn whole_constants(text: &str, items: &[Item]) -> HashMap<usize, u64> {
    let value = |item: &Item| {
        let (_, value) = text[item.name_range.end..item.end].split_once('=')?;
        integer(value.split(';').next()?.trim())
    };
    let constants = items.iter().filter(|item| item.kind == ItemKind::Const);
    let known: HashMap<&str, u64> = constants.filter_map(|item| Some((item.name.as_str(), value(item)?))).collect();
    let references = items.iter().flat_map(|item| &item.references);
    references.filter_map(|range| Some((range.start, *known.get(&text[range.clone()])?))).collect()
}

/// The turns of a function's loops, and what it calls how often.
fn function_work(
    text: &str,
    code: &[Token],
    constants: &HashMap<usize, u64>,
    functions: &HashMap<&str, usize>,
) -> Result<(u64, Vec<(usize, u64)>), CodeError> {
    let mut loops: Vec<Turns> = Vec::new();
    let mut own: u64 = 1;
    let mut calls = Vec::new();
    let times = |loops: &[Turns]| loops.iter().fold(1, |product: u64, turns| product.saturating_mul(turns.count));
    for (i, token) in code.iter().enumerate() {
        loops.retain(|turns| token.start < turns.until);
        let word = token.text(text);
        if word == "for" {
            let turns = for_turns(text, code, i, constants)?;
            loops.push(turns);
            own = own.saturating_add(times(&loops));
        } else if let Some(callee) = functions.get(word)
            && code.get(i + 1).is_some_and(|next| next.text(text) == "(")
        {
            calls.push((*callee, times(&loops)));
        } else if borrowed::is_function(word) && code.get(i + 1).is_some_and(|next| next.text(text) == "(") {
            let each = if borrowed::loops(word) { LIBRARY_WORK } else { 1 };
            own = own.saturating_add(times(&loops).saturating_mul(each));
        }
    }
    Ok((own, calls))
}

/// The turns of the `for` at token `at`: `for (var i = 0; i < 8; i++) {...}` or downwards, whose body leaves `i` alone.
fn for_turns(text: &str, code: &[Token], at: usize, constants: &HashMap<usize, u64>) -> Result<Turns, CodeError> {
    let wrong = |i: usize, message: &str| {
        let place = code.get(i).map_or(text.len(), |token| token.start);
        Err(error_at(text, place, message))
    };
    let word = |i: usize| code.get(i).map_or("", |token| token.text(text));
    // A number, and the place behind it.
    let number = |i: usize| {
        let (sign, at) = if word(i) == "-" { (-1, i + 1) } else { (1, i) };
        let constant = || constants.get(&code.get(at)?.start).copied();
        let size = integer(word(at)).or_else(constant).filter(|size| *size <= MAX_COUNT)?;
        Some((sign * size as i64, at + 1))
    };
    if word(at + 1) == "(" && matches!(word(at + 2), "let" | "const") {
        return wrong(at + 2, "the counter of a loop changes: `for (var i = 0; i < 8; i++)`");
    }
    if word(at + 1) != "(" || word(at + 2) != "var" {
        return wrong(at, SHAPE);
    }
    let counter = word(at + 3);
    let mut i = at + 4;
    let declared = if word(i) == ":" && matches!(word(i + 1), "i32" | "u32") {
        i += 2;
        word(i - 1)
    } else {
        ""
    };
    // Of a constant the type is not known here.
    let is_signed = declared == "i32"
        || (declared.is_empty()
            && (word(i + 1) == "-" || integer(word(i + 1)).is_some() && !word(i + 1).ends_with('u')));
    let (Some((start, next)), "=") = (number(i + 1), word(i)) else { return wrong(i, SHAPE) };
    if word(next) != ";" || word(next + 1) != counter {
        return wrong(next, SHAPE);
    }
    i = next + 2;
    let is_down = match word(i) {
        "<" => false,
        ">" => true,
        _ => return wrong(i, SHAPE),
    };
    let includes = word(i + 1) == "=";
    i += if includes { 2 } else { 1 };
    let Some((end, next)) = number(i) else { return wrong(i, SHAPE) };
    i = next + 1;
    let sign = if is_down { "-" } else { "+" };
    if word(next) != ";" || word(i) != counter || word(i + 1) != sign {
        return wrong(next, SHAPE);
    }
    let step = match word(i + 2) {
        again if again == sign => {
            i += 3;
            1
        }
        "=" => match number(i + 3) {
            Some((step, next)) if step > 0 => {
                i = next;
                step
            }
            _ => return wrong(i + 3, SHAPE),
        },
        _ => return wrong(i, SHAPE),
    };
    if word(i) != ")" {
        return wrong(i, SHAPE);
    }
    if word(i + 1) != "{" {
        return wrong(i + 1, "what a loop does stands in `{ }`, one statement, too");
    }
    let way = if is_down { start - end } else { end - start } + i64::from(includes);
    let count = (way.max(0) as u64).div_ceil(step as u64);
    if is_down && !is_signed && start - (count as i64) * step < 0 {
        return wrong(at, "a loop of u32 that counts below 0 does not end; count in i32, or upwards");
    }
    let mut depth = 0usize;
    for j in i + 1..code.len() {
        match word(j) {
            "{" => depth += 1,
            "}" if depth == 1 => return Ok(Turns { count, until: code[j].end }),
            "}" => depth -= 1,
            name if name == counter && changes(text, code, j) => {
                return wrong(
                    j,
                    "the loop's counter is changed in its body, so that it need not end; use another variable",
                );
            }
            _ => {}
        }
    }
    wrong(at, SHAPE)
}

/// Whether the name at token `at` is declared again or assigned to. Brackets around it hide nothing.
fn changes(text: &str, code: &[Token], at: usize) -> bool {
    let word = |i: usize| code.get(i).map_or("", |token| token.text(text));
    let before = |i: usize| i.checked_sub(1).map_or("", word);
    if before(at) == "." {
        return false;
    }
    let declared = matches!(before(at), "var" | "let" | "const");
    let (mut first, mut last) = (at, at);
    while before(first) == "(" && word(last + 1) == ")" {
        (first, last) = (first - 1, last + 1);
    }
    let assigned = match (word(last + 1), word(last + 2), word(last + 3)) {
        ("=", next, _) => next != "=",
        ("+" | "-" | "*" | "/" | "%" | "&" | "|" | "^", "=", _) => true,
        ("+", "+", _) | ("-", "-", _) => code[last + 2].start == code[last + 1].end,
        ("<", "<", "=") | (">", ">", "=") => true,
        _ => false,
    };
    declared || assigned
}
