//! Texture maps: decoding with limits, colour spaces, mip chains, normal mapping, tangent frames.
