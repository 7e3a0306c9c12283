// What Khronos' validator says of GLB files, as JSON: issues by file. node validate.mjs FILE …
import fs from "node:fs";
import { need } from "./packages.mjs";

const { default: validator } = await need("gltf-validator");
const told = {};
for (const path of process.argv.slice(2)) {
  told[path] = (await validator.validateBytes(new Uint8Array(fs.readFileSync(path)))).issues;
}
console.log(JSON.stringify(told));
