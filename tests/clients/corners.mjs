// Arrays of a mesh by its vertices to arrays by its triangles' corners, in their order: what tests compare.

// `values` hold `width` numbers a vertex; `indices` name three vertices a triangle.
export function corners(values, width, indices) {
  const found = new Float32Array(indices.length * width);
  indices.forEach((vertex, at) => {
    for (let i = 0; i < width; i++) found[at * width + i] = values[vertex * width + i];
  });
  return found;
}
