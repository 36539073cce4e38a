//! Writes the pictures of the example materials to `examples/textures`: `cargo run -p halfvector-scene --example make_textures`.

use std::path::Path;

mod maps;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/textures");
    std::fs::create_dir_all(&folder)?;
    for (name, image) in maps::maps() {
        image.save(folder.join(name))?;
        println!("{name}: {} x {}", image.width(), image.height());
    }
    Ok(())
}
