//! Derivatives: none, of quads, of given steps.

use halfvector_interp::{Column, Derivatives, Entry, LANES, Limits, Outputs, Program, Resources};

use super::support::valid;

const SOURCE: &str = "
    @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {
        let p = uv.x * uv.x + 3.0 * uv.y;
        return vec4f(dpdx(p), dpdy(p), fwidth(p), p);
    }";

fn program() -> Program {
    let (module, info) = valid(SOURCE);
    Program::compile(&module, &info, Entry::EntryPoint("main")).expect("supported")
}

#[test]
fn zero() {
    let mut out = Outputs::<f64>::default();
    let inputs = [Column::Float(&[1.0, 2.0][..]), Column::Float(&[1.0])];
    program().run(&inputs, 2, &mut out, &Resources::default(), Derivatives::Zero, Limits::default()).expect("runs");
    assert_eq!(out.columns[0].to_f64(), [0.0, 0.0]);
    assert_eq!(out.columns[3].to_f64(), [4.0, 7.0]);
}

#[test]
fn quads() {
    let (u, v) = ([1.0, 1.5, 1.0, 1.5], [0.0, 0.0, 1.0, 1.0]);
    let mut out = Outputs::<f64>::default();
    let inputs = [Column::Float(&u[..]), Column::Float(&v)];
    program().run(&inputs, 4, &mut out, &Resources::default(), Derivatives::Quads, Limits::default()).expect("runs");
    assert_eq!(out.columns[0].to_f64(), [1.25; 4]);
    assert_eq!(out.columns[1].to_f64(), [3.0; 4]);
    assert_eq!(out.columns[2].to_f64(), [4.25; 4]);
}

#[test]
fn given_steps_over_several_batches() {
    let n = LANES + 5;
    let u: Vec<f64> = (0..n).map(|i| i as f64 * 0.1).collect();
    let mut out = Outputs::<f64>::default();
    let inputs = [Column::Float(&u[..]), Column::Float(&[0.5])];
    let (ddx, ddy) =
        ([Column::Float(&[1e-3][..]), Column::Float(&[0.0])], [Column::Float(&[0.0][..]), Column::Float(&[1e-3])]);
    let given = Derivatives::Given { ddx: &ddx, ddy: &ddy };
    program().run(&inputs, n, &mut out, &Resources::default(), given, Limits::default()).expect("runs");
    let (dx, dy, p) = (out.columns[0].to_f64(), out.columns[1].to_f64(), out.columns[3].to_f64());
    assert_eq!((dx.len(), out.killed.len()), (n, n));
    for i in 0..n {
        let expected = 2.0 * u[i] * 1e-3 + 1e-6;
        assert!((dx[i] - expected).abs() < 1e-12, "dpdx at {i}: {} not {expected}", dx[i]);
        assert!((dy[i] - 3e-3).abs() < 1e-12);
        assert!((p[i] - (u[i] * u[i] + 1.5)).abs() < 1e-12);
    }
}

/// The kinds of derivatives in a block whose rows and columns change differently: all are of the pixel's own row and column, the coarse
/// ones, too, as WGSL allows and llvmpipe has it.
#[test]
fn fine_and_coarse_ones_are_of_the_own_row_and_column() {
    let source = "
        @fragment fn main(@location(0) p: f32) -> @location(0) vec4f {
            let x = dpdxCoarse(p) + 100.0 * dpdxFine(p) + 10000.0 * dpdx(p);
            let y = dpdyCoarse(p) + 100.0 * dpdyFine(p) + 10000.0 * dpdy(p);
            return vec4f(x, y, fwidthCoarse(p) + 100.0 * fwidthFine(p) + 10000.0 * fwidth(p), 0.0);
        }";
    let (module, info) = valid(source);
    let program = Program::compile(&module, &info, Entry::EntryPoint("main")).expect("supported");
    let mut out = Outputs::<f64>::default();
    // Along x 1 above and 4 below, along y 2 on the left and 5 on the right.
    let inputs = [Column::Float(&[0.0, 1.0, 2.0, 6.0][..])];
    program.run(&inputs, 4, &mut out, &Resources::default(), Derivatives::Quads, Limits::default()).expect("runs");
    assert_eq!(out.columns[0].to_f64(), [10101.0, 10101.0, 40404.0, 40404.0]);
    assert_eq!(out.columns[1].to_f64(), [20202.0, 50505.0, 20202.0, 50505.0]);
    assert_eq!(out.columns[2].to_f64(), [30303.0, 60606.0, 60606.0, 90909.0]);
}
