//! The commands, one file each.

pub(crate) mod bake;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod edit;
pub(crate) mod export;
pub(crate) mod first_light;
pub(crate) mod methods;
pub(crate) mod nodes;
pub(crate) mod render;
pub(crate) mod report;
