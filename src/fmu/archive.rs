//! Archives in the ZIP format: written, and compared with what they should contain.
//!
//! Files are stored without compression: the bytes of compressed ones depend on the version of the compressor.
//!
//! # Example
//! ```
//! use planar_capture::fmu::{Entry, Fmu, archive};
//! use std::io::Cursor;
//!
//! let entry = |path: &str, text: &str| Entry { path: path.to_owned(), content: text.into() };
//! let mut fmu = Fmu { name: "arm".to_owned(), entries: vec![entry("sources/arm.c", "double mass = 10.0;")] };
//! let bytes = archive::bytes(&fmu)?;
//! assert!(bytes.starts_with(b"PK\x03\x04"));
//! // binaries depend on the compiler, and are not compared
//! fmu.entries.push(entry("binaries/x86_64-linux/arm.so", ""));
//! assert!(archive::is_same(Cursor::new(&bytes), &fmu));
//! fmu.entries[0] = entry("sources/arm.c", "double mass = 11.0;");
//! assert!(!archive::is_same(Cursor::new(&bytes), &fmu));
//! # Ok::<(), std::io::Error>(())
//! ```

use super::{Entry, Fmu};
use std::collections::BTreeMap;
use std::io::{self, Cursor, Read, Seek};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// The folder of what is compiled.
const BINARIES: &str = "binaries/";

/// The bytes of an archive with these files; their dates are the first that the format has.
///
/// # Errors
/// An archive that is too large for the format.
pub fn bytes(fmu: &Fmu) -> io::Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default());
    for Entry { path, content } in &fmu.entries {
        let permissions = if path.starts_with(BINARIES) { 0o755 } else { 0o644 };
        archive.start_file(path, options.unix_permissions(permissions))?;
        io::Write::write_all(&mut archive, content)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// Whether an archive has these files with this content and no others; binaries, which depend on the compiler, aside.
pub fn is_same(archive: impl Read + Seek, fmu: &Fmu) -> bool {
    let Ok(mut archive) = ZipArchive::new(archive) else { return false };
    let is_compared = |path: &str| !path.starts_with(BINARIES);
    let mut left: BTreeMap<&str, &[u8]> = fmu.entries.iter().map(|e| (e.path.as_str(), e.content.as_slice())).collect();
    left.retain(|path, _| is_compared(path));
    for index in 0..archive.len() {
        let Ok(file) = archive.by_index(index) else { return false };
        let path = file.name().to_owned();
        if !is_compared(&path) {
            continue;
        }
        let Some(content) = left.remove(path.as_str()) else { return false };
        let mut found = Vec::new();
        // no more than what is looked for: an archive can claim any size
        let read = file.take(content.len() as u64 + 1).read_to_end(&mut found);
        if read.is_err() || found != content {
            return false;
        }
    }
    left.is_empty()
}

/// Whether an archive is an FMU that this program has written.
pub fn is_generated(archive: impl Read + Seek) -> bool {
    let Ok(mut archive) = ZipArchive::new(archive) else { return false };
    let Ok(description) = archive.by_name("modelDescription.xml") else { return false };
    let mut start = Vec::new();
    description.take(2048).read_to_end(&mut start).is_ok()
        && String::from_utf8_lossy(&start).contains(r#"generationTool="planar-capture "#)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of each file that is missing, too many or other, an archive is not the same; of a binary it is.
    #[test]
    fn an_archive_is_the_same_with_all_files_and_no_others() {
        let entry = |path: &str, text: &str| Entry { path: path.to_owned(), content: text.into() };
        let entries = vec![entry("modelDescription.xml", "<x/>"), entry("sources/a.c", "a"), entry("sources/b.h", "b")];
        let fmu = Fmu { name: "a".to_owned(), entries };
        let is_same_with = |change: &dyn Fn(&mut Vec<Entry>)| {
            let mut other = fmu.clone();
            change(&mut other.entries);
            is_same(Cursor::new(bytes(&other).expect("an archive")), &fmu)
        };
        assert!(is_same_with(&|_| ()));
        assert!(is_same_with(&|entries| entries.push(entry("binaries/x86_64-linux/a.so", "code"))));
        for i in 0..3 {
            assert!(!is_same_with(&|entries| drop(entries.remove(i))), "without {i}");
            assert!(!is_same_with(&|entries| entries[i].content.push(b' ')), "{i} is longer");
        }
        assert!(!is_same_with(&|entries| entries.push(entry("sources/c.c", "c"))));
        assert!(!is_same(Cursor::new(b"no archive"), &fmu));
    }

    /// A binary can be executed, and nothing else.
    #[test]
    fn binaries_can_be_executed() {
        let entry = |path: &str| Entry { path: path.to_owned(), content: b"it".to_vec() };
        let entries = vec![entry("modelDescription.xml"), entry("binaries/x86_64-linux/a.so"), entry("sources/a.c")];
        let written = bytes(&Fmu { name: "a".to_owned(), entries }).expect("an archive");
        let mut archive = ZipArchive::new(Cursor::new(written)).expect("an archive");
        for (index, mode) in [0o644, 0o755, 0o644].into_iter().enumerate() {
            let found = archive.by_index(index).expect("a file").unix_mode().map(|mode| mode & 0o777);
            assert_eq!(found, Some(mode), "{index}");
        }
    }
}
