//! Scenes: meshes, glTF, cameras, lights, environments, tone maps, files.
