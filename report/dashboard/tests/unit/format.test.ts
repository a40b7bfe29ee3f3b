import { describe, expect, it } from "vitest";

import type { Statistic } from "../../src/data/types";
import { change, count, duration, figure, figureIn, fixed, signed } from "../../src/format";
import { makeFigures } from "./sample";

const make = (patch: Partial<Statistic>): Statistic => ({ label: "", unit: "", digits: 3, better: "lower", ...patch });

describe("figures as people read them", () => {
  it("have their digits and unit", () => {
    expect(figure(0.1416, make({}))).toBe("0.142");
    expect(figure(31.44, make({ unit: "dB", digits: 1, better: "higher" }))).toBe("31.4 dB");
    expect(figure(0.31, make({ unit: "EV", digits: 2, better: "near zero" }))).toBe("+0.31 EV");
    expect(figure(-0.31, make({ unit: "EV", digits: 2, better: "near zero" }))).toBe("\u22120.31 EV");
    expect(figure(0.325, make({ unit: "%", digits: 1 }))).toBe("32.5 %");
  });

  it("never round something to nothing", () => {
    expect(figure(0.00004, make({}))).toBe("4.0e-5");
    expect(figure(0, make({}))).toBe("0.000");
  });

  it("say what null stands for", () => {
    expect(figure(null, make({ better: "higher" }))).toBe("identical");
    expect(figure(null, make({}))).toBe("–");
    expect(figure(undefined, make({ better: "higher" }))).toBe("–");
  });

  it("are not known where pixels are not finite: nothing is identical there", () => {
    const figures = makeFigures(0, { metrics: { psnr: null, rmse: 0 } });
    const statistics = { psnr: make({ unit: "dB", better: "higher" }) };
    expect(figureIn(figures, "psnr", statistics)).toBe("identical");
    expect(figureIn({ ...figures, nonFinite: 1 }, "psnr", statistics)).toBe("–");
    expect(figureIn(null, "psnr", statistics)).toBe("–");
  });

  it("have a sign where they are changes, and none at zero", () => {
    expect(change(0.02, make({}))).toBe("+0.020");
    expect(change(-0.02, make({ unit: "%", digits: 1 }))).toBe("\u22122.0 %");
    expect(signed(-0.0001, 2)).toBe("0.00");
    expect(fixed(NaN, 2)).toBe("–");
  });

  it("read as counts and times", () => {
    expect(count(1234567)).toBe("1,234,567");
    expect(duration(12345)).toBe("12.3 s");
    expect(duration(450.4)).toBe("450 ms");
    expect(duration(null)).toBe("–");
  });
});
