// Reads GLB files by readers that know nothing of phytomer: glb.mjs MODULES GLB [AGE=PLY…]
//
// The Khronos validator has neither an error nor a warning, and three.js loads the file. Of a life, three.js plays the
// animation to the moment of each age that is named: each leaf, flower and fruit that stands in the PLY mesh of that age
// is there, its vertices within half a step of the grid, and all others are points. The counts of each age are printed.
// Of a still with instances, still=PLY names the PLY mesh of the same age: each organ of it is an instance, whose vertices
// are where it has them.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import path from "node:path";

globalThis.self = globalThis;
const [modules, file, ...ages] = process.argv.slice(2);
const require = createRequire(pathToFileURL(path.resolve(modules, "readers.js")));
const validator = require("gltf-validator");
const THREE = await import(pathToFileURL(path.resolve(modules, "three/build/three.module.js")));
const { GLTFLoader } = await import(pathToFileURL(path.resolve(modules, "three/examples/jsm/loaders/GLTFLoader.js")));

const must = (holds, told) => {
  if (!holds) {
    console.error(`${file}: ${told}`);
    process.exit(1);
  }
};

const bytes = readFileSync(file);
const { issues } = await validator.validateBytes(new Uint8Array(bytes), { maxIssues: 20 });
must(issues.numErrors + issues.numWarnings === 0, JSON.stringify(issues.messages, null, 1));

const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
const extras = gltf.asset.extras;
const meshes = [];
gltf.scene.traverse((object) => object.isMesh && meshes.push(object));

// The places of a mesh as it is played, Z up, component by component.
const placesOf = (mesh) => {
  const components = mesh.geometry.getAttribute("_component_id");
  const found = new Map();
  const at = new THREE.Vector3();
  for (let k = 0; k < components.count; k++) {
    mesh.getVertexPosition(k, at).applyMatrix4(mesh.matrixWorld);
    const component = components.getX(k);
    if (!found.has(component)) found.set(component, []);
    found.get(component).push([at.x, -at.z, at.y]);
  }
  return found;
};

// The vertices of a PLY file of ours, component by component.
const readPly = (name) => {
  const ply = readFileSync(name);
  const end = ply.indexOf("end_header\n") + 11;
  const count = Number(/element vertex (\d+)/.exec(ply.toString("latin1", 0, end))[1]);
  const found = new Map();
  for (let k = 0; k < count; k++) {
    const from = end + 49 * k;
    const component = ply.readInt32LE(from + 44);
    if (!found.has(component)) found.set(component, []);
    found.get(component).push([0, 4, 8].map((by) => ply.readFloatLE(from + by)));
  }
  return found;
};

// The instances of all meshes, component by component: the class, and the vertices, Z up.
const readInstances = () => {
  const found = new Map();
  const [at, matrix] = [new THREE.Vector3(), new THREE.Matrix4()];
  gltf.scene.updateMatrixWorld(true);
  for (const mesh of meshes.filter((mesh) => mesh.isInstancedMesh)) {
    const [components, corners] = ["_COMPONENT_ID", "position"].map((name) => mesh.geometry.getAttribute(name));
    const [births, deaths] = ["_BIRTH_AGE", "_DEATH_AGE"].map((name) => mesh.geometry.getAttribute(name));
    must(components.count === mesh.count && births.count === mesh.count, `${mesh.name} has a number for each instance`);
    for (let k = 0; k < mesh.count; k++) {
      must(deaths.getX(k) > 3e38, `instance ${k} of ${mesh.name} lives`);
      mesh.getMatrixAt(k, matrix);
      const places = Array.from({ length: corners.count }, (_, corner) => {
        at.fromBufferAttribute(corners, corner).applyMatrix4(matrix).applyMatrix4(mesh.matrixWorld);
        return [at.x, -at.z, at.y];
      });
      const component = components.getX(k);
      must(!found.has(component), `component ${component} is once`);
      found.set(component, { of: mesh.material.name, places });
    }
  }
  return found;
};

const apart = (a, b) => Math.max(...a.map((x, k) => Math.abs(x - b[k])));
const counts = {};
for (const [age, name] of ages.map((named) => named.split("="))) {
  if (age === "still") {
    counts.still = {};
    const [ply, instances] = [readPly(name), readInstances()];
    const wood = new Set(meshes.filter((mesh) => !mesh.isInstancedMesh).flatMap((mesh) => [...placesOf(mesh).keys()]));
    must([...ply.keys()].every((component) => wood.has(component) !== instances.has(component)), "a part is missing or twice");
    for (const [component, { of, places }] of instances) {
      const truth = ply.get(component) ?? [];
      must(truth.length === places.length, `${component} has ${places.length} vertices and not ${truth.length}`);
      const off = Math.max(...places.map((place, k) => apart(place, truth[k])));
      must(off < 1e-5, `${component} is ${off} m off`);
      counts.still[of] = (counts.still[of] ?? 0) + 1;
    }
    continue;
  }
  const mixer = new THREE.AnimationMixer(gltf.scene);
  const clip = gltf.animations.find((clip) => clip.name === "life");
  const [first, last] = [extras.ages[0], extras.ages.at(-1)];
  const action = mixer.clipAction(clip).setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  mixer.setTime((clip.duration * (age - first)) / (last - first));
  gltf.scene.updateMatrixWorld(true);
  const ply = readPly(name);
  counts[age] = {};
  for (const mesh of meshes.filter((mesh) => mesh.material.name !== "wood")) {
    let standing = 0;
    for (const [component, places] of placesOf(mesh)) {
      const truth = ply.get(component);
      if (truth === undefined) {
        must(places.every((place) => apart(place, places[0]) < 1e-6), `${component} is no point at ${age}`);
        continue;
      }
      must(truth.length === places.length, `${component} has ${places.length} vertices at ${age}`);
      const off = Math.max(...places.map((place, k) => apart(place, truth[k])));
      must(off <= 0.52 * extras.step_m, `${component} is ${off} m off at ${age}, and a step has ${extras.step_m} m`);
      standing++;
    }
    counts[age][mesh.material.name] = standing;
  }
}
console.log(JSON.stringify({ counts, meshes: meshes.length, animations: gltf.animations.map((clip) => clip.duration), instances: meshes.reduce((sum, mesh) => sum + (mesh.isInstancedMesh ? mesh.count : 0), 0) }));
