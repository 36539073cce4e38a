//! BRDF math: Fresnel, GGX, diffuse, split-sum terms, generic over f32 and f64.
