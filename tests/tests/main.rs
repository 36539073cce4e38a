//! Tests across crates, in one binary. Each module is one kind of test; data that is not there is skipped with a printed
//! line, a missing GPU or browser too, unless `HALFVECTOR_REQUIRE_GPU=1` and `HALFVECTOR_REQUIRE_BROWSER=1`.

mod accuracy;
mod bake;
mod bevy;
mod browser;
mod device;
mod docs;
mod drawn;
mod editor;
mod examples;
mod golden;
mod images;
mod interp;
mod live;
mod methods;
mod models;
mod nodes;
mod normal_tangent;
mod normal_tangent_texels;
mod raster;
mod relief;
mod spaces;
mod specular_aa;
mod support;
mod tidy;
mod truth;
mod twins;
mod vertex_color;
mod web;
