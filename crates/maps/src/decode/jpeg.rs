//! Where a JPEG file's segments lie, and whether its scans hold all of the image. ITU-T T.81 (1992).
//!
//! The decoder fills what is missing with grey and does not tell, so the entropy-coded bits are gone through here once
//! more, without their transform: Huffman codes of sequential and progressive frames of 8 bits. Of anything else nothing is
//! said here.

/// What the segments of a file say.
#[derive(Debug, Default)]
pub(super) struct Jpeg {
    /// Whether they run through to the end marker. The decoder fills what is missing with grey.
    pub(super) is_complete: bool,
    /// Number of colour components in the frame.
    pub(super) components: u8,
    /// Whether it is progressive, so that all coefficients are held at once.
    pub(super) is_progressive: bool,
    /// Whether an ICC profile is there.
    pub(super) has_profile: bool,
}

/// Reads what the segments say.
pub(super) fn stated(bytes: &[u8]) -> Jpeg {
    let mut found = Jpeg::default();
    for Segment { code, content, .. } in (Segments { bytes, at: 2 }) {
        match code {
            END => found.is_complete = true,
            SEQUENTIAL..=0xc3 => {
                found.components = content.get(5).copied().unwrap_or(0);
                found.is_progressive |= code == PROGRESSIVE;
            }
            0xe2 => found.has_profile |= content.starts_with(b"ICC_PROFILE\0"),
            _ => {}
        }
    }
    found
}

const SEQUENTIAL: u8 = 0xc0;
const PROGRESSIVE: u8 = 0xc2;
const TABLES: u8 = 0xc4;
const END: u8 = 0xd9;
const SCAN: u8 = 0xda;
const RESTARTS: u8 = 0xdd;

/// The segments up to the end marker. Annex B: a marker is FF and a code; most carry a length; after SOS (DA) come
/// entropy-coded bytes in which FF is followed by 0 or by a restart marker (D0..D7), until the next marker.
struct Segments<'a> {
    bytes: &'a [u8],
    at: usize,
}

struct Segment<'a> {
    code: u8,
    /// What follows the length, as far as the file has it.
    content: &'a [u8],
    /// The entropy-coded bytes of a scan.
    scan: &'a [u8],
}

impl<'a> Iterator for Segments<'a> {
    type Item = Segment<'a>;

    fn next(&mut self) -> Option<Segment<'a>> {
        loop {
            let rest = self.bytes.get(self.at..)?;
            let &[first, code] = rest.first_chunk::<2>()?;
            match (first, code) {
                (0xff, END) => {
                    self.at = self.bytes.len();
                    return Some(Segment { code, content: &[], scan: &[] });
                }
                // Fill bytes, and markers that stand alone.
                (0xff, 0xff) => self.at += 1,
                (0xff, 0x01 | 0xd0..=0xd8) => self.at += 2,
                (0xff, 0x02..) => {
                    let &[high, low] = rest.get(2..)?.first_chunk::<2>()?;
                    let length = 2 + usize::from(u16::from_be_bytes([high, low])).max(2);
                    let content = &rest[4..length.min(rest.len())];
                    let mut scan = rest.get(length..).unwrap_or_default();
                    self.at += length;
                    if code == SCAN {
                        let is_end = |w: &[u8]| w[0] == 0xff && !matches!(w[1], 0x00 | 0xd0..=0xd7 | 0xff);
                        scan = &scan[..scan.windows(2).position(is_end).unwrap_or(scan.len())];
                        self.at += scan.len();
                    } else {
                        scan = &[];
                    }
                    return Some(Segment { code, content, scan });
                }
                // Not a marker: some writers pad between segments.
                _ => self.at += 1,
            }
        }
    }
}

/// What is wrong with the scans of a file whose segments are all there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flaw {
    /// One has fewer bits than its part of the image takes.
    Short,
    /// One has bits that are no code of its table.
    NoCode,
    /// A colour component has none.
    Missing,
    /// The last of a progressive file are not there: the whole image, coarser than it was saved.
    Coarse,
}

/// Most scans of a file that is looked at; the decoder refuses a progressive file of more.
const MOST_SCANS: usize = 100;

