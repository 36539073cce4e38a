//! Layout of uniform blocks by WGSL's rules for the uniform address space, and packing of values by that layout.
//!
//! Says nothing of what the members mean: a member's `UniformSource` does.

use std::fmt::Write;

use halfvector_graph::value::Type;

use crate::reflection::{LightKind, UniformBlock, UniformMember, UniformSource, UniformType};

/// Why a block could not be packed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PackError {
    /// A source gave too few or too many numbers.
    #[error("the uniform `{block}.{member}` takes {expected} numbers and was given {given}")]
    WrongCount {
        /// The struct.
        block: String,
        /// The member.
        member: String,
        /// Numbers that it takes, see [`UniformType::numbers`].
        expected: usize,
        /// Numbers that came.
        given: usize,
    },
}

impl LightKind {
    /// All kinds, in the order of the lights block.
    pub const ALL: [LightKind; 3] = [LightKind::Directional, LightKind::Point, LightKind::Spot];

    /// Name of its struct in the shader library.
    pub fn struct_name(self) -> &'static str {
        match self {
            LightKind::Directional => "DirectionalLight",
            LightKind::Point => "PointLight",
            LightKind::Spot => "SpotLight",
        }
    }

    /// Bytes from one light to the next.
    pub fn stride(self) -> u32 {
        match self {
            LightKind::Directional | LightKind::Point => 32,
            LightKind::Spot => 48,
        }
    }

    /// Numbers of the struct in each 16 bytes: directional (direction), (illuminance); point (position), (intensity);
    /// spot (position, cosine scale), (intensity, cosine offset), (direction).
    fn member_components(self) -> &'static [usize] {
        match self {
            LightKind::Directional | LightKind::Point => &[3, 3],
            LightKind::Spot => &[4, 4, 3],
        }
    }
}

impl UniformType {
    /// Its WGSL type.
    pub fn wgsl(self) -> String {
        match self {
            UniformType::Value(Type::Bool) => "i32".into(),
            UniformType::Value(ty) => ty.wgsl().into(),
            UniformType::Mat4 => "mat4x4f".into(),
            UniformType::Mat3 => "mat3x3f".into(),
            UniformType::Lights(kind, 1) => kind.struct_name().into(),
            UniformType::Lights(kind, count) => {
                let mut text = String::new();
                // Writing to a String cannot fail.
                let _ = write!(text, "array<{}, {count}>", kind.struct_name());
                text
            }
            UniformType::Sh9 => "array<vec4f, 9>".into(),
        }
    }

    /// Alignment in bytes.
    pub fn align(self) -> u32 {
        match self {
            UniformType::Value(Type::Bool | Type::I32 | Type::F32) => 4,
            UniformType::Value(Type::Vec2) => 8,
            _ => 16,
        }
    }

    /// Size in bytes.
    pub fn size(self) -> u32 {
        match self {
            UniformType::Value(ty) => 4 * ty.components() as u32,
            UniformType::Mat4 => 64,
            UniformType::Mat3 => 48,
            UniformType::Lights(kind, count) => kind.stride() * count,
            UniformType::Sh9 => 144,
        }
    }

    /// Numbers that [`UniformBlock::pack`] takes for it, padding left out: matrices column by column, each light's
    /// members in order, nine RGB coefficients.
    pub fn numbers(self) -> usize {
        match self {
            UniformType::Value(ty) => ty.components(),
            UniformType::Mat4 => 16,
            UniformType::Mat3 => 9,
            UniformType::Lights(kind, count) => kind.member_components().iter().sum::<usize>() * count as usize,
            UniformType::Sh9 => 27,
        }
    }

    /// Component counts of its parts that each start on 16 bytes; one part for what is contiguous.
    fn parts(self) -> Vec<usize> {
        match self {
            UniformType::Value(ty) => vec![ty.components()],
            UniformType::Mat4 => vec![16],
            UniformType::Mat3 => vec![3; 3],
            UniformType::Lights(kind, count) => kind.member_components().repeat(count as usize),
            UniformType::Sh9 => vec![3; 9],
        }
    }

    fn is_integer(self) -> bool {
        matches!(self, UniformType::Value(Type::Bool | Type::I32))
    }
}

impl UniformBlock {
    /// Lays members out in the order given.
    pub fn new(struct_name: impl Into<String>, members: Vec<(String, UniformType, UniformSource)>) -> UniformBlock {
        let mut end = 0_u32;
        let members = members
            .into_iter()
            .map(|(name, ty, source)| {
                let offset = end.next_multiple_of(ty.align());
                end = offset + ty.size();
                UniformMember { name, ty, offset, source }
            })
            .collect();
        UniformBlock { struct_name: struct_name.into(), members, size: end.next_multiple_of(16) }
    }

