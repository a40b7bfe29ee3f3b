// One classic script and one style sheet: a page opened from a folder may load neither modules nor anything by fetch.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { defineConfig, type Plugin } from "vite";

/** The folder of the package that a module belongs to, or undefined for our own. */
function packageOf(file: string): string | undefined {
  if (!file.includes("node_modules")) return undefined;
  for (let folder = dirname(file); folder.includes("node_modules"); folder = dirname(folder)) {
    const manifest = join(folder, "package.json");
    if (existsSync(manifest) && "version" in JSON.parse(readFileSync(manifest, "utf8"))) return folder;
  }
  return undefined;
}

/** The licences of all that is bundled, each text once, ahead of the script. */
function licences(): Plugin {
  return {
    name: "licences",
    enforce: "post",
    generateBundle(_options, bundle) {
      const names = new Map<string, string[]>(); // by text
      for (const chunk of Object.values(bundle)) {
        if (chunk.type !== "chunk") continue;
        const folders = new Set(Object.keys(chunk.modules).map(packageOf));
        for (const folder of [...folders].sort()) {
          if (folder === undefined) continue;
          const manifest = JSON.parse(readFileSync(join(folder, "package.json"), "utf8")) as Record<string, string>;
          const file = ["LICENSE", "LICENSE.md", "LICENCE"].map((each) => join(folder, each)).find(existsSync);
          const text = file ? readFileSync(file, "utf8").trim() : `${manifest["license"]} licence`;
          names.set(text, [...(names.get(text) ?? []), `${manifest["name"]} ${manifest["version"]}`]);
        }
        const banner = [...names].map(([text, packages]) => `${packages.join(", ")}\n\n${text}`).join("\n\n---\n\n");
        chunk.code = `/*! This page holds these libraries:\n\n${banner.replaceAll("*/", "* /")}\n*/\n${chunk.code}`;
      }
    },
  };
}

export default defineConfig({
  plugins: [licences()],
  define: { "process.env.NODE_ENV": JSON.stringify("production") },
  esbuild: { legalComments: "none", charset: "utf8" },
  build: {
    target: "es2022",
    outDir: "dist",
    lib: { entry: "src/main.ts", formats: ["iife"], name: "parityDashboard", fileName: () => "dashboard.js", cssFileName: "dashboard" },
    reportCompressedSize: true,
  },
});
