"""The fragment shader that MaterialX's generator writes for its standard surface, for `halfvector report`.

    pip install materialx

The surface has its default values, one light of a kind that the program chooses and a prefiltered environment. Prints one JSON object:
`version`, `milliseconds` of the generator, `shader` in GLSL for Vulkan.
"""

import json
import time

import MaterialX as mx
import MaterialX.PyMaterialXGenShader as gen
import MaterialX.PyMaterialXGenGlsl as glsl

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
text = shader.getSourceCode(gen.PIXEL_STAGE)
milliseconds = 1e3 * (time.perf_counter() - start)
print(json.dumps({"version": mx.__version__, "milliseconds": milliseconds, "shader": text}))
