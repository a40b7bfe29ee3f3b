// ESLint of the page: rules that find faults, by types where they need them. How the code looks is no matter of theirs.
import { fileURLToPath } from "node:url";
import js from "@eslint/js";
import { configs as lit } from "eslint-plugin-lit";
import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["**/node_modules/", "dist/"] },
  { linterOptions: { reportUnusedDisableDirectives: "error" }, rules: { eqeqeq: "error" } },
  js.configs.recommended,
  {
    files: ["**/*.ts"],
    extends: [tseslint.configs.recommendedTypeChecked, lit["flat/recommended"]],
    languageOptions: {
      parserOptions: { project: "./tsconfig.json", tsconfigRootDir: fileURLToPath(new URL("..", import.meta.url)) },
    },
    rules: { "@typescript-eslint/switch-exhaustiveness-check": "error" },
  },
  {
    files: ["**/*.js", "**/*.mjs"],
    rules: { "no-undef": "off" }, // what Node.js and browsers bring along is not known here
  },
);
