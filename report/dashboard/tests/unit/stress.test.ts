import { describe, expect, it } from "vitest";

import { causesOf, type Finding } from "../../src/data/stress";
import { colorIndex } from "../../src/study/error_map";

const finding = (subject: string, place: string, expected = true): Finding => ({
  subject, place, expected, fault: "not finite", count: 1, example: "", reproduce: "", region: "r = 0", reason: "divides by 0",
});

describe("what is known", () => {
  it("is one cause for all its sides and precisions, in the order of its subjects; what is new is none of it", () => {
    const causes = causesOf([finding("z", "cpu fp16", false), finding("b", "cpu fp16"), finding("a", "cpu fp16"), finding("b", "device fp16")]);
    expect(causes.map(({ subject, findings }) => [subject, findings.map((each) => each.place)])).toEqual([["a", ["cpu fp16"]], ["b", ["cpu fp16", "device fp16"]]]);
  });
});

describe("a map of errors", () => {
  it("has black for 1e-8 and less, the last colour for 1 and more", () => {
    expect([0, 1e-9, 1e-8, 1e-4, 1, 50].map(colorIndex)).toEqual([0, 0, 0, 128, 255, 255]);
  });
});