    /// The block's bytes (little-endian). `fill` appends the numbers of a source to the vector, as many as
    /// [`UniformType::numbers`] says; in f64, which holds an i32 as it holds an f32.
    pub fn pack(&self, mut fill: impl FnMut(&UniformSource, &mut Vec<f64>)) -> Result<Vec<u8>, PackError> {
        let mut bytes = vec![0_u8; self.size as usize];
        let mut numbers = Vec::new();
        for member in &self.members {
            numbers.clear();
            fill(&member.source, &mut numbers);
            if numbers.len() != member.ty.numbers() {
                return Err(PackError::WrongCount {
                    block: self.struct_name.clone(),
                    member: member.name.clone(),
                    expected: member.ty.numbers(),
                    given: numbers.len(),
                });
            }
            let mut rest = numbers.as_slice();
            let mut at = member.offset as usize;
            for part in member.ty.parts() {
                let (here, after) = rest.split_at(part);
                rest = after;
                for (index, number) in here.iter().enumerate() {
                    let word = if member.ty.is_integer() {
                        (*number as i32).to_le_bytes()
                    } else {
                        (*number as f32).to_le_bytes()
                    };
                    bytes[at + 4 * index..at + 4 * index + 4].copy_from_slice(&word);
                }
                at += (4 * part).next_multiple_of(16);
            }
        }
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block() -> UniformBlock {
        UniformBlock::new(
            "B",
            vec![
                ("a".into(), UniformType::Value(Type::F32), UniformSource::Time),
                ("b".into(), UniformType::Value(Type::Vec3), UniformSource::CameraPosition),
                ("c".into(), UniformType::Value(Type::F32), UniformSource::Exposure),
                ("m".into(), UniformType::Mat3, UniformSource::NormalFromObject),
                ("s".into(), UniformType::Lights(LightKind::Spot, 2), UniformSource::Lights(LightKind::Spot)),
                ("n".into(), UniformType::Value(Type::Bool), UniformSource::EnvironmentLevels),
            ],
        )
    }

    /// naga's own layouter is the judge of every offset and stride.
    #[test]
    fn offsets_are_nagas() {
        let block = block();
        let mut text = String::from(
            "struct SpotLight { position: vec3f, cos_scale: f32, intensity: vec3f, cos_offset: f32, direction: vec3f }\n\
             struct DirectionalLight { direction: vec3f, illuminance: vec3f }\nstruct B {",
        );
        for member in &block.members {
            text += &format!("{}: {},", member.name, member.ty.wgsl());
        }
        text += "}\n@group(0) @binding(0) var<uniform> u: B;";
        let module = naga::front::wgsl::parse_str(&text).expect("a sound struct");
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
            .validate(&module)
            .expect("valid in the uniform address space");
        let size_of = |name: &str| {
            let (_, ty) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).expect("the struct");
            let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is a struct") };
            (members.iter().map(|m| m.offset).collect::<Vec<_>>(), *span)
        };
        let (offsets, span) = size_of("B");
        assert_eq!(block.members.iter().map(|m| m.offset).collect::<Vec<_>>(), offsets);
        assert_eq!(block.size, span);
        assert_eq!(size_of("SpotLight"), (vec![0, 12, 16, 28, 32], LightKind::Spot.stride()));
        assert_eq!(size_of("DirectionalLight"), (vec![0, 16], LightKind::Directional.stride()));
    }

    #[test]
    fn numbers_stand_at_their_offsets() {
        let block = block();
        let fill = |source: &UniformSource, numbers: &mut Vec<f64>| match source {
            UniformSource::Time => numbers.push(1.0),
            UniformSource::CameraPosition => numbers.extend([2.0, 3.0, 4.0]),
            UniformSource::Exposure => numbers.push(5.0),
            UniformSource::NormalFromObject => numbers.extend((0..9).map(|i| 10.0 + f64::from(i))),
            UniformSource::Lights(_) => numbers.extend((0..22).map(|i| 20.0 + f64::from(i))),
            _ => numbers.push(1.0),
        };
        let bytes = block.pack(fill).unwrap();
        let float = |offset: usize| f32::from_le_bytes(bytes[offset..offset + 4].try_into().unwrap());
        assert_eq!((float(0), float(16), float(24), float(28)), (1.0, 2.0, 4.0, 5.0));
        assert_eq!((float(32), float(40), float(44), float(48), float(64 + 8)), (10.0, 12.0, 0.0, 13.0, 18.0));
        // Second spot light: its cosine scale and offset are its fourth and eighth numbers.
        assert_eq!((float(80), float(80 + 48), float(80 + 48 + 12), float(80 + 48 + 28)), (20.0, 31.0, 34.0, 38.0));
        assert_eq!(bytes[176..180], 1_i32.to_le_bytes());
        let short = block.pack(|_, numbers| numbers.push(0.0)).unwrap_err();
        assert_eq!(short.to_string(), "the uniform `B.b` takes 3 numbers and was given 1");
    }
}
