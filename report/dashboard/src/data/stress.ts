// stress.json of `parity stress` (study/stress/report_json.cpp).

export type Finding = Record<"subject" | "place" | "fault" | "example" | "reproduce" | "region" | "reason", string> & { expected: boolean; count: number };
export interface Column {
  side: "cpu" | "device";
  precision: "fp64" | "fp32" | "fp16";
  skipped: string | null; // why; then there is nothing of the rest
  rows?: number;
  outside?: number;
  outsideNotFinite?: number;
  maxError?: number | null; // null: infinite
  p999Error?: number | null;
  maxUlps?: number | null;
  worstError?: { at: string } | null;
  faults?: Record<string, { rows: number; unexpected: number }>;
  map?: (number | null)[]; // the greatest error a cell, row by row of roughness; null: no row
}
export type StressFunction = { name: string; mapAxes?: { roughness: string; cosine: string }; columns: Column[] };
export type Stress = Record<"version" | "device", string> & Record<"failure" | "fp16Skipped", string | null> &
  Record<"points" | "devicePoints" | "unexpected" | "expected", number> & { findings: Finding[]; functions: StressFunction[]; scenes: { name: string; wants: string }[] };
export type StressTimes = Record<"functionsMs" | "rendersMs", number>;

/** A cause that is known, whatever the precisions and sides. */
export type Cause = Record<"subject" | "fault" | "region", string> & { findings: Finding[] };

export function causesOf(findings: readonly Finding[]): Cause[] {
  const causes = new Map<string, Cause>();
  for (const finding of findings) {
    if (!finding.expected) continue;
    const { subject, fault, region } = finding;
    const key = JSON.stringify([subject, fault, region]);
    const cause = causes.get(key) ?? { subject, fault, region, findings: [] };
    cause.findings.push(finding);
    causes.set(key, cause);
  }
  return [...causes].sort(([a], [b]) => (a < b ? -1 : 1)).map(([, cause]) => cause);
}
