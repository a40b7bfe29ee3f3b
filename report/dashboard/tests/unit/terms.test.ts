import { describe, expect, it } from "vitest";

import { describeTerm, effectOf, termBiasEv } from "../../src/item/term_words";

describe("a term's light in words", () => {
  it("is how many EV mobile's is off", () => {
    expect(termBiasEv({ term: "", reference: 0.4, test: 0.2 })).toBe(-1);
    expect(describeTerm({ term: "", reference: 0.4, test: 0.2 }, "mobile")).toBe("mobile 1.00 EV darker");
    expect(describeTerm({ term: "", reference: 0.2, test: 0.4 }, "mobile")).toBe("mobile 1.00 EV brighter");
    expect(describeTerm({ term: "", reference: 0.4, test: 0.4 }, "mobile")).toBe("equal");
  });

  it("says where one path has none, or its light is not known", () => {
    expect(describeTerm({ term: "", reference: 0, test: 0 }, "mobile")).toBe("black in both");
    expect(describeTerm({ term: "", reference: 0.4, test: 0 }, "mobile")).toBe("mobile has none");
    expect(describeTerm({ term: "", reference: null, test: 0.4 }, "mobile")).toBe("only mobile has it");
    expect(termBiasEv({ term: "", reference: 0, test: 0.4 })).toBeNull();
  });
});

describe("what a swap does", () => {
  it("helps, harms, or changes next to nothing", () => {
    expect(effectOf(0.1, 0.2)).toBe("better");
    expect(effectOf(0.3, 0.2)).toBe("worse");
    expect(effectOf(0.2005, 0.2)).toBe("same");
    expect(effectOf(null, 0.2)).toBe("same");
  });
});
