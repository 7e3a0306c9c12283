// What Babylon makes of GLB files, in the axes of its left-handed world, as raw float32, a row a corner of a triangle:
// OUT/FILE/MESH.ARRAY.f32. node babylon_read.mjs OUT FILE …
import fs from "node:fs";
import path from "node:path";
import { corners } from "./corners.mjs";
import { need } from "./packages.mjs";

const { NullEngine, Scene, ImportMeshAsync, Vector3 } = await need("@babylonjs/core");
await need("@babylonjs/loaders/glTF/2.0/index.js");

function placed(values, width, matrix, move) {
  const found = new Float32Array(values.length);
  for (let at = 0; at < values.length; at += width) {
    const one = Vector3.FromArray(values, at);
    const there = move(one, matrix);
    found.set([there.x, there.y, there.z, values[at + 3]].slice(0, width), at);
  }
  return found;
}

const [out, ...files] = process.argv.slice(2);
for (const file of files) {
  const scene = new Scene(new NullEngine());
  await ImportMeshAsync(new Uint8Array(fs.readFileSync(file)), scene, { pluginExtension: ".glb" });
  const folder = path.join(out, path.basename(file));
  fs.mkdirSync(folder);
  for (const mesh of scene.meshes.filter(one => one.getTotalVertices() > 0)) {
    const matrix = mesh.computeWorldMatrix(true);
    const { TransformCoordinates: moved, TransformNormal: turned } = Vector3;
    const kinds = { positions: ["position", 3, moved], normals: ["normal", 3, turned], tangents: ["tangent", 4, turned],
      uv: ["uv", 2, null], colours: ["color", 4, null] };
    for (const [name, [kind, width, move]] of Object.entries(kinds)) {
      let values = mesh.getVerticesData(kind);
      if (!values) continue;
      if (move) values = placed(values, width, matrix, move);
      fs.writeFileSync(path.join(folder, `${mesh.name}.${name}.f32`), corners(values, width, mesh.getIndices()));
    }
  }
  scene.dispose();
}
process.exit(0);
