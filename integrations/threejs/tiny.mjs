// A tiny contract of made things whose pictures are known in closed form, for the tests of the adapters:
//   centres   unlit quads of .4 pixels, half of them over pixel centres, half of them beside: which pixels are covered
//   edges     an unlit quad whose edges cut pixels at known fractions
//   colours   a row of unlit quads of known codes, one stop brighter by the view's exposure
//   ball      a mirror ball under a map with a patch of its own colour in each of six directions, seen from two sides
//   lights    a diffuse plane under a directional, a point and a spot light; the file holds a light that is to be removed
import { cpSync, mkdirSync, mkdtempSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const kBackground = [0.18, 0.18, 0.18];
export const toCode = (linear) => {
  const c = Math.min(Math.max(linear, 0), 1); // IEC 61966-2-1
  return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
};
const add = (a, b, scale = 1) => a.map((each, i) => each + scale * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((each) => each / Math.hypot(...a));

/** The camera of a view; one of fovYDeg and halfHeight is given. */
function makeCamera({ position, target, up = [0, 1, 0], fovYDeg = 0, halfHeight = 0, near = 0.1, far = 100 }, aspect) {
  const back = unit(add(position, target, -1));
  const right = unit(cross(up, back));
  const above = cross(back, right);
  const view = [0, 1, 2].flatMap((i) => [right[i], above[i], back[i], 0]).concat([-dot(right, position), -dot(above, position), -dot(back, position), 1]);
  const scale = halfHeight ? 1 / halfHeight : 1 / Math.tan((fovYDeg * Math.PI) / 360);
  const projection = halfHeight
    ? [scale / aspect, 0, 0, 0, 0, scale, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1]
    : [scale / aspect, 0, 0, 0, 0, scale, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
  return { view, projection, position, target, up, orthographic: !!halfHeight, fovYDeg, halfHeight, near, far, right, above, back, scale };
}

function makeView(name, scene, camera, width, height, more = {}) {
  const full = makeCamera(camera, width / height);
  return { name, picture: `${scene}-${name}.png`, width, height, samples: 1, background: kBackground, exposureEv: 0, transfer: "srgb", camera: full, ...more };
}

/** The point that is seen at (x, y) of a view's picture, in pixels from the upper left corner, at a depth. */
function placeAt({ camera, width, height }, x, y, depth = 4) {
  const reach = (camera.orthographic ? 1 : depth) / camera.scale;
  const [right, up] = [((2 * x) / width - 1) * reach * (width / height), (1 - (2 * y) / height) * reach];
  return add(add(add(camera.position, camera.right, right), camera.above, up), camera.back, -depth);
}

/** A quad that covers the pixels [x0, x1] x [y0, y1] of a view. */
function makeQuad(view, x0, y0, x1, y1, color) {
  const positions = [[x0, y0], [x0, y1], [x1, y1], [x1, y0]].map(([x, y]) => placeAt(view, x, y));
  return { positions, normals: positions.map(() => view.camera.back), indices: [0, 1, 2, 0, 2, 3], color };
}

function makeBall() {
  const [rings, sectors] = [96, 192];
  const ball = { positions: [], normals: [], indices: [], color: [1, 1, 1] };
  for (let i = 0; i <= rings; ++i) {
    for (let j = 0; j <= sectors; ++j) {
      const [theta, phi] = [(i * Math.PI) / rings, (j * 2 * Math.PI) / sectors];
      ball.positions.push([Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi)]);
    }
  }
  ball.normals = ball.positions;
  for (let i = 0; i < rings; ++i) {
    for (let j = 0; j < sectors; ++j) {
      const a = i * (sectors + 1) + j;
      ball.indices.push(a, a + sectors + 1, a + sectors + 2, a, a + sectors + 2, a + 1);
    }
  }
  return ball;
}

/** A .glb of meshes {positions, normals, indices, color}; material(color) makes the glTF material. */
function makeGlb(meshes, material, light = null) {
  const parts = [];
  const gltf = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [] }], nodes: [], meshes: [], materials: [], accessors: [], bufferViews: [], buffers: [] };
  let bytes = 0;
  const addAccessor = (array, type, componentType, more) => {
    const data = Buffer.from(array.buffer);
    gltf.bufferViews.push({ buffer: 0, byteOffset: bytes, byteLength: data.length });
    parts.push(data);
    bytes += data.length;
    return gltf.accessors.push({ bufferView: gltf.bufferViews.length - 1, componentType, type, ...more }) - 1;
  };
  for (const mesh of meshes) {
    const reduce = (pick) => [0, 1, 2].map((i) => mesh.positions.reduce((best, p) => pick(best, Math.fround(p[i])), Math.fround(mesh.positions[0][i])));
    const POSITION = addAccessor(Float32Array.from(mesh.positions.flat()), "VEC3", 5126, { count: mesh.positions.length, min: reduce(Math.min), max: reduce(Math.max) });
    const NORMAL = addAccessor(Float32Array.from(mesh.normals.flat()), "VEC3", 5126, { count: mesh.normals.length });
    const indices = addAccessor(Uint32Array.from(mesh.indices), "SCALAR", 5125, { count: mesh.indices.length });
    gltf.materials.push(material(mesh.color));
    gltf.meshes.push({ primitives: [{ attributes: { POSITION, NORMAL }, indices, material: gltf.materials.length - 1 }] });
    gltf.scenes[0].nodes.push(gltf.nodes.push({ mesh: gltf.meshes.length - 1 }) - 1);
  }
  const extensions = new Set(gltf.materials.flatMap((each) => Object.keys(each.extensions ?? {})));
  if (light) {
    extensions.add("KHR_lights_punctual");
    gltf.extensions = { KHR_lights_punctual: { lights: [light] } };
    gltf.scenes[0].nodes.push(gltf.nodes.push({ extensions: { KHR_lights_punctual: { light: 0 } } }) - 1);
  }
  if (extensions.size) gltf.extensionsUsed = [...extensions];
  gltf.buffers.push({ byteLength: bytes });
  const text = Buffer.from(JSON.stringify(gltf));
  const json = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, " ")]);
  const head = (numbers) => Buffer.from(Uint32Array.from(numbers).buffer);
  return Buffer.concat([head([0x46546c67, 2, 28 + json.length + bytes]), head([json.length, 0x4e4f534a]), json, head([bytes, 0x004e4942]), ...parts]);
}

