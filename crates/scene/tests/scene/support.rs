//! glTF files made of JSON and numbers.

use std::path::Path;

use halfvector_graph::check::{Problem, Severity, check};
use halfvector_graph::document::Document;
use halfvector_graph::library::Library;
use halfvector_scene::gltf::{Asset, GltfError, Model};
use serde_json::{Value, json};

/// A model in the making: buffer views and accessors are appended, the rest is JSON.
#[derive(Clone)]
pub(crate) struct Builder {
    pub(crate) json: Value,
    pub(crate) binary: Vec<u8>,
}

impl Builder {
    pub(crate) fn new() -> Builder {
        let json = json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "name": "thing"}],
            "meshes": [{"primitives": [{"attributes": {}}]}],
            "buffers": [{"byteLength": 0}],
            "bufferViews": [],
            "accessors": []
        });
        Builder { json, binary: Vec::new() }
    }

    /// A triangle in the plane z = 0 with texture coordinates, whose positions are accessor 0.
    pub(crate) fn triangle() -> Builder {
        let mut builder = Builder::new();
        builder.attribute("POSITION", &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        builder.attribute("NORMAL", &[[0.0, 0.0, 1.0]; 3]);
        builder.attribute("TEXCOORD_0", &[[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]);
        builder
    }

    /// Appends bytes as a buffer view.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        while !self.binary.len().is_multiple_of(4) {
            self.binary.push(0);
        }
        let view = json!({"buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len()});
        self.binary.extend_from_slice(bytes);
        push(&mut self.json["bufferViews"], view)
    }

    pub(crate) fn accessor(&mut self, accessor: Value) -> usize {
        push(&mut self.json["accessors"], accessor)
    }

    /// Floats as an attribute of the first primitive.
    pub(crate) fn attribute<const N: usize>(&mut self, name: &str, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let ty = ["", "SCALAR", "VEC2", "VEC3", "VEC4"][N];
        let accessor =
            self.accessor(json!({"bufferView": view, "componentType": 5126, "type": ty, "count": values.len()}));
        self.primitive()["attributes"][name] = accessor.into();
        accessor
    }

    /// Indices of 16 bits for the first primitive.
    pub(crate) fn indices(&mut self, indices: &[u16]) {
        let bytes: Vec<u8> = indices.iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let accessor =
            self.accessor(json!({"bufferView": view, "componentType": 5123, "type": "SCALAR", "count": indices.len()}));
        self.primitive()["indices"] = accessor.into();
    }

    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"][0]["byteLength"] = self.binary.len().into();
        let mut text = serde_json::to_vec(&json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.binary.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let mut bytes = Vec::new();
        let length = 12 + 8 + text.len() + 8 + binary.len();
        for word in [u32::from_le_bytes(*b"glTF"), 2, length as u32, text.len() as u32, u32::from_le_bytes(*b"JSON")] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(text);
        bytes.extend((binary.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(binary);
        bytes
    }

    pub(crate) fn load(&self) -> Result<Model, GltfError> {
        load(&self.glb())
    }
}

pub(crate) fn load(bytes: &[u8]) -> Result<Model, GltfError> {
    halfvector_scene::gltf::from_asset(&Asset::from_bytes(Path::new("folder/model.glb"), bytes)?)
}

fn push(list: &mut Value, item: Value) -> usize {
    let list = list.as_array_mut().unwrap();
    list.push(item);
    list.len() - 1
}

/// Appends to a list of the file's root, which is made on first use.
pub(crate) fn add(builder: &mut Builder, list: &str, item: Value) -> usize {
    if builder.json[list].is_null() {
        builder.json[list] = json!([]);
    }
    push(&mut builder.json[list], item)
}

/// What keeps a document from becoming a shader.
pub(crate) fn errors(document: &Document) -> Vec<Problem> {
    check(document, Library::standard()).into_iter().filter(|p| p.severity == Severity::Error).collect()
}
