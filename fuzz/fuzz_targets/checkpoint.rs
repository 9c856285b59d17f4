//! The bytes of a checkpoint: as they are, and with length and checksums made right, so that what
//! comes after these is read too.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sph_io::Checkpoint;

/// Bytes before the header, and of the checksum at the end.
const PREFIX: usize = 32;
const SUFFIX: usize = 4;

fuzz_target!(|bytes: &[u8]| {
    read(bytes);
    if let Some(mended) = mended(bytes) {
        read(&mended);
    }
});

fn read(bytes: &[u8]) {
    if let Ok(checkpoint) = Checkpoint::from_bytes(bytes) {
        let numbers: usize = checkpoint.columns.iter().map(|c| c.data.len()).sum();
        assert!(4 * numbers <= bytes.len(), "more numbers than bytes");
        for column in &checkpoint.columns {
            assert!(column.components > 0 && column.data.len() % column.components == 0);
        }
    }
}

fn mended(bytes: &[u8]) -> Option<Vec<u8>> {
    let header = bytes.get(24..PREFIX)?.try_into().ok()?;
    let header = usize::try_from(u64::from_le_bytes(header)).ok()?;
    let text = bytes.get(PREFIX..PREFIX.checked_add(header)?)?;
    let mut all = bytes.to_vec();
    all[12..16].copy_from_slice(&crc32fast::hash(text).to_le_bytes());
    all[16..24].copy_from_slice(&(bytes.len() as u64).to_le_bytes());
    let end = all.len().checked_sub(SUFFIX)?;
    let sum = crc32fast::hash(&all[..end]);
    all[end..].copy_from_slice(&sum.to_le_bytes());
    Some(all)
}