/** A Radiance file without run lengths. radiance: direction -> [r, g, b], asked at the middle of each texel. */
function makeHdr(width, height, radiance) {
  const pixels = Buffer.alloc(4 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const [phi, theta] = [((x + 0.5) / width - 0.5) * 2 * Math.PI, ((y + 0.5) / height) * Math.PI]; // u = atan2(z, x) / 2 pi + .5
      const rgb = radiance([Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)]);
      const most = Math.max(...rgb);
      if (most < 1e-30) continue;
      const exponent = Math.floor(Math.log2(most)) + 1;
      pixels.set([...rgb.map((each) => Math.floor((each * 256) / 2 ** exponent)), exponent + 128], 4 * (y * width + x));
    }
  }
  return Buffer.concat([Buffer.from(`#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`), pixels]);
}

const unlit = (color) => ({ pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor: 0, roughnessFactor: 1 }, extensions: { KHR_materials_unlit: {} } });
const mirror = (color) => ({ pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor: 1, roughnessFactor: 0 } });
const diffuse = (color) => ({ pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor: 0, roughnessFactor: 1 }, extensions: { KHR_materials_specular: { specularFactor: 0 } } });

export const kPatches = [
  { direction: [1, 0, 0], color: [0.5, 0, 0], name: "+X red" },
  { direction: [-1, 0, 0], color: [0, 0.5, 0.5], name: "-X cyan" },
  { direction: [0, 1, 0], color: [0, 0.5, 0], name: "+Y green" },
  { direction: [0, -1, 0], color: [0.5, 0, 0.5], name: "-Y magenta" },
  { direction: [0, 0, 1], color: [0, 0, 0.5], name: "+Z blue" },
  { direction: [0, 0, -1], color: [0.5, 0.5, 0], name: "-Z yellow" },
];

