//! The data format descriptor of a KTX2 file (Khronos 2019, "Khronos Data Format Specification" 1.3, basic block), held
//! against the header. It reads no texels: how they are coded is told by vkFormat alone.

use super::{Coding, Fault, field, number};
use crate::ktx2::{HEADER_BYTES, LEVEL_ENTRY_BYTES};

/// Bytes up to the first sample: the size of all, and a basic block's fields.
const FIXED_BYTES: usize = 28;

/// What a descriptor says that the header says, too, or that matters for the colours.
pub(super) struct Descriptor {
    primaries: u8,
    transfer: u8,
    texel_bytes: usize,
}

impl Descriptor {
    /// The descriptor, which lies behind a level index of this many levels.
    pub(super) fn parsed(bytes: &[u8], levels: usize) -> Result<Descriptor, Fault> {
        let (start, length) = (number(bytes, 48) as usize, number(bytes, 52) as usize);
        if start != HEADER_BYTES + LEVEL_ENTRY_BYTES * levels {
            let room = start.saturating_sub(HEADER_BYTES);
            return Err(if room > 0 && room.is_multiple_of(LEVEL_ENTRY_BYTES) && start < bytes.len() {
                let room = room / LEVEL_ENTRY_BYTES;
                field("levelCount", format!("{levels} where the level index, up to dfdByteOffset, has room for {room}"))
            } else {
                field("dfdByteOffset", format!("{start} is not where the level index of {levels} levels ends"))
            });
        }
        if length < FIXED_BYTES {
            return Err(field("dfdByteLength", format!("{length} bytes are fewer than a descriptor has")));
        }
        let Some(block) = bytes.get(start..).and_then(|rest| rest.get(..length)) else {
            return Err(Fault::Truncated("its data format descriptor (dfdByteLength)".to_owned()));
        };
        let total = number(block, 0) as usize;
        if total != length {
            return Err(field("dfdTotalSize", format!("{total} where dfdByteLength is {length}")));
        }
        if number(block, 4) != 0 {
            return Err(field("descriptorType", "it is not Khronos' basic one"));
        }
        let block_size = usize::from(u16::from_le_bytes([block[10], block[11]]));
        if block_size + 4 > length || block_size + 4 < FIXED_BYTES {
            return Err(field("descriptorBlockSize", format!("{block_size} where all descriptors have {length}")));
        }
        Ok(Descriptor { primaries: block[13], transfer: block[14], texel_bytes: usize::from(block[20]) })
    }

    /// Refuses a header that says otherwise. A supercompressed file may leave the bytes of a texel at 0.
    pub(super) fn check(&self, vk_format: u32, type_size: u32, coding: Coding) -> Result<(), Fault> {
        let (texel, size) = (coding.bytes(), coding.type_size());
        if self.texel_bytes != 0 && self.texel_bytes != texel {
            return Err(field(
                "vkFormat",
                format!(
                    "{vk_format} has texels of {texel} bytes, and bytesPlane0 of the data format descriptor says {}; one \
                     of the two is wrong",
                    self.texel_bytes
                ),
            ));
        }
        if type_size != size {
            return Err(field("typeSize", format!("{type_size} where vkFormat {vk_format} has {size}")));
        }
        let transfer = if coding.is_srgb() { 2 } else { 1 };
        if self.transfer != 0 && self.transfer != transfer {
            return Err(field(
                "transferFunction",
                format!("{} where vkFormat {vk_format} has {transfer} (1 linear, 2 sRGB)", self.transfer),
            ));
        }
        Ok(())
    }

    /// What the file's owner may not expect.
    pub(super) fn note(&self) -> Option<String> {
        // 0 is unspecified, 1 BT.709.
        (self.primaries > 1).then(|| {
            format!(
                "its colorPrimaries ({}) are not those of Rec. 709; the values are taken as Rec. 709",
                self.primaries
            )
        })
    }
}
