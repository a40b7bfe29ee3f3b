// Runs in the browser: three.js loads one scene of the contract and draws its views. render.mjs calls loadScene and
// loadEnvironment once, then drawView for each view.
import * as THREE from "three";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";

const kTones = {
  none: THREE.LinearToneMapping, // exposure and a clip to [0,1], no curve
  aces: THREE.ACESFilmicToneMapping,
  agx: THREE.AgXToneMapping,
  neutral: THREE.NeutralToneMapping,
  cineon: THREE.CineonToneMapping,
  reinhard: THREE.ReinhardToneMapping,
};

let renderer, scene;

/** lights: as in contract.json. */
export async function loadScene(url, lights) {
  const canvas = document.createElement("canvas");
  renderer = new THREE.WebGLRenderer({ canvas, antialias: false, alpha: false, premultipliedAlpha: false });
  renderer.setPixelRatio(1);
  renderer.outputColorSpace = THREE.SRGBColorSpace;

  scene = new THREE.Scene();
  scene.add(await loadModel(url));
  lights.forEach(addLight);
}

async function loadModel(url) {
  const failed = [];
  const manager = new THREE.LoadingManager();
  manager.onError = (each) => failed.push(each);
  const libraries = new URL("/three/examples/jsm/libs/", location.href).href;
  const draco = new DRACOLoader(manager).setDecoderPath(`${libraries}draco/gltf/`);
  const basis = new KTX2Loader(manager).setTranscoderPath(`${libraries}basis/`).detectSupport(renderer);
  const loader = new GLTFLoader(manager).setDRACOLoader(draco).setKTX2Loader(basis).setMeshoptDecoder(MeshoptDecoder);
  const model = (await loader.loadAsync(url)).scene;
  draco.dispose();
  basis.dispose();
  // GLTFLoader goes on without a texture that it cannot read. Its picture would be compared as if it were right.
  if (failed.length) throw new Error(`${decodeURIComponent(failed[0].split("/").pop())} cannot be read`);

  const own = [];
  model.traverse((node) => node.isLight && own.push(node));
  for (const light of own) light.removeFromParent(); // the contract lists them too
  return model;
}

/** url: of a Radiance file. three.js reads equirectangular maps just as the contract lays them out. */
export async function loadEnvironment(url) {
  const map = await new HDRLoader().setDataType(THREE.FloatType).loadAsync(url);
  const generator = new THREE.PMREMGenerator(renderer);
  map.mapping = THREE.EquirectangularReflectionMapping;
  const target = generator.fromEquirectangular(map);
  generator.dispose();
  map.dispose();
  scene.environment = target.texture;
}

// three.js since r155: lux for directional lights, candela for point and spot lights.
function addLight(light) {
  if ((light.falloff ?? "khr") !== "khr") throw new Error(`light ${light.name}: the falloff ${light.falloff} is not known`);
  const intensity = Math.max(...light.color);
  const color = new THREE.Color().setRGB(...light.color.map((each) => (intensity > 0 ? each / intensity : 0)), THREE.LinearSRGBColorSpace);
  let node;
  if (light.kind === "directional") {
    node = new THREE.DirectionalLight(color, intensity);
  } else if (light.kind === "point") {
    node = new THREE.PointLight(color, intensity, light.range || 0, 2);
  } else if (light.kind === "spot") {
    const outer = light.outerConeAngle;
    node = new THREE.SpotLight(color, intensity, light.range || 0, outer, 1 - light.innerConeAngle / outer, 2);
  } else {
    throw new Error(`light ${light.name}: the kind ${light.kind} is not known`);
  }
  node.position.set(...(light.position ?? [0, 0, 0]));
  scene.add(node);
  if (node.target) {
    node.target.position.copy(node.position).add(new THREE.Vector3(...light.direction));
    scene.add(node.target);
  }
}

/** Returns the picture as base64 of width * height * 3 bytes, the top row first. */
export function drawView(view, tone) {
  const { width, height, samples } = view;
  const limit = renderer.capabilities.maxTextureSize;
  if (Math.max(width, height) > limit) throw new Error(`${width}x${height} is larger than ${limit}, the largest picture of this WebGL`);
  renderer.setSize(width, height, false);
  scene.background = new THREE.Color().setRGB(...view.background, THREE.LinearSRGBColorSpace);
  return showPicture(averageSamples(view), view, tone);
}

