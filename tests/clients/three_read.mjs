// What three.js makes of the files named in the page's query: arrays of meshes, a row a corner of a triangle; samples
// of EXR pictures in its own order; where a ray down through the ground hits; and a picture of all meshes together.
import * as THREE from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { corners } from "./corners.mjs";

const query = new URLSearchParams(location.search);
const numbers = name => query.get(name).split(",").map(Number);
const meshes = [];

for (const file of query.getAll("glb")) {
  const { scene } = await new GLTFLoader().loadAsync(file);
  scene.updateMatrixWorld(true);
  for (const mesh of [scene, ...scene.children].filter(one => one.isMesh)) {
    meshes.push({ file, mesh });
    await postArrays(file, mesh);
  }
}
for (const file of query.getAll("exr")) {
  const { data } = await new EXRLoader().setDataType(THREE.FloatType).loadAsync(file).then(one => one.image);
  await post(`${file}.f32`, new Float32Array(data));
}
if (query.has("ray")) {
  const [x, z] = numbers("ray");
  const ray = new THREE.Raycaster(new THREE.Vector3(x, 1000, z), new THREE.Vector3(0, -1, 0));
  const hits = ray.intersectObjects(meshes.filter(one => one.file === query.get("ground")).map(one => one.mesh));
  await post("ray.json", JSON.stringify(hits.map(hit => hit.point.toArray())));
}
if (query.has("size")) await draw();
await post("done", "");

async function postArrays(file, mesh) {
  const { geometry, matrixWorld } = mesh, turn = new THREE.Matrix3().getNormalMatrix(matrixWorld);
  const placed = { positions: geometry.attributes.position.clone().applyMatrix4(matrixWorld),
    normals: geometry.attributes.normal.clone().applyNormalMatrix(turn),
    uv: geometry.attributes.uv, colours: geometry.attributes.color,
    tangents: geometry.attributes.tangent?.clone().transformDirection(matrixWorld) };
  for (const [name, attribute] of Object.entries(placed)) {
    if (!attribute) continue;
    const values = attribute.array, top = attribute.normalized ? 65535 : 1;
    const found = corners(values, attribute.itemSize, geometry.index.array).map(value => value / top);
    await post(`${file}/${mesh.name}.${name}.f32`, found);
  }
}

// From above, north on top, a pixel a metre or whatever `size` says: each file in a colour of its own, without light.
async function draw() {
  const [width, height, east, north] = numbers("size");
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(width, height);
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  const scene = new THREE.Scene(), colours = { terrain: 0x808080, beach: 0xff0000, rivers: 0x0000ff };
  for (const { file, mesh } of meshes) {
    const kind = Object.keys(colours).find(one => file.includes(one));
    if (!kind) continue;
    mesh.material = new THREE.MeshBasicMaterial({ color: colours[kind], depthTest: false });
    mesh.renderOrder = Object.keys(colours).indexOf(kind);
    scene.add(mesh);
  }
  const above = new THREE.OrthographicCamera(0, east, north, 0, 1, 2000);
  above.position.y = 1000;
  above.rotation.x = -Math.PI / 2; // looks down, north on top
  renderer.render(scene, above);
  await post("above.png", await new Promise(done => renderer.domElement.toBlob(done)));
}
