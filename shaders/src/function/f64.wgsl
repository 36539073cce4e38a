// In front of texture-free library code, this makes it compute in double precision.
alias f32 = f64;
alias vec2f = vec2<f64>;
alias vec3f = vec3<f64>;
alias vec4f = vec4<f64>;
alias mat3x3f = mat3x3<f64>;
