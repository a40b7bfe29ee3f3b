// The names of the terms that a path's colour is the sum of, as people read them (shading/terms.h).

/** In the order of the report. */
export const kTermNames = [
  "sunDiffuse",
  "sunSpecular",
  "localDiffuse",
  "localSpecular",
  "lightmap",
  "skyDiffuse",
  "skySpecular",
  "emissive",
  "fog",
] as const;

/** "skySpecular" is "sky specular". */
export function termLabel(term: string): string {
  return term.replace(/[A-Z]/g, (letter) => " " + letter.toLowerCase());
}
