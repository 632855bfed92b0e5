//! Little-endian numbers off the front of an embedded table.

/// What is left of a table. Every reader returns `None` at its end, so that a damaged table is short and never a panic; tests count the terms.
pub(super) struct TableBytes<'a>(pub(super) &'a [u8]);

impl TableBytes<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (head, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*head)
    }

    pub(super) fn byte(&mut self) -> Option<u8> {
        self.take::<1>().map(|[byte]| byte)
    }

    pub(super) fn signed_bytes<const N: usize>(&mut self) -> Option<[i8; N]> {
        self.take::<N>().map(|bytes| bytes.map(|byte| i8::from_le_bytes([byte])))
    }

    pub(super) fn short(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    pub(super) fn count(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    pub(super) fn number(&mut self) -> Option<f64> {
        self.take().map(f64::from_le_bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::TableBytes;

    #[test]
    fn numbers_follow_each_other_until_the_end() {
        let mut bytes = Vec::from([7, 0xFE]);
        bytes.extend(513_u16.to_le_bytes());
        bytes.extend(70_000_u32.to_le_bytes());
        bytes.extend((-0.25_f64).to_le_bytes());
        let mut table = TableBytes(&bytes);
        assert_eq!((table.byte(), table.signed_bytes::<1>(), table.short()), (Some(7), Some([-2]), Some(513)));
        assert_eq!((table.count(), table.number(), table.byte()), (Some(70_000), Some(-0.25), None));
    }
}
