#!/usr/bin/env python3
"""Instructions of the fragment shader that MaterialX's generator writes for its standard surface, and of ours.

    pip install materialx          # and glslangValidator, spirv-opt of Debian's glslang-tools and spirv-tools
    python3 benches/peers/materialx_shader.py [OURS.spv ...]

The surface has its default values, one light of a kind that the program chooses and a prefiltered environment. Both sides go
through `spirv-opt -O`; what is counted are the instructions inside of functions, but for labels, variables and parameters.
Prints the count of MaterialX and the milliseconds of its generator, then the count of each file that is given.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import MaterialX as mx
import MaterialX.PyMaterialXGenShader as gen
import MaterialX.PyMaterialXGenGlsl as glsl


def counted(spirv: Path) -> int:
    """Instructions in functions after spirv-opt."""
    small = spirv.with_suffix(".small.spv")
    subprocess.run(["spirv-opt", "-O", str(spirv), "-o", str(small)], check=True)
    words = memoryview(small.read_bytes()).cast("I")
    at, count, inside = 5, 0, False
    while at < len(words):
        length, code = words[at] >> 16, words[at] & 0xFFFF
        if code == 54:  # OpFunction
            inside = True
        elif code == 56:  # OpFunctionEnd
            inside = False
        elif inside and code not in (55, 59, 248):  # parameter, variable, label
            count += 1
        at += max(length, 1)
    return count


def generated() -> tuple[str, float]:
    """The fragment shader, and the milliseconds that it took."""
    library = mx.createDocument()
    path = mx.getDefaultDataSearchPath()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), path, library)
    document = mx.createDocument()
    document.setDataLibrary(library)
    surface = document.addNode("standard_surface", "surface", "surfaceshader")
    material = document.addMaterialNode("material", surface)
    generator = glsl.VkShaderGenerator.create()
    context = gen.GenContext(generator)
    context.registerSourceCodeSearchPath(path)
    options = context.getOptions()
    options.hwSpecularEnvironmentMethod = gen.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_PREFILTER
    options.hwMaxActiveLightSources = 1
    generator.registerTypeDefs(document)
    gen.HwShaderGenerator.bindLightShader(library.getNodeDef("ND_directional_light"), 1, context)
    start = time.perf_counter()
    shader = generator.generate("material", material, context)
    return shader.getSourceCode(gen.PIXEL_STAGE), 1e3 * (time.perf_counter() - start)


def main() -> None:
    text, milliseconds = generated()
    with tempfile.TemporaryDirectory() as folder:
        source, spirv = Path(folder, "m.frag"), Path(folder, "m.spv")
        source.write_text(text)
        subprocess.run(["glslangValidator", "-V", str(source), "-o", str(spirv)], check=True, stdout=sys.stderr)
        print(counted(spirv), f"{milliseconds:.2f}", *(counted(copy(folder, ours)) for ours in sys.argv[1:]))


def copy(folder: str, path: str) -> Path:
    """The file in the folder: the optimiser writes beside it."""
    target = Path(folder, Path(path).name)
    target.write_bytes(Path(path).read_bytes())
    return target


if __name__ == "__main__":
    main()
