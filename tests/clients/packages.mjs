// npm packages of the folder that `make clients` fills, for scripts that lie outside it.
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const installed = createRequire(path.join(process.env.SHOREWRIGHT_CLIENTS, "any.js"));

export const need = name => import(pathToFileURL(installed.resolve(name)));
