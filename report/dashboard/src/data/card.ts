// What a material's card says of each input, in words: its value, or the range of its texture.
import { encodeSrgb, toByte } from "./display";
import type { CardInput, CardTexture, MaterialCard, Scene } from "./types";

const kTitles: Record<CardInput["name"], string> = {
  baseColor: "Base colour",
  opacity: "Opacity",
  metallic: "Metallic",
  roughness: "Roughness",
  normal: "Normal",
  occlusion: "Occlusion",
  emissive: "Emissive",
  specular: "Specular",
  specularColor: "Specular colour",
  coat: "Clear coat",
  coatRoughness: "Clear coat roughness",
  coatNormal: "Clear coat normal",
  sheenColor: "Sheen colour",
  sheenRoughness: "Sheen roughness",
  anisotropy: "Anisotropy",
  anisotropyRotation: "Anisotropy rotation",
  iridescence: "Iridescence",
  iridescenceIor: "Thin film index of refraction",
  iridescenceThickness: "Thin film thickness",
  transmission: "Transmission",
  diffuseTransmission: "Diffuse transmission",
  diffuseTransmissionColor: "Diffuse transmission colour",
  ior: "Index of refraction",
  thickness: "Thickness",
  attenuationColor: "Attenuation colour",
  attenuationDistance: "Attenuation distance",
  dispersion: "Dispersion",
};
const kUnits: Partial<Record<CardInput["name"], string>> = {
  anisotropyRotation: " rad",
  iridescenceThickness: " nm",
  attenuationDistance: " m",
};
const kDefaultF0 = 0.04;
const kColors: readonly CardInput["name"][] = ["baseColor", "emissive", "specularColor", "sheenColor", "diffuseTransmissionColor", "attenuationColor"];

/** The card of a material, by its name. */
export function cardOf(scene: Scene, name: string): MaterialCard | null {
  return scene.materials?.find((card) => card.name === name) ?? null;
}

export function titleOf(input: CardInput): string {
  return kTitles[input.name] ?? input.name;
}

/** Up to three digits after the point, without zeros at the end. */
export function short(value: number): string {
  return String(Number(value.toFixed(3)));
}

function withUnit(input: CardInput, value: number): string {
  return `${short(value)}${kUnits[input.name] ?? ""}`;
}

/** "#8a6f54" of a linear colour; what is above white is cut off. */
export function hexOf(linear: readonly number[]): string {
  const bytes = linear.map((value) => toByte(encodeSrgb(Math.min(Math.max(value, 0), 1))));
  return "#" + bytes.map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

export function isColor(input: CardInput): boolean {
  return kColors.includes(input.name);
}

/** The colour that stands for the input, linear; null of what is no colour, or not known. */
export function colorOf(input: CardInput): readonly number[] | null {
  if (!isColor(input)) return null;
  const color = input.texture ? input.texture.mean : input.value;
  return color.length === 3 ? color : null;
}

const isWhite = (value: readonly number[]): boolean => value.every((each) => each === 1);

/** The value of a material without a texture there. */
function valueWords(input: CardInput): string[] {
  if (input.name === "emissive") return [`${input.value.map(short).join(", ")} (linear)`];
  if (isColor(input)) return [hexOf(input.value), `linear ${input.value.map(short).join(", ")}`];
  return [withUnit(input, input.value[0] ?? 0)];
}

/** "sRGB R 12–250, G 3–240, B 0–200", of 255. */
function channelRanges({ least, most }: CardTexture): string {
  const byte = (value: number): number => toByte(encodeSrgb(Math.min(Math.max(value, 0), 1)));
  return "sRGB " + ["R", "G", "B"].map((name, i) => `${name} ${byte(least[i] ?? 0)}–${byte(most[i] ?? 0)}`).join(", ");
}

function rangeWords(input: CardInput, texture: CardTexture): string[] {
  const { least, most, mean } = texture;
  if (mean.length === 0) return [];
  const isSame = least.every((value, i) => value === most[i]);
  if (input.name === "emissive") {
    const brightest = Math.max(...most);
    return isSame ? [`${mean.map(short).join(", ")} everywhere (linear)`] : [`up to ${short(brightest)}, mean ${mean.map(short).join(", ")} (linear)`];
  }
  if (isColor(input)) return isSame ? [`${hexOf(mean)} everywhere`] : [`mean ${hexOf(mean)}`, channelRanges(texture)];
  const range = isSame ? `${withUnit(input, mean[0] ?? 0)} everywhere` : `${short(least[0] ?? 0)} to ${withUnit(input, most[0] ?? 0)}`;
  return isSame ? [range] : [range, `mean ${withUnit(input, mean[0] ?? 0)}`];
}

/** What the factor of a texture adds; "" where it changes nothing. */
function factorWords(input: CardInput): string {
  if (input.name === "normal" || input.name === "coatNormal") return `scale ${short(input.value[0] ?? 0)}`;
  if (input.name === "anisotropyRotation") return input.value[0] === 0 ? "" : `turned by ${withUnit(input, input.value[0] ?? 0)}`;
  if (input.name === "iridescenceThickness") return ""; // its range says both ends
  if (isWhite(input.value)) return "";
  if (input.name === "occlusion") return `strength ${short(input.value[0] ?? 0)}`;
  return `texture × ${input.value.length === 3 ? `(${input.value.map(short).join(", ")})` : short(input.value[0] ?? 0)}`;
}

/** Lines about an input: value or range, then the factor. */
export function inputLines(input: CardInput): string[] {
  if (!input.texture) return valueWords(input);
  return [...rangeWords(input, input.texture), factorWords(input)].filter((line) => line !== "");
}

/** Where a texture comes from; source: the scene's file. */
export function textureFile(texture: CardTexture, source: string): string {
  if (texture.file !== "") return texture.file;
  return source.startsWith("builtin:") ? `${texture.name}, made by the program` : `${texture.name}, in ${source}`;
}

/** "2048 × 2048, green" */
export function textureFacts(texture: CardTexture): string {
  const channel: Record<CardTexture["channels"], string> = { rgb: "", r: ", red", g: ", green", b: ", blue", a: ", alpha" };
  const size = texture.width === 0 ? "not read: no mesh shows the material" : `${texture.width} × ${texture.height}`;
  return `${size}${channel[texture.channels] ?? ""}${texture.texCoord > 0 ? `, UV set ${texture.texCoord}` : ""}`;
}

/** Where a line may break in a name of a file: behind what separates its words. */
export function partsOfName(name: string): string[] {
  return name.split(/(?<=[_\-./ ])|(?<=[a-z])(?=[A-Z])/);
}

/** What else is said of the material, in words. */
export function flagsOf(card: MaterialCard): string[] {
  const flags: string[] = [];
  if (card.unlit) flags.push("unlit");
  if (card.alphaMode === "mask") flags.push(`alpha mask, cutoff ${short(card.alphaCutoff ?? 0.5)}`);
  if (card.alphaMode === "blend") flags.push("alpha blend");
  if (card.doubleSided) flags.push("two-sided");
  if (card.nonmetal) flags.push("nonmetal (detected)");
  if (card.fullyRough) flags.push("fully rough (requested)");
  if (card.vertexColors) flags.push("vertex colours");
  if (!card.unlit && card.f0.some((value) => Math.abs(value - kDefaultF0) > 1e-6)) {
    const isGrey = card.f0.every((value) => value === card.f0[0]);
    flags.push(`F0 ${isGrey ? short(card.f0[0] ?? 0) : card.f0.map(short).join(", ")} instead of ${kDefaultF0}`);
  }
  return flags;
}
