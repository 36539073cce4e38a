//! Metal: both stages in one file. Buffers, textures and samplers are numbered each by themselves, in the order of the
//! bindings; the numbers stand in the JSON.

use naga::back::msl;
use serde_json::{Map, Value};

use super::{ExportError, OutputFile, Source, Target, file, json, same};
use crate::reflection::Resource;

pub(super) const TARGET: Target = Target { name: "msl", help: "Metal Shading Language 2.1", needs: same, write };

fn write(source: &Source<'_>, name: &str) -> Result<Vec<OutputFile>, ExportError> {
    let fail = |message: String| ExportError::Backend { target: TARGET.name, message };
    let mut resources = msl::BindingMap::default();
    let (mut buffers, mut textures, mut samplers) = (0_u8, 0_u8, 0_u8);
    let mut numbers = Map::new();
    for binding in &source.shader.reflection.bindings {
        let mut slot = msl::BindTarget::default();
        let (kind, number) = match &binding.resource {
            Resource::Uniform(_) => {
                slot.buffer = Some(buffers);
                ("buffer", take(&mut buffers))
            }
            Resource::Texture(_) => {
                slot.texture = Some(textures);
                ("texture", take(&mut textures))
            }
            Resource::Sampler(_) => {
                slot.sampler = Some(msl::BindSamplerTarget::Resource(samplers));
                ("sampler", take(&mut samplers))
            }
        };
        numbers.insert(binding.name.clone(), Value::from(format!("{kind}({number})")));
        let place = naga::ResourceBinding { group: binding.group, binding: binding.binding };
        resources.insert(place, slot);
    }
    let entry = msl::EntryPointResources { resources, ..msl::EntryPointResources::default() };
    let options = msl::Options {
        lang_version: (2, 1),
        per_entry_point_map: Source::STAGES.iter().map(|(_, name, _)| ((*name).to_owned(), entry.clone())).collect(),
        fake_missing_bindings: false,
        force_loop_bounding: false,
        ..msl::Options::default()
    };
    let pipeline = msl::PipelineOptions::default();
    let (text, info) = msl::write_string(&source.valid.module, &source.valid.info, &options, &pipeline)
        .map_err(|e| fail(e.to_string()))?;
    for entry_point in info.entry_point_names {
        entry_point.map_err(|e| fail(e.to_string()))?;
    }
    let text = format!("{}{text}", source.shader.header());
    let details = ("metal", Value::Object(numbers));
    Ok(vec![file(format!("{name}.metal"), text), json::reflection(source, name, TARGET.name, Some(details))])
}

fn take(next: &mut u8) -> u8 {
    *next += 1;
    *next - 1
}
