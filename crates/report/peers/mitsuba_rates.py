"""Mitsuba 3's LLVM backend on one core: how many evaluations and samples of a GGX conductor it makes a second.

    pip install mitsuba            # and an LLVM library of version 16 or later; Debian's is libllvm19

Prints one JSON object: `version`, and `evaluations` and `samples` in millions a second, the best of both of its materials and of
several wavefront sizes, medians, inputs and outputs in memory. An argument is the number of rounds. `halfvector report` runs it;
`benches/peers/mitsuba_brdf.py` sets our own functions beside it.
"""

import glob
import json
import os
import re
import statistics
import sys
import time

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

# Of the 40 or so rounds that a rate is the median of, the first wait for the compiler.
WARM_UP = 5


def find_llvm():
    """Names an LLVM library that Dr.Jit can use: with an older one it ends the process."""
    if "DRJIT_LIBLLVM_PATH" in os.environ:
        return
    found = []
    for pattern in ("/usr/lib/*/libLLVM*.so*", "/usr/lib/libLLVM*.so*", "/usr/lib64/libLLVM*.so*", "/usr/lib/llvm-*/lib/libLLVM*.so*"):
        for path in glob.glob(pattern):
            number = re.search(r"\d+", os.path.basename(os.path.realpath(path)))
            if number and int(number.group()) >= 16:
                found.append((int(number.group()), path))
    if not found:
        sys.exit("no LLVM library of version 16 or later (Debian: libllvm19); DRJIT_LIBLLVM_PATH names one")
    os.environ["DRJIT_LIBLLVM_PATH"] = max(found)[1]


def rates(bsdf, count, rounds):
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
        for _ in range(WARM_UP + rounds):
            start = time.perf_counter()
            work()
            dr.sync_thread()
            seconds.append(time.perf_counter() - start)
        result.append(count / statistics.median(seconds[WARM_UP:]) / 1e6)
    return result


def best(rounds=35):
    """The best rate of either function over both materials and all sizes."""
    found = [rates(mi.load_dict(bsdf), 1 << size, rounds) for bsdf in BSDFS.values() for size in (14, 16, 18, 20)]
    return [max(column) for column in zip(*found)]


find_llvm()
import drjit as dr
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
dr.set_thread_count(1)

if __name__ == "__main__":
    evaluations, samples = best(*(int(argument) for argument in sys.argv[1:]))
    print(json.dumps({"version": mi.__version__, "evaluations": evaluations, "samples": samples}))
