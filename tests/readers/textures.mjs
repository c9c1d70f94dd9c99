// Reads the textures of a GLB file by readers that know nothing of phytomer: textures.mjs MODULES GLB
//
// The Khronos validator has neither an error nor a warning. three.js loads the file, and of each material that has a
// picture it is told as JSON: its name, the size of its pictures by their own headers, how they wrap, where it is cut out,
// whether its vertices are white, and the least and the largest texture coordinates.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import path from "node:path";

globalThis.self = globalThis;
// Node knows no pictures: the size of a PNG file stands in its header.
globalThis.createImageBitmap = async (blob) => {
  const bytes = Buffer.from(await blob.arrayBuffer());
  return { width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20), close() {} };
};
const [modules, file] = process.argv.slice(2);
const require = createRequire(pathToFileURL(path.resolve(modules, "readers.js")));
const validator = require("gltf-validator");
const THREE = await import(pathToFileURL(path.resolve(modules, "three/build/three.module.js")));
const { GLTFLoader } = await import(pathToFileURL(path.resolve(modules, "three/examples/jsm/loaders/GLTFLoader.js")));

const bytes = readFileSync(file);
const { issues } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 20 });
if (issues.numErrors + issues.numWarnings > 0) {
  console.error(`${file}: ${JSON.stringify(issues.messages, null, 1)}`);
  process.exit(1);
}
const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
const size = (texture) => texture && [texture.image.width, texture.image.height];
const told = {};
gltf.scene.traverse((object) => {
  if (!object.isMesh) return;
  const { material, geometry } = object;
  const [uv, colour] = ["uv", "color"].map((name) => geometry.getAttribute(name));
  const found = (told[material.name] ??= {
    picture: size(material.map),
    relief: size(material.normalMap),
    repeats: material.map?.wrapS === THREE.RepeatWrapping && material.map?.wrapT === THREE.RepeatWrapping,
    cut: material.alphaTest,
    white: true,
    low: [Infinity, Infinity],
    high: [-Infinity, -Infinity],
  });
  for (let k = 0; k < uv.count; k++) {
    found.white &&= colour.getX(k) === 1 && colour.getY(k) === 1 && colour.getZ(k) === 1;
    for (const [place, at] of [uv.getX(k), uv.getY(k)].entries()) {
      found.low[place] = Math.min(found.low[place], at);
      found.high[place] = Math.max(found.high[place], at);
    }
  }
});
console.log(JSON.stringify({ images: gltf.parser.json.images.length, materials: told }));
