#!/usr/bin/env python3
"""Mitsuba 3's LLVM backend on one core beside our batches: a GGX conductor's eval and sample.

Usage, from the project's root: python3 benches/peers/mitsuba_brdf.py [--rates: Mitsuba's alone]
Prints millions of points a second (medians) and ratios to Mitsuba and to our own scalar function.
Needs `pip install mitsuba` and an LLVM library (Debian: libllvm19; DRJIT_LIBLLVM_PATH names another).

Mitsuba gets its best of several wavefront sizes, measured before and after our criterion bench, inputs and outputs in
memory. Its lobe has the same work: GGX, separable Smith masking, RGB reflectance (principled: Schlick's), directions in,
RGB times cosine out; sample gives a direction, a density and an RGB weight.
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

os.environ.setdefault("DRJIT_LIBLLVM_PATH", "/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1")
import drjit as dr
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
dr.set_thread_count(1)

BSDFS = {
    "roughconductor": {
        "type": "roughconductor",
        "distribution": "ggx",
        "alpha": 0.25,
        "eta": {"type": "rgb", "value": [0.2, 0.9, 1.1]},
        "k": {"type": "rgb", "value": [3.9, 2.4, 2.2]},
    },
    "principled": {
        "type": "principled",
        "base_color": {"type": "rgb", "value": [1.0, 0.7, 0.3]},
        "metallic": 1.0,
        "roughness": 0.5,
    },
}


def rates(bsdf, count):
    """Millions of evaluations and of samples a second, medians."""
    random = mi.PCG32(size=count)
    pair = lambda: mi.Point2f(random.next_float32(), random.next_float32())
    view, light = (mi.warp.square_to_uniform_hemisphere(pair()) for _ in range(2))
    point = dr.zeros(mi.SurfaceInteraction3f, count)
    point.wi, point.uv = view, pair()
    u1, u2 = random.next_float32(), pair()
    dr.eval(point, light, u1, u2)
    context = mi.BSDFContext()

    def evaluate():
        dr.eval(bsdf.eval(context, point, light))

    def sample():
        drawn, weight = bsdf.sample(context, point, u1, u2)
        dr.eval(drawn.wo, drawn.pdf, weight)

    result = []
    for work in (evaluate, sample):
        seconds = []
        for _ in range(40):
            start = time.perf_counter()
            work()
            dr.sync_thread()
            seconds.append(time.perf_counter() - start)
        result.append(count / statistics.median(seconds[5:]) / 1e6)
    return result


def best():
    """The best rate of either function over both materials and all sizes."""
    found = [rates(mi.load_dict(b), 1 << n) for b in BSDFS.values() for n in (14, 16, 18, 20)]
    return [max(column) for column in zip(*found)]


def ours(group, name):
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target"))
    path = target / "criterion" / group / name / "new" / "estimates.json"
    return 4096 * 1e3 / json.loads(path.read_text())["median"]["point_estimate"]


if "--rates" in sys.argv:
    # For `halfvector report`: millions of evaluations and of samples a second.
    print(*best())
    sys.exit()

before = best()
command = ["cargo", "bench", "-q", "-p", "halfvector-benches", "--bench", "brdf", "--", "--warm-up-time", "1", "--measurement-time", "2"]
subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
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