/// Goes through all scans; none where nothing is wrong, or where the file is of a kind that is not understood here.
pub(super) fn flaw(bytes: &[u8]) -> Option<Flaw> {
    let mut frame: Option<Frame> = None;
    let mut tables = [const { [const { None }; 4] }; 2];
    let (mut restart_interval, mut scans) = (0, 0);
    for segment in (Segments { bytes, at: 2 }) {
        match (segment.code, &mut frame) {
            (SEQUENTIAL..=PROGRESSIVE, None) => {
                frame = Some(Frame::of(segment.content, segment.code == PROGRESSIVE)?);
            }
            // Several frames, other codings.
            (0xc0..=0xcf, _) if segment.code != TABLES => return None,
            (TABLES, _) => read_tables(segment.content, &mut tables)?,
            (RESTARTS, _) => restart_interval = usize::from(u16::from_be_bytes(*segment.content.first_chunk()?)),
            (SCAN, Some(frame)) => {
                scans += 1;
                if scans > MOST_SCANS {
                    return None;
                }
                let scan = Scan::of(segment.content, frame, &tables)?;
                if let Err(flaw) = scan.go_through(frame, segment.scan, restart_interval) {
                    return Some(flaw);
                }
            }
            _ => {}
        }
    }
    let frame = frame?;
    if frame.components.iter().any(|component| component.precision[0] == NOT_SENT) {
        Some(Flaw::Missing)
    } else if frame.components.iter().any(|component| component.precision != [0; 64]) {
        Some(Flaw::Coarse)
    } else {
        None
    }
}

/// In place of a number of bits.
const NOT_SENT: u8 = 255;

struct Frame {
    is_progressive: bool,
    components: Vec<Component>,
    /// Units of all components across and down.
    units: [usize; 2],
}

struct Component {
    id: u8,
    /// Blocks across and down in a unit.
    sampling: [usize; 2],
    /// Blocks across and down that the component has by itself.
    blocks: [usize; 2],
    /// Bits of each coefficient that are still to come.
    precision: [u8; 64],
    /// Of a progressive frame: which coefficients of each block are not zero so far, units across times `sampling` a row.
    nonzero: Vec<u64>,
}

impl Frame {
    /// B.2.2; A.1.1 and A.2 for the numbers of blocks.
    fn of(content: &[u8], is_progressive: bool) -> Option<Self> {
        let (&[precision, h1, h0, w1, w0, count], parts) = content.split_first_chunk::<6>()?;
        let size = [[w1, w0], [h1, h0]].map(|bytes| usize::from(u16::from_be_bytes(bytes)));
        let parts = parts.get(..3 * usize::from(count))?;
        let samplings: Vec<_> = parts.chunks(3).map(|part| [part[1] >> 4, part[1] & 15].map(usize::from)).collect();
        let is_understood = precision == 8 && size[0] > 0 && size[1] > 0 && matches!(count, 1..=3);
        if !is_understood || samplings.as_flattened().iter().any(|n| !(1..=4).contains(n)) {
            return None;
        }
        let most = [0, 1].map(|axis| samplings.iter().map(|s| s[axis]).max().unwrap_or(1));
        let units = [0, 1].map(|axis| size[axis].div_ceil(8 * most[axis]));
        let components = parts.chunks(3).zip(&samplings).map(|(part, &sampling)| {
            let stored = if is_progressive { units[0] * units[1] * sampling[0] * sampling[1] } else { 0 };
            Component {
                id: part[0],
                sampling,
                blocks: [0, 1].map(|axis| (size[axis] * sampling[axis]).div_ceil(8 * most[axis])),
                precision: [NOT_SENT; 64],
                nonzero: vec![0; stored],
            }
        });
        Some(Self { is_progressive, components: components.collect(), units })
    }
}

/// A Huffman table, annex C.
#[derive(Clone)]
struct Table {
    /// For each 9 bits the length of the code that they begin with, times 256, and its symbol; 0 where it is longer.
    short: [u16; 512],
    /// For each length the code after its last one, moved up to 16 bits, and what is to be added to a code of this length to
    /// be the place of its symbol.
    ends: [(u32, i32); 17],
    symbols: Vec<u8>,
}

impl Table {
    fn of(counts: &[u8; 16], symbols: &[u8]) -> Option<Self> {
        let mut table = Self { short: [0; 512], ends: [(0, 0); 17], symbols: symbols.to_vec() };
        let (mut code, mut place) = (0_u32, 0_usize);
        for (length, &count) in (1_u32..).zip(counts) {
            table.ends[length as usize].1 = place as i32 - code as i32;
            for _ in 0..count {
                if length <= 9 {
                    let first = (code << (9 - length)) as usize;
                    let entry = (length as u16) << 8 | u16::from(*symbols.get(place)?);
                    table.short.get_mut(first..first + (1 << (9 - length)))?.fill(entry);
                }
                (code, place) = (code + 1, place + 1);
            }
            if code > 1 << length {
                return None;
            }
            table.ends[length as usize].0 = code << (16 - length);
            code <<= 1;
        }
        Some(table)
    }

    /// Length and symbol of the code that 16 bits begin with.
    #[inline(always)]
    fn find(&self, bits: u32) -> Option<(u32, u8)> {
        let entry = self.short[(bits >> 7) as usize % 512];
        if entry != 0 {
            return Some((u32::from(entry >> 8), entry as u8));
        }
        let length = (10..=16).find(|&length| bits < self.ends[length].0)?;
        let place = (bits >> (16 - length)) as i32 + self.ends[length].1;
        Some((length as u32, *self.symbols.get(usize::try_from(place).ok()?)?))
    }
}

