// In front of texture-free library code, this makes it compute in half precision. The domain there: perceptual roughness
// from 0.089, cosines from 1e-3. Floors and ceilings that f16 cannot hold have these values: its smallest normal number is
// 6.1e-5, its largest 65504.
enable f16;
alias f32 = f16;
alias vec2f = vec2<f16>;
alias vec3f = vec3<f16>;
alias vec4f = vec4<f16>;
alias mat3x3f = mat3x3<f16>;
const LENGTH2_FLOOR: f16 = 6.2e-5;
const LENGTH2_CEILING: f16 = 6e4;
const FINITE_CEILING: f16 = 6.5e4;
const N_DOT_V_FLOOR: f16 = 1e-3;
const F0_CEILING: f16 = 0.9990234375;
const F90_FLOOR: f16 = 1e-3;
const ETA_CEILING: f16 = 200.0;
const COSINE_SUM_FLOOR: f16 = 0.008;
const D_FLOOR: f16 = 6.2e-5;
const V_FLOOR: f16 = 6.2e-5;
const DIFFUSE_COSINE_FLOOR: f16 = 1e-3;
