//! Accessors: numbers out of buffers, any component type, strided, normalised, sparse.

use gltf::json::Index;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::validation::Checked;

use super::asset::{Asset, slice};
use super::{Fault, Result, entry};
use crate::mesh::MAX_ELEMENTS;

/// Largest accessor without bytes of its own (zeros that are changed in places).
const MAX_ZEROS: u64 = 1 << 22;

/// Vectors of N numbers; whole numbers become 0..1 or -1..1 when the accessor is normalised, else they stay.
pub(super) fn read_vectors<const N: usize>(
    asset: &Asset,
    index: Index<Accessor>,
    place: &str,
) -> Result<Vec<[f32; N]>> {
    let (accessor, place) = accessor(asset, index, place)?;
    let component = component_type(accessor, &place)?;
    if component == ComponentType::U32 {
        return Err(Fault::new(place, "the component type is 5125 (whole numbers of 32 bits), which no vertex has"));
    }
    check_width(accessor, N, &place)?;
    let size = component.size();
    let read = |bytes: &[u8]| -> [f32; N] {
        std::array::from_fn(|i| number(&bytes[i * size..], component, accessor.normalized))
    };
    read_elements(asset, accessor, size * N, [0.0; N], read, &place)
}

/// Linear colours and alpha, 1 where the file has three numbers.
pub(super) fn read_colors(asset: &Asset, index: Index<Accessor>, place: &str) -> Result<Vec<[f32; 4]>> {
    if matches!(accessor(asset, index, place)?.0.type_, Checked::Valid(Type::Vec3)) {
        let colors = read_vectors::<3>(asset, index, place)?;
        return Ok(colors.into_iter().map(|[r, g, b]| [r, g, b, 1.0]).collect());
    }
    read_vectors(asset, index, place)
}

/// Indices.
pub(super) fn read_indices(asset: &Asset, index: Index<Accessor>, place: &str) -> Result<Vec<u32>> {
    let (accessor, place) = accessor(asset, index, place)?;
    let component = component_type(accessor, &place)?;
    check_width(accessor, 1, &place)?;
    if !matches!(component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
        return Err(Fault::new(place, "the component type of indices must be 5121, 5123 or 5125"));
    }
    read_elements(asset, accessor, component.size(), 0, |bytes| whole(bytes, component), &place)
}

/// How many elements an accessor promises.
pub(super) fn count(asset: &Asset, index: Index<Accessor>, place: &str) -> Result<usize> {
    let (accessor, place) = accessor(asset, index, place)?;
    usize::try_from(accessor.count.0)
        .ok()
        .filter(|&count| count <= MAX_ELEMENTS)
        .ok_or_else(|| Fault::new(place, format!("{} elements are more than {MAX_ELEMENTS}", accessor.count.0)))
}

fn accessor<'a>(asset: &'a Asset, index: Index<Accessor>, place: &str) -> Result<(&'a Accessor, String)> {
    let accessor = entry(&asset.root.accessors, "accessors", index.value(), place)?;
    Ok((accessor, format!("accessors[{}]", index.value())))
}

fn component_type(accessor: &Accessor, place: &str) -> Result<ComponentType> {
    match accessor.component_type {
        Checked::Valid(component) => Ok(component.0),
        Checked::Invalid => Err(Fault::new(place, "the componentType is none of glTF's")),
    }
}

fn check_width(accessor: &Accessor, width: usize, place: &str) -> Result<()> {
    let there = match accessor.type_ {
        Checked::Valid(Type::Scalar) => 1,
        Checked::Valid(Type::Vec2) => 2,
        Checked::Valid(Type::Vec3) => 3,
        Checked::Valid(Type::Vec4) => 4,
        Checked::Valid(Type::Mat2 | Type::Mat3 | Type::Mat4) => 0,
        Checked::Invalid => return Err(Fault::new(place, "the type is none of glTF's")),
    };
    if there == width {
        Ok(())
    } else {
        Err(Fault::new(place, format!("the type should have {width} components for what it is used for")))
    }
}

fn read_elements<T: Copy>(
    asset: &Asset,
    accessor: &Accessor,
    size: usize,
    zero: T,
    read: impl Fn(&[u8]) -> T,
    place: &str,
) -> Result<Vec<T>> {
    let count = accessor.count.0;
    let mut elements: Vec<T> = match accessor.buffer_view {
        Some(view) => {
            let stride = entry(&asset.root.buffer_views, "bufferViews", view.value(), place)?.byte_stride;
            let stride = stride.map_or(size, |s| s.0);
            if stride < size {
                return Err(Fault::new(
                    place,
                    format!("the byteStride {stride} is less than an element's {size} bytes"),
                ));
            }
            let start = accessor.byte_offset.unwrap_or_default().0;
            strided(asset.view(view, place)?, start, count, size, stride, place)?.map(&read).collect()
        }
        None if accessor.sparse.is_none() => return Err(Fault::new(place, "it has no bufferView")),
        None if count > MAX_ZEROS => {
            return Err(Fault::new(place, format!("{count} elements without a bufferView are more than {MAX_ZEROS}")));
        }
        None => vec![zero; count as usize],
    };
    if let Some(sparse) = &accessor.sparse {
        let Checked::Valid(component) = sparse.indices.component_type else {
            return Err(Fault::new(place, "the sparse indices' componentType is none of glTF's"));
        };
        let changed = sparse.count.0;
        let indices = asset.view(sparse.indices.buffer_view, place)?;
        let values = asset.view(sparse.values.buffer_view, place)?;
        let width = component.0.size();
        let indices = strided(indices, sparse.indices.byte_offset.0, changed, width, width, place)?;
        let values = strided(values, sparse.values.byte_offset.0, changed, size, size, place)?;
        for (index, value) in indices.zip(values) {
            let index = whole(index, component.0) as usize;
            let element = elements.get_mut(index);
            *element.ok_or_else(|| Fault::new(place, format!("the sparse index {index} is not below {count}")))? =
                read(value);
        }
    }
    Ok(elements)
}

/// The bytes of each of `count` elements.
fn strided<'a>(
    bytes: &'a [u8],
    start: u64,
    count: u64,
    size: usize,
    stride: usize,
    place: &str,
) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>> {
    let length = match count {
        0 => Some(0),
        _ => (count - 1).checked_mul(stride as u64).and_then(|n| n.checked_add(size as u64)),
    };
    let bytes = length.and_then(|length| slice(bytes, start, length)).ok_or_else(|| {
        Fault::new(place, format!("{count} elements do not fit into its bufferView; the file is cut off or wrong"))
    })?;
    // The last element may be shorter than the stride.
    Ok(bytes.chunks(stride.max(1)).map(move |chunk| &chunk[..size]))
}

fn number(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, largest) = match component {
        ComponentType::F32 => return f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
        ComponentType::I8 => (f32::from(bytes[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(bytes[0]), 255.0),
        ComponentType::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
        ComponentType::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65535.0),
        ComponentType::U32 => (whole(bytes, component) as f32, u32::MAX as f32),
    };
    // glTF 2.0, section 3.11: the lowest whole number is as low as the second lowest.
    if normalized { (value / largest).max(-1.0) } else { value }
}

fn whole(bytes: &[u8], component: ComponentType) -> u32 {
    match component {
        ComponentType::U8 => u32::from(bytes[0]),
        ComponentType::U16 => u32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        _ => u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}