/// Of sums first (DC), then of the rest (AC).
type Tables = [[Option<Table>; 4]; 2];

/// B.2.4.2.
fn read_tables(mut content: &[u8], tables: &mut Tables) -> Option<()> {
    while let Some((&class, rest)) = content.split_first() {
        let (counts, rest) = rest.split_first_chunk::<16>()?;
        let total = counts.iter().map(|&n| usize::from(n)).sum();
        let (symbols, rest) = rest.split_at_checked(total)?;
        *tables.get_mut(usize::from(class >> 4))?.get_mut(usize::from(class & 15))? = Some(Table::of(counts, symbols)?);
        content = rest;
    }
    Some(())
}

/// B.2.3.
struct Scan<'a> {
    parts: Vec<Part<'a>>,
    /// First and last coefficient in it.
    band: [u8; 2],
    /// Bits still to come before and after it; before a first scan 0.
    bits_left: [u8; 2],
}

struct Part<'a> {
    component: usize,
    sums: Option<&'a Table>,
    rest: Option<&'a Table>,
}

impl<'a> Scan<'a> {
    fn of(content: &[u8], frame: &Frame, tables: &'a Tables) -> Option<Self> {
        let (&count, content) = content.split_first()?;
        let (parts, content) = content.split_at_checked(2 * usize::from(count))?;
        let &[first, last, bits] = content.first_chunk::<3>()?;
        let part = |part: &[u8]| {
            let component = frame.components.iter().position(|component| component.id == part[0])?;
            let [sums, rest] = [(0, part[1] >> 4), (1, part[1] & 15)]
                .map(|(class, at): (usize, u8)| tables[class].get(usize::from(at)).and_then(Option::as_ref));
            Some(Part { component, sums, rest })
        };
        let parts: Vec<_> = parts.chunks(2).map(part).collect::<Option<_>>()?;
        let (band, bits_left) =
            if frame.is_progressive { ([first, last], [bits >> 4, bits & 15]) } else { ([0, 63], [0, 0]) };
        let needs_sums = band[0] == 0 && bits_left[0] == 0;
        let has_tables = |part: &Part| (!needs_sums || part.sums.is_some()) && (band[1] == 0 || part.rest.is_some());
        let is_understood = !parts.is_empty()
            && band[0] <= band[1]
            && band[1] < 64
            && (!frame.is_progressive || band[0] > 0 && parts.len() == 1 || band == [0, 0])
            && parts.iter().all(has_tables);
        is_understood.then_some(Self { parts, band, bits_left })
    }

    fn go_through(&self, frame: &mut Frame, scan: &[u8], restart_interval: usize) -> Result<(), Flaw> {
        let mut bits = Bits { rest: scan, word: 0, count: 0 };
        let is_alone = self.parts.len() == 1;
        let [across, down] = if is_alone { frame.components[self.parts[0].component].blocks } else { frame.units };
        // How many blocks more have nothing in this band.
        let mut run = 0;
        for unit in 0..across * down {
            if restart_interval > 0 && unit > 0 && unit % restart_interval == 0 {
                bits.restart()?;
                run = 0;
            }
            for part in &self.parts {
                let component = &mut frame.components[part.component];
                let [columns, rows] = if is_alone { [1, 1] } else { component.sampling };
                let stride = frame.units[0] * component.sampling[0];
                for k in 0..columns * rows {
                    let (x, y) = (unit % across * columns + k % columns, unit / across * rows + k / columns);
                    match (part, component.nonzero.get_mut(y * stride + x)) {
                        (Part { sums: Some(sums), rest: Some(rest), .. }, None) => bits.block(sums, rest)?,
                        (Part { rest: Some(rest), .. }, Some(nonzero)) if self.band[0] > 0 => {
                            if self.bits_left[0] == 0 {
                                bits.first_band(rest, self.band, nonzero, &mut run)?;
                            } else {
                                bits.refined_band(rest, self.band, nonzero, &mut run)?;
                            }
                        }
                        (Part { sums: Some(sums), .. }, _) if self.bits_left[0] == 0 => bits.sum(sums)?,
                        _ => bits.skip(1)?,
                    }
                }
            }
        }
        for part in &self.parts {
            let [first, last] = self.band.map(usize::from);
            frame.components[part.component].precision[first..=last].fill(self.bits_left[1]);
        }
        Ok(())
    }
}

/// The bits of a scan, from the highest on. The bits after a code are its value's, which is not asked for but where it
/// counts blocks.
struct Bits<'a> {
    rest: &'a [u8],
    word: u64,
    count: u32,
}