// The mean of the samples in linear light, as floats: RGBA, the bottom row first.
function averageSamples({ camera, width, height, samples, filterWidth = 1 }) {
  const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, samples: 0 });
  const one = new Float32Array(4 * width * height);
  const sum = new Float32Array(4 * width * height);
  for (const [x, y] of samplePositions(samples, filterWidth)) {
    renderer.setRenderTarget(target);
    renderer.render(scene, makeCamera(camera, 1 - 2 * x, 2 * y - 1, width, height));
    renderer.readRenderTargetPixels(target, 0, 0, width, height, one);
    for (let i = 0; i < sum.length; ++i) sum[i] += one[i] / samples;
  }
  renderer.setRenderTarget(null);
  target.dispose();
  const bad = sum.reduce((count, each) => count + Number.isNaN(each), 0);
  if (bad) throw new Error(`${bad} values of the picture are not a number`);
  return sum;
}

// Places of a pixel, from its upper left corner, in a box of that width: the centre for one sample, else Hammersley points, each in the
// middle of its stratum (the same as parity's own, gpu/surface/view.h).
function samplePositions(count, filterWidth) {
  const half = 0.5 / count;
  return Array.from({ length: count }, (_, i) => {
    let radicalInverse = 0;
    for (let bits = i, digit = 0.5; bits > 0; bits >>= 1, digit /= 2) radicalInverse += digit * (bits & 1);
    return [2 * half * i + half, (radicalInverse + half) % 1].map((each) => 0.5 + filterWidth * (each - 0.5));
  });
}

// The contract's matrices as they are, the picture moved by (moveX, moveY) half pixels to the right and up.
function makeCamera(camera, moveX, moveY, width, height) {
  const made = camera.orthographic ? new THREE.OrthographicCamera() : new THREE.PerspectiveCamera(); // shaders ask which
  made.matrixAutoUpdate = false;
  made.matrixWorldAutoUpdate = false;
  made.near = camera.near;
  made.far = camera.far;
  made.matrixWorldInverse.fromArray(camera.view);
  made.matrixWorld.copy(made.matrixWorldInverse).invert();
  made.matrix.copy(made.matrixWorld);
  made.projectionMatrix.makeTranslation(moveX / width, moveY / height, 0).multiply(new THREE.Matrix4().fromArray(camera.projection));
  made.projectionMatrixInverse.copy(made.projectionMatrix).invert();
  return made;
}

// Exposure, tone curve and sRGB by three.js' own shader code, to 8 bits.
function showPicture(floats, { width, height, exposureEv }, tone) {
  const picture = new THREE.DataTexture(floats, width, height, THREE.RGBAFormat, THREE.FloatType);
  picture.needsUpdate = true;
  const material = new THREE.ShaderMaterial({
    uniforms: { picture: { value: picture } },
    vertexShader: "void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
    fragmentShader: `uniform highp sampler2D picture;
      void main() {
        gl_FragColor = vec4(max(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, 0.0), 1.0);
        #include <tonemapping_fragment>
        #include <colorspace_fragment>
      }`,
    depthTest: false,
    blending: THREE.NoBlending,
  });
  renderer.toneMapping = kTones[tone];
  renderer.toneMappingExposure = 2 ** exposureEv;
  const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
  quad.frustumCulled = false;
  renderer.render(quad, new THREE.Camera());
  renderer.toneMapping = THREE.NoToneMapping;
  for (const each of [picture, material, quad.geometry]) each.dispose();

  const gl = renderer.getContext();
  const rgba = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rgba);
  const rgb = new Uint8Array(3 * width * height);
  for (let y = 0, to = 0; y < height; ++y) {
    for (let from = 4 * width * (height - 1 - y), end = from + 4 * width; from < end; from += 4, to += 3) {
      rgb[to] = rgba[from];
      rgb[to + 1] = rgba[from + 1];
      rgb[to + 2] = rgba[from + 2];
    }
  }
  return toBase64(rgb);
}

function toBase64(bytes) {
  const parts = [];
  for (let i = 0; i < bytes.length; i += 0x8000) parts.push(String.fromCharCode(...bytes.subarray(i, i + 0x8000)));
  return btoa(parts.join(""));
}
