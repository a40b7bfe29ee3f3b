import { describe, expect, it } from "vitest";

import { cardOf, colorOf, flagsOf, hexOf, inputLines, partsOfName, textureFacts, textureFile, titleOf } from "../../src/data/card";
import type { CardInput, CardTexture, MaterialCard } from "../../src/data/types";
import { makeScene } from "./sample";

const kTexture: CardTexture = {
  name: "wood", file: "wood.png", channels: "g", width: 2048, height: 1024, texCoord: 0,
  picture: "images/texture-0123456789abcdef.png", least: [0.02], most: [0.98], mean: [0.4321],
};
const kCard: MaterialCard = {
  name: "wood", inputs: [], alphaMode: "opaque", doubleSided: false, unlit: false, nonmetal: false, fullyRough: false,
  vertexColors: false, f0: [0.04, 0.04, 0.04], notModelled: [],
};
const input = (name: CardInput["name"], value: number[], texture?: Partial<CardTexture>): CardInput =>
  texture ? { name, value, texture: { ...kTexture, ...texture } } : { name, value };

describe("a material's card", () => {
  it("belongs to a material of a scene, where the report has one", () => {
    const scene = makeScene("Desk", []);
    expect(cardOf({ ...scene, materials: [kCard] }, "wood")).toBe(kCard);
    expect(cardOf({ ...scene, materials: [kCard] }, "metal")).toBeNull();
    expect(cardOf(scene, "wood")).toBeNull();
  });

  it("says plain values", () => {
    expect(inputLines(input("roughness", [0.35]))).toEqual(["0.35"]);
    expect(inputLines(input("baseColor", [1, 0.2158605, 0]))).toEqual(["#ff8000", "linear 1, 0.216, 0"]);
    expect(inputLines(input("emissive", [0, 2.5, 5]))).toEqual(["0, 2.5, 5 (linear)"]);
    expect(titleOf(input("specularColor", [1, 1, 1]))).toBe("Specular colour");
    expect(inputLines(input("sheenColor", [1, 0.2158605, 0]))).toEqual(["#ff8000", "linear 1, 0.216, 0"]);
    expect(titleOf(input("coatRoughness", [0.5]))).toBe("Clear coat roughness");
    expect(titleOf(input("iridescenceThickness", [400]))).toBe("Thin film thickness");
    expect(inputLines(input("iridescenceThickness", [400]))).toEqual(["400 nm"]);
    expect(inputLines(input("iridescenceIor", [1.3]))).toEqual(["1.3"]);
    expect(inputLines(input("anisotropy", [0.8]))).toEqual(["0.8"]);
    expect(inputLines(input("anisotropyRotation", [0.7853982]))).toEqual(["0.785 rad"]);
    expect(titleOf(input("diffuseTransmissionColor", [1, 1, 1]))).toBe("Diffuse transmission colour");
    expect(inputLines(input("attenuationColor", [1, 0.2158605, 0]))).toEqual(["#ff8000", "linear 1, 0.216, 0"]);
    expect(inputLines(input("attenuationDistance", [0.25]))).toEqual(["0.25 m"]);
    expect(inputLines(input("thickness", [0.02]))).toEqual(["0.02"]);
  });

  it("says the range of a texture, and its factor only where it is not 1", () => {
    expect(inputLines(input("roughness", [1], {}))).toEqual(["0.02 to 0.98", "mean 0.432"]);
    expect(inputLines(input("roughness", [0.5], {}))).toEqual(["0.02 to 0.98", "mean 0.432", "texture × 0.5"]);
    expect(inputLines(input("metallic", [1], { least: [1], most: [1], mean: [1] }))).toEqual(["1 everywhere"]);
    expect(inputLines(input("occlusion", [0.5], {})).at(-1)).toBe("strength 0.5");
    expect(inputLines(input("normal", [2], { least: [], most: [], mean: [] }))).toEqual(["scale 2"]);
    expect(inputLines(input("coatNormal", [1], { least: [], most: [], mean: [] }))).toEqual(["scale 1"]);
    expect(inputLines(input("anisotropyRotation", [-0.5], { least: [], most: [], mean: [] }))).toEqual(["turned by -0.5 rad"]);
    expect(inputLines(input("anisotropyRotation", [0], { least: [], most: [], mean: [] }))).toEqual([]);
    expect(inputLines(input("iridescenceThickness", [400], { least: [120], most: [390], mean: [250] }))).toEqual(["120 to 390 nm", "mean 250 nm"]);
    expect(inputLines(input("iridescenceThickness", [400], { least: [250], most: [250], mean: [250] }))).toEqual(["250 nm everywhere"]);
    const color = input("baseColor", [1, 1, 1], { channels: "rgb", least: [0, 0, 0], most: [1, 0.2158605, 1], mean: [1, 0, 0] });
    expect(inputLines(color)).toEqual(["mean #ff0000", "sRGB R 0–255, G 0–128, B 0–255"]);
    const grey = input("baseColor", [1, 1, 0.5], { channels: "rgb", least: [1, 1, 0.5], most: [1, 1, 0.5], mean: [1, 1, 0.5] });
    expect(inputLines(grey)).toEqual(["#ffffbc everywhere", "texture × (1, 1, 0.5)"]);
    expect(inputLines(input("emissive", [3, 3, 3], { channels: "rgb", least: [0, 0, 0], most: [3, 2, 1], mean: [1, 0.5, 0] }))).toEqual([
      "up to 3, mean 1, 0.5, 0 (linear)", "texture × (3, 3, 3)",
    ]);
  });

  it("names the file, the channel and the size of a texture", () => {
    expect(textureFile(kTexture, "Wood.glb")).toBe("wood.png");
    expect(textureFile({ ...kTexture, file: "" }, "Wood.glb")).toBe("wood, in Wood.glb");
    expect(textureFile({ ...kTexture, file: "" }, "builtin:spheres")).toBe("wood, made by the program");
    expect(textureFacts(kTexture)).toBe("2048 × 1024, green");
    expect(textureFacts({ ...kTexture, channels: "rgb", texCoord: 1 })).toBe("2048 × 1024, UV set 1");
    expect(textureFacts({ ...kTexture, width: 0, height: 0 })).toBe("not read: no mesh shows the material, green");
    expect(partsOfName("Bottle_baseColor.png")).toEqual(["Bottle_", "base", "Color.", "png"]);
  });

  it("shows a colour only of what has one", () => {
    expect(colorOf(input("baseColor", [1, 0, 0]))).toEqual([1, 0, 0]);
    expect(colorOf(input("baseColor", [1, 1, 1], { mean: [] }))).toBeNull();
    expect(colorOf(input("roughness", [1]))).toBeNull();
    expect(hexOf([3, -1, 0.5])).toBe("#ff00bc");
  });

  it("lists what is not the default", () => {
    expect(flagsOf(kCard)).toEqual([]);
    expect(flagsOf({ ...kCard, alphaMode: "mask", alphaCutoff: 0.25, doubleSided: true, nonmetal: true })).toEqual([
      "alpha mask, cutoff 0.25", "two-sided", "nonmetal (detected)",
    ]);
    expect(flagsOf({ ...kCard, f0: [0.02, 0.02, 0.02] })).toEqual(["F0 0.02 instead of 0.04"]);
    expect(flagsOf({ ...kCard, f0: [0.04, 0.02, 0.04], unlit: true })).toEqual(["unlit"]);
    expect(flagsOf({ ...kCard, f0: [0.039999999105930328, 0.039999999105930328, 0.039999999105930328] })).toEqual([]);
  });
});
