//! A material document becomes WGSL: named passes, reflection, export targets.
