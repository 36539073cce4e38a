// Matrices of three columns, each a vector socket: where the x, y and z axes go. No wire carries a matrix.

/// The outputs of the nodes that give a matrix.
struct MatrixOutputs {
    /// first column: where the x axis goes
    x: vec3f,
    /// second column: where the y axis goes
    y: vec3f,
    /// third column: where the z axis goes
    z: vec3f,
}

/// Transform by Matrix
///
/// A vector times a matrix of three columns, and moved: x v.x + y v.y + z v.z + offset. For directions leave the offset at 0. Any matrix of four
/// by four whose last row is 0, 0, 0, 1 is this.
/// @node vector/matrix_transform   @also matrix33, matrix44, transform, linear, affine, basis
/// - v: the vector [0,0,0]
/// - x: first column: where the x axis goes [1,0,0]
/// - y: second column: where the y axis goes [0,1,0]
/// - z: third column: where the z axis goes [0,0,1]
/// - offset: where the origin goes [0,0,0]
/// - return: the vector there
fn node_vector_matrix_transform(v: vec3f, x: vec3f, y: vec3f, z: vec3f, offset: vec3f) -> vec3f {
    return x * v.x + y * v.y + z * v.z + offset;
}

/// Transform by Matrix 4
///
/// A vector of four numbers times a matrix of four columns: x v.x + y v.y + z v.z + w v.w. For projections divide by the last number.
/// @node vector/matrix4_transform   @also matrix44, transform, projection, homogeneous, color matrix
/// - v: the vector [0,0,0,1]
/// - x: first column [1,0,0,0]
/// - y: second column [0,1,0,0]
/// - z: third column [0,0,1,0]
/// - w: fourth column: where the origin goes [0,0,0,1]
/// - return: the vector there
fn node_vector_matrix4_transform(v: vec4f, x: vec4f, y: vec4f, z: vec4f, w: vec4f) -> vec4f {
    return x * v.x + y * v.y + z * v.z + w * v.w;
}

/// Multiply Matrices
///
/// The product A B of two matrices: what comes of B first and A then.
/// @node vector/matrix_multiply   @also matrix33, concatenate, compose
/// - a_x: first column of A [1,0,0]
/// - a_y: second column of A [0,1,0]
/// - a_z: third column of A [0,0,1]
/// - b_x: first column of B [1,0,0]
/// - b_y: second column of B [0,1,0]
/// - b_z: third column of B [0,0,1]
fn node_vector_matrix_multiply(a_x: vec3f, a_y: vec3f, a_z: vec3f, b_x: vec3f, b_y: vec3f, b_z: vec3f) -> MatrixOutputs {
    let m = mat3x3f(a_x, a_y, a_z) * mat3x3f(b_x, b_y, b_z);
    return MatrixOutputs(m[0], m[1], m[2]);
}

/// Transpose Matrix
///
/// Rows for columns. Of a rotation that is the way back.
/// @node vector/matrix_transpose   @also matrix33, rows, columns
/// - x: first column [1,0,0]
/// - y: second column [0,1,0]
/// - z: third column [0,0,1]
fn node_vector_matrix_transpose(x: vec3f, y: vec3f, z: vec3f) -> MatrixOutputs {
    return MatrixOutputs(vec3f(x.x, y.x, z.x), vec3f(x.y, y.y, z.y), vec3f(x.z, y.z, z.z));
}

/// Invert Matrix
///
/// The matrix that undoes another. 0 where there is none: where the columns, each over its greatest number, have a determinant nearer to 0 than
/// 1e-6, or where a column is shorter than 1e-20.
/// @node vector/matrix_inverse   @also matrix33, invertmatrix, undo, solve
/// - x: first column [1,0,0]
/// - y: second column [0,1,0]
/// - z: third column [0,0,1]
fn node_vector_matrix_inverse(x: vec3f, y: vec3f, z: vec3f) -> MatrixOutputs {
    let sizes = vec3f(greatest_of(x), greatest_of(y), greatest_of(z));
    let floors = max(sizes, vec3f(1e-20));
    let a = x / floors.x;
    let b = y / floors.y;
    let c = z / floors.z;
    let volume = dot(a, cross(b, c));
    let is_flat = abs(volume) < 1e-6 || min(sizes.x, min(sizes.y, sizes.z)) < 1e-20;
    let scale = select(1.0 / volume, 0.0, is_flat);
    // The rows of the inverse are the cross products of the columns, over the determinant.
    let row_x = cross(b, c) * (scale / floors.x);
    let row_y = cross(c, a) * (scale / floors.y);
    let row_z = cross(a, b) * (scale / floors.z);
    return node_vector_matrix_transpose(row_x, row_y, row_z);
}

/// The size of the greatest component.
fn greatest_of(v: vec3f) -> f32 {
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

/// Determinant
///
/// By how much a matrix makes volumes greater, x . (y x z): 0 where it flattens, negative where it mirrors.
/// @node vector/matrix_determinant   @also matrix33, volume, handedness, triple product
/// - x: first column [1,0,0]
/// - y: second column [0,1,0]
/// - z: third column [0,0,1]
/// - return: the determinant
fn node_vector_matrix_determinant(x: vec3f, y: vec3f, z: vec3f) -> f32 {
    return dot(x, cross(y, z));
}
