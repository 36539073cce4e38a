use crate::library::Library;

#[test]
fn the_standard_library_is_read_quickly() {
    let files: Vec<(&str, &str)> = halfvector_shaders::FILES.iter().map(|f| (f.path, f.source)).collect();
    let start = std::time::Instant::now();
    match Library::parse(&files) {
        Ok(library) => {
            println!("{} nodes in {:?}", library.iter().len(), start.elapsed());
        }
        Err(e) => panic!("{e}"),
    }
}
