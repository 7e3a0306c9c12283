// A path between two places on a navmesh that Recast makes of a GLB read by three.js: points in glTF axes, as JSON.
// node recast_path.mjs FILE fromX,fromY,fromZ toX,toY,toZ
import fs from "node:fs";
import { need } from "./packages.mjs";

const { GLTFLoader } = await need("three/addons/loaders/GLTFLoader.js");
const { init, NavMeshQuery } = await need("recast-navigation");
const { generateTiledNavMesh } = await need("recast-navigation/generators");
const CELL_M = 0.5, STEEPEST_DEG = 60; // cells of half a metre; the mesh itself says where it is too steep

const [path, ...places] = process.argv.slice(2);
const [from, to] = places.map(place => place.split(",").map(Number)).map(([x, y, z]) => ({ x, y, z }));
const bytes = fs.readFileSync(path);
const { scene } = await new GLTFLoader().parseAsync(new Uint8Array(bytes).buffer, "");
const { geometry } = scene.getObjectByProperty("isMesh", true);

await init();
const climb = Math.ceil((CELL_M * Math.tan(STEEPEST_DEG * Math.PI / 180)) / 0.2);
const { success, navMesh, error } = generateTiledNavMesh(geometry.attributes.position.array, geometry.index.array, {
  cs: CELL_M, ch: 0.2, tileSize: 128, walkableSlopeAngle: STEEPEST_DEG, walkableClimb: climb,
  walkableRadius: 1, walkableHeight: 9 });
if (!success) throw new Error(error);
const found = new NavMeshQuery(navMesh).computePath(from, to, { halfExtents: { x: 3, y: 3, z: 3 } });
console.log(JSON.stringify({ success: found.success, points: found.path.map(({ x, y, z }) => [x, y, z]) }));