impl Bits<'_> {
    /// F.2.2.5: FF is followed by a 0, which is left out, or is a marker.
    #[inline(always)]
    fn refill(&mut self) {
        while self.count <= 56 {
            let (byte, rest) = match self.rest {
                [0xff, 0, rest @ ..] => (0xff, rest),
                [0xff, ..] | [] => return,
                [byte, rest @ ..] => (*byte, rest),
            };
            self.word |= u64::from(byte) << (56 - self.count);
            (self.rest, self.count) = (rest, self.count + 8);
        }
    }

    #[inline(always)]
    fn skip(&mut self, count: u32) -> Result<(), Flaw> {
        if self.count < count {
            self.refill();
            if self.count < count {
                return Err(Flaw::Short);
            }
        }
        self.word <<= count;
        self.count -= count;
        Ok(())
    }

    #[inline(always)]
    fn symbol(&mut self, table: &Table) -> Result<u8, Flaw> {
        if self.count < 16 {
            self.refill();
        }
        let Some((length, symbol)) = table.find((self.word >> 48) as u32) else {
            return Err(if self.count < 16 { Flaw::Short } else { Flaw::NoCode });
        };
        self.skip(length)?;
        Ok(symbol)
    }

    /// The next marker, which has to be one of restart.
    fn restart(&mut self) -> Result<(), Flaw> {
        (self.word, self.count) = (0, 0);
        let marker = self.rest.windows(2).position(|w| w[0] == 0xff && matches!(w[1], 0xd0..=0xd7));
        self.rest = &self.rest[marker.ok_or(Flaw::Short)? + 2..];
        Ok(())
    }

    /// F.2.2.1: how many bits the value has, then these.
    #[inline(always)]
    fn sum(&mut self, sums: &Table) -> Result<(), Flaw> {
        let bits = self.symbol(sums)?;
        self.skip(u32::from(bits & 15))
    }

    /// F.2.2: a block of a sequential frame.
    fn block(&mut self, sums: &Table, rest: &Table) -> Result<(), Flaw> {
        self.sum(sums)?;
        let mut k = 1;
        while k < 64 {
            let symbol = self.symbol(rest)?;
            let (zeros, bits) = (symbol >> 4, symbol & 15);
            if bits == 0 && zeros < 15 {
                break;
            }
            self.skip(u32::from(bits))?;
            k += 1 + u32::from(zeros);
        }
        Ok(())
    }

    /// The number of blocks, this one among them, that a symbol of `exponent` says to be empty from here on: G.1.2.2.
    fn empty_blocks(&mut self, exponent: u8) -> Result<usize, Flaw> {
        if self.count < 16 {
            self.refill();
        }
        let more = if exponent == 0 { 0 } else { self.word >> (64 - u32::from(exponent)) };
        self.skip(u32::from(exponent))?;
        Ok((1 << exponent) + more as usize)
    }

    /// G.1.2.2: the first bits of a band of coefficients.
    fn first_band(&mut self, rest: &Table, band: [u8; 2], nonzero: &mut u64, run: &mut usize) -> Result<(), Flaw> {
        if *run > 0 {
            *run -= 1;
            return Ok(());
        }
        let mut k = band[0];
        while k <= band[1] {
            let symbol = self.symbol(rest)?;
            let (zeros, bits) = (symbol >> 4, symbol & 15);
            if bits == 0 && zeros < 15 {
                *run = self.empty_blocks(zeros)? - 1;
                break;
            }
            k += zeros;
            self.skip(u32::from(bits))?;
            if bits > 0 && k < 64 {
                *nonzero |= 1 << k;
            }
            k += 1;
        }
        Ok(())
    }

    /// G.1.2.3: one bit more of each coefficient of a band that is not zero, and those that are no longer.
    fn refined_band(&mut self, rest: &Table, band: [u8; 2], nonzero: &mut u64, run: &mut usize) -> Result<(), Flaw> {
        let mut k = band[0];
        if *run == 0 {
            while k <= band[1] {
                let symbol = self.symbol(rest)?;
                let (mut zeros, is_new) = (symbol >> 4, symbol & 15 > 0);
                if !is_new && zeros < 15 {
                    *run = self.empty_blocks(zeros)?;
                    break;
                }
                self.skip(u32::from(is_new))?;
                while k <= band[1] {
                    if *nonzero >> k & 1 == 1 {
                        self.skip(1)?;
                    } else if zeros == 0 {
                        break;
                    } else {
                        zeros -= 1;
                    }
                    k += 1;
                }
                if is_new && k <= band[1] {
                    *nonzero |= 1 << k;
                }
                k += 1;
            }
        }
        if *run > 0 {
            let left = if k > band[1] { 0 } else { *nonzero >> k & (u64::MAX >> (63 - (band[1] - k))) };
            (0..left.count_ones()).try_for_each(|_| self.skip(1))?;
            *run -= 1;
        }
        Ok(())
    }
}
