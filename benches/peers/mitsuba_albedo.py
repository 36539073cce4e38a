#!/usr/bin/env python3
"""What Mitsuba 3's layered plastics reflect of uniform light, for docs/energy.md: directional albedos by sampling.

Usage, from anywhere: python3 benches/peers/mitsuba_albedo.py
Needs `pip install mitsuba` and an LLVM library (Debian: libllvm19; DRJIT_LIBLLVM_PATH names another).
"""
import os

os.environ.setdefault("DRJIT_LIBLLVM_PATH", "/usr/lib/x86_64-linux-gnu/libLLVM.so.19.1")
import drjit as dr
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
SAMPLES = 1 << 20
COSINES = (0.1, 0.3, 0.6, 1.0)


def grey(value):
    return {"type": "rgb", "value": [value] * 3}


def albedo(bsdf, n_dot_v):
    random = mi.PCG32(size=SAMPLES)
    point = dr.zeros(mi.SurfaceInteraction3f, SAMPLES)
    point.wi = mi.Vector3f((1.0 - n_dot_v * n_dot_v) ** 0.5, 0.0, n_dot_v) + dr.zeros(mi.Vector3f, SAMPLES)
    pair = mi.Point2f(random.next_float32(), random.next_float32())
    _, weight = bsdf.sample(mi.BSDFContext(), point, random.next_float32(), pair)
    return dr.mean(weight.x)[0]


print("albedos at n.v =", *COSINES)
for base in (0.0, 0.2, 0.5, 1.0):
    materials = {
        "plastic": {"type": "plastic", "int_ior": 1.5, "diffuse_reflectance": grey(base)},
        "roughplastic, alpha 0.01": {
            "type": "roughplastic", "distribution": "ggx", "alpha": 0.01, "int_ior": 1.5, "diffuse_reflectance": grey(base)
        },
        "roughplastic, alpha 0.25": {
            "type": "roughplastic", "distribution": "ggx", "alpha": 0.25, "int_ior": 1.5, "diffuse_reflectance": grey(base)
        },
        "principled, roughness 0.4": {"type": "principled", "base_color": grey(base), "roughness": 0.4, "specular": 0.5},
    }
    for name, material in materials.items():
        bsdf = mi.load_dict(material)
        print(f"base {base}, {name}:", *(f"{albedo(bsdf, c):.3f}" for c in COSINES))