/** A patch reaches to 37 degrees from its direction: places 31 degrees off have its colour, places 43 degrees off have not. */
export const kPatchCosine = 0.8;
export const kRestOfMap = [0.05, 0.05, 0.05];

/** Directions at an angle from an axis of the world, on its four sides. */
export function directionsBeside(axis, degrees) {
  const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
  const sides = kPatches.map((each) => each.direction).filter((each) => dot(each, axis) === 0);
  return sides.map((side) => add(axis.map((each) => c * each), side, s));
}

/** The pixel of a view of the ball (of radius 1, at the origin, orthographic) that reflects a direction; none where the
 * normal is more than `most` degrees from the view, for the reflection is small there. */
export function reflectedAt({ camera, width, height }, direction, most) {
  const half = add(direction, camera.back); // the mirror's normal lies between the ways to the eye and to the light
  if (Math.hypot(...half) < 2 * Math.cos((most * Math.PI) / 180)) return null;
  const normal = unit(half);
  return [(width / 2) * (1 + (dot(normal, camera.right) * camera.scale * height) / width), (height / 2) * (1 - dot(normal, camera.above) * camera.scale)].map(Math.floor);
}

// Odd multiples of 1/64: rasterizers round places to 1/16 of a pixel or finer, and no edge is to lie halfway between two.
export const kEdges = { left: 10.265625, right: 40.640625, top: 8.765625, bottom: 30.390625, color: [1, 0.5, 0.25] };
export const kColours = [[0, 0, 0], [1, 1, 1], [0.5, 0.5, 0.5], [0.002, 0.01, 0.05], [0.18, 0.4, 0.8], [1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** The quads of `centres`: pixel (x, y) is covered where covered is true. */
export const kCentres = Array.from({ length: 24 * 16 }, (_, i) => {
  const [x, y] = [i % 24, Math.floor(i / 24)];
  const kind = (x + 2 * y) % 5; // over the centre, or beside it on one of four sides
  const [dx, dy] = [[0.3, 0.3], [0.55, 0.3], [0.05, 0.3], [0.3, 0.55], [0.3, 0.05]][kind];
  return { x, y, covered: kind === 0, box: [x + dx, y + dy, x + dx + 0.4, y + dy + 0.4] };
});

/** Radiance of the plane of `lights`, albedo .8, at its places: [x, y, colour]; a Lambert surface under E lux shows albedo E / pi. */
export function lightsAt() {
  const albedo = 0.8;
  const directional = (0.6 * albedo) / Math.PI; // 1 lux at 53.13 degrees from the normal
  const point = (4 / 2 ** 2 / Math.PI) * albedo; // 4 candela at 2 m
  const beside = (4 / (2 ** 2 + 4 ** 2) / Math.PI) * albedo * (2 / Math.hypot(2, 4)); // the same lamp from 4 m beside
  const spot = (9 / 3 ** 2 / Math.PI) * albedo; // 9 candela at 3 m, inside the inner cone
  return [
    { x: 12, y: 12, color: [directional + point, directional, directional] }, // below the point light, outside the spot
    { x: 36, y: 12, color: [directional + beside, directional + spot, directional] }, // in the middle of the spot
  ];
}

/** Writes the contract and returns it. samples: of the views that do not ask for one. */
export function writeTinyContract(folder, samples = 16) {
  mkdirSync(join(folder, "0"), { recursive: true });
  const oblique = { position: [1, 2, 5], target: [0.2, 0.1, -0.3], fovYDeg: 35 };
  const scenes = [];
  const addScene = (name, glb, views, more = {}) => {
    writeFileSync(join(folder, `0/${name}.glb`), glb);
    scenes.push({ name, scene: `0/${name}.glb`, environment: null, lights: [], views, ...more });
  };

  const centres = makeView("oblique", "centres", oblique, 24, 16);
  addScene("centres", makeGlb(kCentres.map(({ box }) => makeQuad(centres, ...box, [1, 1, 1])), unlit), [centres]);

  const edges = makeView("oblique", "edges", oblique, 60, 40, { samples });
  const { left, top, right, bottom, color } = kEdges;
  addScene("edges", makeGlb([makeQuad(edges, left, top, right, bottom, color)], unlit), [edges]);

  const colours = makeView("plain", "colours", { position: [0, 0, 5], target: [0, 0, 0], halfHeight: 1 }, 8 * kColours.length, 8);
  const brighter = { ...colours, name: "brighter", picture: "colours-brighter.png", exposureEv: 1 };
  addScene("colours", makeGlb(kColours.map((each, i) => makeQuad(colours, 8 * i, 0, 8 * i + 8, 4, each)), unlit), [colours, brighter]);

  const ballViews = [
    makeView("front", "ball", { position: [0, 0, 5], target: [0, 0, 0], halfHeight: 1.25 }, 96, 72, { samples }),
    makeView("side", "ball", { position: [5, 0, 0], target: [0, 0, 0], halfHeight: 1.25 }, 96, 72, { samples }),
  ];
  writeFileSync(join(folder, "0/patches.hdr"), makeHdr(512, 256, (d) => kPatches.find((each) => dot(each.direction, d) > kPatchCosine)?.color ?? kRestOfMap));
  addScene("ball", makeGlb([makeBall()], mirror), ballViews, { environment: { file: "0/patches.hdr" } });

  const lights = makeView("above", "lights", { position: [0, 0, 5], target: [0, 0, 0], halfHeight: 2 }, 48, 24);
  const under = (x, y) => placeAt(lights, x + 0.5, y + 0.5, 5); // the plane is z = 0
  const plane = makeQuad({ ...lights, camera: { ...lights.camera, position: [0, 0, 4] } }, -8, -8, 56, 32, [0.8, 0.8, 0.8]);
  const file = { type: "directional", intensity: 3, color: [1, 1, 1] }; // the scene's list does not hold it, so no picture shows it
  addScene("lights", makeGlb([plane], diffuse, file), [lights], {
    lights: [
      { name: "sun", kind: "directional", color: [1, 1, 1], position: [0, 0, 0], direction: [0.8, 0, -0.6], range: 0, innerConeAngle: 0, outerConeAngle: 0 },
      { name: "lamp", kind: "point", color: [4, 0, 0], position: add(under(12, 12), [0, 0, 2]), direction: [0, 0, -1], range: 0, innerConeAngle: 0, outerConeAngle: 0 },
      { name: "spot", kind: "spot", color: [0, 9, 0], position: add(under(36, 12), [0, 0, 3]), direction: [0, 0, -1], range: 0, innerConeAngle: 0.15, outerConeAngle: 0.3 },
    ],
  });
  const contract = { format: 1, tool: "parity 0.2.0", scenes };
  writeFileSync(join(folder, "contract.json"), JSON.stringify(contract, null, 1));
  return contract;
}

/** A copy of the contract in `folder`/contract with one of its scenes, changed. Returns where it lies. */
export function changedContract(folder, contract, name, change) {
  const copy = mkdtempSync(join(folder, "changed-"));
  cpSync(join(folder, "contract"), copy, { recursive: true });
  const changed = structuredClone({ ...contract, scenes: contract.scenes.filter((each) => each.name === name) });
  change(changed, copy);
  writeFileSync(join(copy, "contract.json"), JSON.stringify(changed));
  return copy;
}
