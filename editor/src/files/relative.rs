//! Paths of images in a document that moves to another folder: they go on meaning the same files.

use std::path::{Component, Path, PathBuf};

use halfvector_graph::value::{ImageRef, Value};

/// A value whose image path started at the folder `from`, as it is written when paths start at `to`. Absolute paths and
/// all other values stay.
pub(crate) fn moved(value: &Value, from: &Path, to: &Path) -> Option<Value> {
    let Value::Image(image) = value else { return None };
    if image.file.is_empty() || Path::new(&image.file).is_absolute() {
        return None;
    }
    let file = written(&from.join(&image.file), to);
    (file != image.file).then(|| Value::Image(ImageRef { file, ..image.clone() }))
}

/// A file as a document of the folder `to` names it: relative with `/`, or absolute where there is no way (another drive).
pub(crate) fn written(file: &Path, to: &Path) -> String {
    let (file, to) = (plain(file), plain(to));
    let (ours, theirs): (Vec<Component>, Vec<Component>) = (to.components().collect(), file.components().collect());
    let shared = ours.iter().zip(&theirs).take_while(|(a, b)| a == b).count();
    let way: Option<Vec<&str>> = if shared == 0 {
        None
    } else {
        let up = ours[shared..].iter().map(|_| Some(".."));
        up.chain(theirs[shared..].iter().map(|part| part.as_os_str().to_str())).collect()
    };
    way.map_or_else(|| file.to_string_lossy().into_owned(), |way| way.join("/"))
}

/// Absolute, without `.` and `..`; links of the folders that exist are followed.
fn plain(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut plain = PathBuf::new();
    for part in absolute.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            part => {
                plain.push(part);
                // A link is followed before `..` is taken.
                if let Ok(real) = plain.canonicalize().map(undecorated) {
                    plain = real;
                }
            }
        }
    }
    plain
}

/// Without Windows' prefix `\\?\`, which other programs do not know.
fn undecorated(path: PathBuf) -> PathBuf {
    match path.to_str().and_then(|text| text.strip_prefix(r"\\?\")) {
        Some(rest) if !rest.starts_with("UNC") => PathBuf::from(rest),
        _ => path,
    }
}
