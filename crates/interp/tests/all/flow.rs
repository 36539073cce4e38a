//! Control flow: lanes that go apart and come together. Each program runs on lanes that all take other ways, in every
//! order, and must return what the same steps return in Rust.

use halfvector_interp::{Column, LANES};

use super::support::run;

/// Runs `f(n: i32) -> i32` for n from -20 on, over more than one batch, and compares with Rust.
fn compare(source: &str, truth: impl Fn(i32) -> i32) {
    let inputs: Vec<i32> = (0..2 * LANES as i32 + 37).map(|i| (i * 7) % 61 - 20).collect();
    let words: Vec<u32> = inputs.iter().map(|x| x.cast_unsigned()).collect();
    let rows = run::<f32>(source, &[Column::Word(&words)], words.len());
    for (n, row) in inputs.iter().zip(rows) {
        assert_eq!((row[0] as u32).cast_signed(), truth(*n), "f({n}) of {source}");
    }
    // With a number in the text all lanes go one way: jumps without masks.
    for n in [-20, -5, -1, 0, 1, 2, 3, 7, 8, 12, 27, 40] {
        let fixed = format!("{}\nfn f() -> i32 {{ return inner({n}); }}", source.replace("fn f(", "fn inner("));
        let row = run::<f32>(&fixed, &[], 1);
        assert_eq!((row[0][0] as u32).cast_signed(), truth(n), "{fixed}");
    }
}

#[test]
fn branches_and_early_returns() {
    compare(
        "fn f(n: i32) -> i32 {
            var r = 1;
            if (n > 10) { r = 2; if (n > 20) { return 100; } r += 1; } else if (n < 0) { r = 7; } else { return n; }
            r *= 3;
            return r + n;
        }",
        |n| {
            let r = if n > 20 {
                return 100;
            } else if n > 10 {
                3
            } else if n < 0 {
                7
            } else {
                return n;
            };
            3 * r + n
        },
    );
}

#[test]
fn loops_break_continue_and_return() {
    compare(
        "fn f(n: i32) -> i32 {
            var sum = 0;
            for (var i = 0; i < n; i++) {
                if (i == 3) { continue; }
                if (sum > 40) { break; }
                if (i == 17 && n > 30) { return -sum; }
                sum += i;
            }
            return sum;
        }",
        |n| {
            let mut sum = 0;
            for i in 0..n.max(0) {
                if i == 3 {
                    continue;
                }
                if sum > 40 {
                    break;
                }
                if i == 17 && n > 30 {
                    return -sum;
                }
                sum += i;
            }
            sum
        },
    );
}

#[test]
fn nested_loops() {
    compare(
        "fn f(n: i32) -> i32 {
            var total = 0;
            var i = 0;
            loop {
                var j = 0;
                loop {
                    if (j >= i) { break; }
                    if ((i + j + n) % 5 == 0) { j += 1; continue; }
                    if (total > 300) { return total; }
                    total += j;
                    continuing { j += 1; break if j > 12; }
                }
                i += 1;
                continuing { break if i > n; }
            }
            return total + i;
        }",
        |n| {
            let (mut total, mut i) = (0, 0);
            loop {
                let mut j = 0;
                loop {
                    if j >= i {
                        break;
                    }
                    let skip = (i + j + n) % 5 == 0;
                    if skip {
                        j += 1;
                    } else {
                        if total > 300 {
                            return total;
                        }
                        total += j;
                    }
                    j += 1;
                    if j > 12 {
                        break;
                    }
                }
                i += 1;
                if i > n {
                    break;
                }
            }
            total + i
        },
    );
}

#[test]
fn switches() {
    compare(
        "fn f(n: i32) -> i32 {
            var r = 0;
            switch n {
                case 1, 2: { r = 10; }
                case 3: { if (r == 0) { break; } r = 20; }
                case -5: { return 55; }
                default: { r = n * 2; }
                case 7: { r = 70; }
            }
            for (var i = 0; i < 4; i++) {
                switch (i + n) % 3 { case 0: { continue; } case 1: { r += 1; } default: { r += 100; } }
                r += 1000;
            }
            return r;
        }",
        |n| {
            let mut r = match n {
                1 | 2 => 10,
                3 => 0,
                -5 => return 55,
                7 => 70,
                _ => n * 2,
            };
            for i in 0..4 {
                match (i + n) % 3 {
                    0 => continue,
                    1 => r += 1,
                    _ => r += 100,
                }
                r += 1000;
            }
            r
        },
    );
}

#[test]
fn calls_in_divergent_flow() {
    compare(
        "fn half(n: i32, steps: ptr<function, i32>) -> i32 {
            *steps += 1;
            if (n % 2 == 0) { return n / 2; }
            *steps += 10;
            return 3 * n + 1;
        }
        fn f(n: i32) -> i32 {
            if (n <= 0) { return 0; }
            var x = n; var steps = 0;
            while (x != 1 && steps < 300) { x = half(x, &steps); }
            return steps;
        }",
        |n| {
            if n <= 0 {
                return 0;
            }
            let (mut x, mut steps) = (n, 0);
            while x != 1 && steps < 300 {
                steps += 1;
                if x % 2 == 0 {
                    x /= 2;
                } else {
                    steps += 10;
                    x = 3 * x + 1;
                }
            }
            steps
        },
    );
}

#[test]
fn uniform_loops_hold_varying_values() {
    compare(
        "fn f(n: i32) -> i32 {
            var a = array<i32, 5>();
            for (var i = 0; i < 5; i++) { a[i] = n + i; if (i == 2) { a[i] *= 10; } }
            var s = 0;
            for (var i = 4; i >= 0; i--) { if (a[i] % 2 == 0) { s = s * 2 + a[i]; } }
            return s;
        }",
        |n| {
            let mut a = [0; 5];
            for (i, a) in a.iter_mut().enumerate() {
                *a = n + i as i32;
                if i == 2 {
                    *a *= 10;
                }
            }
            a.iter().rev().filter(|a| *a % 2 == 0).fold(0, |s, a| s * 2 + a)
        },
    );
}

#[test]
fn short_circuits_do_not_evaluate() {
    compare(
        "fn count(c: ptr<function, i32>, r: bool) -> bool { *c += 1; return r; }
        fn f(n: i32) -> i32 {
            var c = 0;
            if (n > 3 && count(&c, n > 7) || count(&c, n < 0)) { c += 100; }
            return c;
        }",
        |n| {
            let mut c = 0;
            let mut count = |r| {
                c += 1;
                r
            };
            let hit = n > 3 && count(n > 7) || count(n < 0);
            if hit { c + 100 } else { c }
        },
    );
}
