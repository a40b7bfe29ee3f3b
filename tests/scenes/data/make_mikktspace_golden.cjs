// Makes mikktspace_golden.json: small meshes, and the tangents that the public MikkTSpace code gives their corners.
//   npm install mikktspace@1.1.1 && node make_mikktspace_golden.cjs > mikktspace_golden.json
// (mikktspace 1.1.1: D. McCurdy's WebAssembly build of gltf-rs/mikktspace, a port of M. Mikkelsen's C code.)
// The sign w is as that code gives it; glTF's is its negative.
const { generateTangents } = require('mikktspace');

let state = 12345; // a linear congruential generator, so that the file can be made again
const random = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32);
const round = (x) => Math.round(x * 1e4) / 1e4;
const unit = (v) => v.map((x) => Math.fround(x / Math.hypot(...v)));

// positions [[x,y,z]], normals, uv [[u,v]], triangles [[a,b,c]]
function emit(name, { positions, normals, uv, triangles }) {
  positions = positions.map((p) => p.map(round));
  uv = uv.map((p) => p.map(round));
  normals = normals.map(unit).map((n) => n.map((x) => Math.round(x * 1e7) / 1e7));
  const flat = (list) => new Float32Array(triangles.flat().flatMap((i) => list[i]));
  const made = generateTangents(flat(positions), flat(normals), flat(uv));
  const tangents = Array.from(made, (x) => Math.round(x * 1e6) / 1e6);
  return { name, positions: positions.flat(), normals: normals.flat(), uv: uv.flat(), indices: triangles.flat(), tangents };
}

function grid(columns, rows, point) {
  const mesh = { positions: [], normals: [], uv: [], triangles: [] };
  for (let j = 0; j <= rows; ++j)
    for (let i = 0; i <= columns; ++i) {
      const { p, n, t } = point(i / columns, j / rows);
      mesh.positions.push(p), mesh.normals.push(n), mesh.uv.push(t ?? [i / columns, j / rows]);
    }
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push([a, c, b], [b, c, d]);
    }
  return mesh;
}

const sphere = grid(12, 6, (u, v) => {
  const a = 2 * Math.PI * u, b = Math.PI * v, s = v === 0 || v === 1 ? 0 : Math.sin(b);
  const p = [s * Math.cos(a), Math.cos(b), -s * Math.sin(a)];
  return { p, n: p };
});

const torus = grid(14, 9, (u, v) => {
  const a = 2 * Math.PI * u, b = 2 * Math.PI * v;
  const n = [Math.cos(b) * Math.cos(a), Math.sin(b), Math.cos(b) * Math.sin(a)];
  return { p: [2 * Math.cos(a) + 0.7 * n[0], 0.7 * n[1], 2 * Math.sin(a) + 0.7 * n[2]], n, t: [3 * u, 2 * v + 0.3 * u] };
});

// Smooth normals over the edges of a cube whose halves x < 0 and x > 0 share one image, mirrored at x = 0.
const cube = { positions: [], normals: [], uv: [], triangles: [] };
for (let face = 0; face < 6; ++face) {
  const axis = face % 3, sign = face < 3 ? 1 : -1, first = cube.positions.length;
  const side = grid(4, 4, (u, v) => {
    const p = [0, 0, 0];
    p[axis] = sign, p[(axis + 1) % 3] = sign * (2 * u - 1), p[(axis + 2) % 3] = 2 * v - 1;
    return { p, n: p, t: [Math.abs(p[0]) + 0.25 * p[1], 0.5 * p[2] + 0.125 * Math.abs(p[0])] };
  });
  for (const key of ['positions', 'normals', 'uv']) cube[key].push(...side[key]);
  cube.triangles.push(...side.triangles.map((t) => t.map((i) => i + first)));
}

// A wrinkled sheet with random uv: both orientations, shared edges, no edge with more than two triangles.
const soup = grid(9, 9, (u, v) => ({
  p: [u + 0.06 * random(), 0.3 * random(), v + 0.06 * random()],
  n: [random() - 0.5, 1 + random(), random() - 0.5],
  t: [random(), random()],
}));

// Patches without area in uv (whole cells, single triangles, a far island) and triangles with two equal corners.
const degenerate = grid(8, 8, (u, v) => {
  const i = Math.round(8 * u), j = Math.round(8 * v);
  const t = i >= 3 && i <= 5 && j >= 2 && j <= 4 ? [0.4, 0.3] : [u, i === 7 ? 0.5 : v];
  const p = [i === 1 && j === 7 ? 0 : u, 0.2 * Math.sin(5 * u) * v, j === 7 && i === 1 ? 6 / 8 : v];
  return { p, n: [0.3 * Math.cos(5 * u), 1, 0.2], t };
});
degenerate.triangles.push([0, 0, 1], [10, 11, 11], [40, 12, 40]);

const meshes = [['sphere', sphere], ['torus', torus], ['mirrored cube', cube], ['random uv', soup], ['degenerate', degenerate]];
console.log('{"source": "npm mikktspace 1.1.1, by make_mikktspace_golden.cjs", "meshes": [');
console.log(meshes.map(([name, mesh]) => JSON.stringify(emit(name, mesh))).join(',\n'));
console.log(']}');
