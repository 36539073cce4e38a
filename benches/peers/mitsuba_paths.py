#!/usr/bin/env python3
"""Paths per second of Mitsuba 3 (`scalar_rgb`, all cores) on a textured metal sphere under an environment: the scene of
`crates/reference/examples/paths_per_second.rs`, which runs this.

usage: mitsuba_paths.py TEXTURE ENVIRONMENT SIZE SAMPLES
"""
import sys
import time

import numpy as np
import mitsuba as mi

mi.set_variant("scalar_rgb")
texture, environment, size, samples = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
scene = mi.load_dict({
    "type": "scene",
    "integrator": {"type": "direct", "bsdf_samples": 1, "emitter_samples": 1},
    "sensor": {
        "type": "perspective", "fov": 30.0, "fov_axis": "x",
        "to_world": mi.ScalarTransform4f().look_at(origin=[0, 0, 5], target=[0, 0, 0], up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": "rgb", "component_format": "float32",
                 "rfilter": {"type": "box"}},
        "sampler": {"type": "independent", "sample_count": samples},
    },
    # Mitsuba's sphere has its poles on z.
    "ball": {
        "type": "sphere",
        "to_world": mi.ScalarTransform4f().rotate([1, 0, 0], -90),
        "bsdf": {"type": "principled", "base_color": {"type": "bitmap", "filename": texture}, "metallic": 1.0,
                 "roughness": 0.4, "specular": 0.5},
    },
    "env": {"type": "envmap", "filename": environment, "scale": 1.0},
})
mi.render(scene, spp=1)
start = time.perf_counter()
picture = np.array(mi.render(scene, spp=samples))
seconds = time.perf_counter() - start
mean = picture[..., :3].mean((0, 1))
print(f"Mitsuba {mi.__version__} {mi.variant()}: paths_per_second={size * size * samples / seconds:.0f} "
      f"mean {mean[0]:.4f} {mean[1]:.4f} {mean[2]:.4f}")
