#!/usr/bin/env python3
"""Mitsuba 3's LLVM backend on one core beside our batches: a GGX conductor's eval and sample.

Usage, from anywhere: python3 benches/peers/mitsuba_brdf.py
Prints millions of points a second (medians) and ratios to Mitsuba and to our own scalar function.
Needs what `crates/report/peers/mitsuba_rates.py` needs, which measures Mitsuba.

Mitsuba gets its best of several wavefront sizes, measured before and after our criterion bench, inputs and outputs in
memory. Its lobe has the same work: GGX, separable Smith masking, RGB reflectance (principled: Schlick's), directions in,
RGB times cosine out; sample gives a direction, a density and an RGB weight.
"""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "crates/report/peers"))
from mitsuba_rates import best, mi


def ours(group, name):
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    path = target / "criterion" / group / name / "new" / "estimates.json"
    return 4096 * 1e3 / json.loads(path.read_text())["median"]["point_estimate"]


before = best()
command = ["cargo", "bench", "-q", "-p", "halfvector-benches", "--bench", "brdf", "--", "--warm-up-time", "1", "--measurement-time", "2"]
subprocess.run(command, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
peer = [max(pair) for pair in zip(before, best())]
for i, group in enumerate(("specular_eval", "specular_sample")):
    print(f"{group}: Mitsuba {mi.__version__} {peer[i]:.0f} M/s")
    for name in ("scalar", "glam", "scalar_columns", "scalar_inlined", "batch/Baseline", "batch/Avx2", "batch/Avx512"):
        try:
            rate = ours(group, name)
        except FileNotFoundError:
            continue
        print(f"  {name}: {rate:.0f} M/s, {rate / peer[i]:.2f} of Mitsuba, {rate / ours(group, 'scalar'):.1f} of scalar")
    sys.stdout.flush()
