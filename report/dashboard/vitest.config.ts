import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    maxWorkers: 2, // each file of e2e starts a browser
    minWorkers: 1,
    projects: [
      { test: { name: "unit", include: ["tests/unit/**/*.test.ts"] } },
      {
        test: {
          name: "e2e",
          include: ["tests/e2e/**/*.test.ts"],
          setupFiles: ["tests/e2e/setup.ts"],
          expect: { poll: { timeout: 10_000 } }, // a busy machine takes its time
          testTimeout: 60_000,
          hookTimeout: 120_000,
        },
      },
    ],
  },
});
