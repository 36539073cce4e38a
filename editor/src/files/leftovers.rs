//! What a save leaves behind that is killed before its end: the temporary file, `.NAME.PROCESS-NUMBER.tmp`, that was to take the
//! document's name. It is cleared away with a later save.

use std::path::Path;
use std::time::{Duration, SystemTime};

/// A save takes seconds: what is older than this is nobody's any more.
const NOBODYS: Duration = Duration::from_secs(600);

/// Removes what is left of saves of a file. What cannot be removed stays: the document is safe without.
pub(crate) fn clear(path: &Path) {
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let (Some(folder), Some(name)) = (target.parent(), target.file_name().and_then(|name| name.to_str())) else {
        return;
    };
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let start = format!(".{name}.");
    for entry in entries.flatten() {
        let other = entry.file_name();
        let between = other.to_str().and_then(|other| other.strip_prefix(&start)?.strip_suffix(".tmp"));
        let is_temporary = between.and_then(|between| between.split_once('-')).is_some_and(|(process, number)| {
            [process, number].iter().all(|part| !part.is_empty() && part.bytes().all(|digit| digit.is_ascii_digit()))
        });
        let written = entry.metadata().and_then(|metadata| metadata.modified());
        let age = written.ok().and_then(|written| SystemTime::now().duration_since(written).ok());
        if is_temporary && age.is_some_and(|age| age > NOBODYS) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}
