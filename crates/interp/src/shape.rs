//! How many scalars a type has, of which class, and where the parts of a composite begin.

use naga::{ArraySize, Handle, Module, Scalar, ScalarKind, Type, TypeInner};

use crate::ir::Class;

/// Most scalars of one value.
pub(crate) const MAX_SCALARS: usize = 1 << 17;

/// The class of a scalar, or its name where there is none.
pub(crate) fn class_of(scalar: Scalar) -> Result<Class, String> {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => Ok(Class::Float),
        (ScalarKind::Float, 8) => Ok(Class::Double),
        (ScalarKind::Sint | ScalarKind::Uint, 4) | (ScalarKind::Bool, _) => Ok(Class::Bits),
        (ScalarKind::Float, width) => Err(format!("the type f{}", 8 * u32::from(width))),
        (ScalarKind::Sint, width) => Err(format!("the type i{}", 8 * u32::from(width))),
        (ScalarKind::Uint, width) => Err(format!("the type u{}", 8 * u32::from(width))),
        _ => Err("a number whose type is not chosen".into()),
    }
}

/// Number of scalars of a type; what is not made of scalars is told by name.
pub(crate) fn count(module: &Module, inner: &TypeInner) -> Result<usize, String> {
    let too_large = || format!("a value of more than {MAX_SCALARS} scalars");
    let total = match inner {
        TypeInner::Scalar(_) => 1,
        TypeInner::Vector { size, .. } => *size as usize,
        TypeInner::Matrix { columns, rows, .. } => *columns as usize * *rows as usize,
        TypeInner::Array { base, size: ArraySize::Constant(n), .. } => {
            count(module, &module.types[*base].inner)?.checked_mul(n.get() as usize).ok_or_else(too_large)?
        }
        TypeInner::Struct { members, .. } => {
            let mut total = 0_usize;
            for member in members {
                total += count(module, &module.types[member.ty].inner)?;
            }
            total
        }
        other => return Err(refused(other)),
    };
    if total > MAX_SCALARS { Err(too_large()) } else { Ok(total) }
}

/// Appends the scalars of a type in order.
pub(crate) fn scalars(module: &Module, inner: &TypeInner, out: &mut Vec<Scalar>) -> Result<(), String> {
    count(module, inner)?;
    append(module, inner, out);
    Ok(())
}

fn append(module: &Module, inner: &TypeInner, out: &mut Vec<Scalar>) {
    match inner {
        TypeInner::Scalar(scalar) => out.push(*scalar),
        TypeInner::Vector { size, scalar } => out.extend(vec![*scalar; *size as usize]),
        TypeInner::Matrix { columns, rows, scalar } => {
            out.extend(vec![*scalar; *columns as usize * *rows as usize]);
        }
        TypeInner::Array { base, size: ArraySize::Constant(n), .. } => {
            for _ in 0..n.get() {
                append(module, &module.types[*base].inner, out);
            }
        }
        TypeInner::Struct { members, .. } => {
            for member in members {
                append(module, &module.types[member.ty].inner, out);
            }
        }
        _ => {}
    }
}

fn refused(inner: &TypeInner) -> String {
    match inner {
        TypeInner::Atomic(_) => "an atomic".into(),
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "a pointer as a value".into(),
        TypeInner::Array { size: ArraySize::Dynamic, .. } => "a runtime-sized array as a value".into(),
        TypeInner::Array { .. } => "an array whose size is an override constant".into(),
        TypeInner::Image { .. } => "a texture as a value".into(),
        TypeInner::Sampler { .. } => "a sampler as a value".into(),
        TypeInner::AccelerationStructure { .. } | TypeInner::RayQuery { .. } => "ray queries".into(),
        TypeInner::BindingArray { .. } => "arrays of bindings".into(),
        TypeInner::CooperativeMatrix { .. } => "cooperative matrices".into(),
        _ => "a value that is not made of scalars".into(),
    }
}

/// The parts of a composite that can be indexed: how many, and the type of part `index`.
pub(crate) enum Parts<'m> {
    /// Scalars of a vector.
    Scalars(usize, Scalar),
    /// Columns of a matrix: how many, rows of each.
    Columns(usize, TypeInner),
    /// Elements of an array; none where its size is known at run time only.
    Elements(Option<usize>, Handle<Type>, u32),
    Members(&'m [naga::StructMember]),
}

pub(crate) fn parts<'m>(inner: &'m TypeInner) -> Option<Parts<'m>> {
    Some(match inner {
        TypeInner::Vector { size, scalar } => Parts::Scalars(*size as usize, *scalar),
        TypeInner::Matrix { columns, rows, scalar } => {
            Parts::Columns(*columns as usize, TypeInner::Vector { size: *rows, scalar: *scalar })
        }
        TypeInner::Array { base, size: ArraySize::Constant(n), stride } => {
            Parts::Elements(Some(n.get() as usize), *base, *stride)
        }
        TypeInner::Array { base, size: ArraySize::Dynamic, stride } => Parts::Elements(None, *base, *stride),
        TypeInner::Struct { members, .. } => Parts::Members(members),
        _ => return None,
    })
}

/// Bytes from one column of a matrix in a buffer to the next.
pub(crate) fn column_stride(rows: usize, width: u8) -> u32 {
    (if rows == 2 { 2 } else { 4 }) * u32::from(width)
}

/// Appends the byte offset of each scalar of a type in a buffer.
pub(crate) fn offsets(module: &Module, inner: &TypeInner, at: u32, out: &mut Vec<u32>) {
    match inner {
        TypeInner::Vector { size, scalar } => {
            out.extend((0..*size as u32).map(|i| at + i * u32::from(scalar.width)));
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            let column = TypeInner::Vector { size: *rows, scalar: *scalar };
            for i in 0..*columns as u32 {
                offsets(module, &column, at + i * column_stride(*rows as usize, scalar.width), out);
            }
        }
        TypeInner::Array { base, size: ArraySize::Constant(n), stride } => {
            for i in 0..n.get() {
                offsets(module, &module.types[*base].inner, at + i * stride, out);
            }
        }
        TypeInner::Struct { members, .. } => {
            for member in members {
                offsets(module, &module.types[member.ty].inner, at + member.offset, out);
            }
        }
        _ => out.push(at),
    }
}
