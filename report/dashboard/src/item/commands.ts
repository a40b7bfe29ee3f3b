// Commands to copy: the same comparison again, and how to accept what it found.
import type { Row } from "../data/rows";
import type { Scene } from "../data/types";

/** A word as a POSIX shell takes it. */
export function shellWord(text: string): string {
  return /^[A-Za-z0-9_@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

/** The words of a command line as a POSIX shell splits them; quotes of both kinds, and backslashes. */
export function splitWords(line: string): string[] {
  const words: string[] = [];
  let word = "";
  let inWord = false;
  let quote = "";
  for (let i = 0; i < line.length; ++i) {
    const c = line.charAt(i);
    if (quote === "'" ? c !== "'" : quote === '"' && c !== '"' && c !== "\\") word += c;
    else if (c === quote) quote = "";
    else if (quote === "" && (c === "'" || c === '"')) [quote, inWord] = [c, true];
    else if (c === "\\" && i + 1 < line.length) [word, inWord] = [word + line.charAt(++i), true];
    else if (quote === "" && /\s/.test(c)) {
      if (inWord) words.push(word);
      [word, inWord] = ["", false];
    } else [word, inWord] = [word + c, true];
  }
  if (inWord) words.push(word);
  return words;
}

/** A glob (base/text/glob.h) that matches this very name: what it would take for a wildcard becomes "?". */
export function globOf(name: string): string {
  return name.replace(/[*?[\]\\]/g, "?");
}

const kLongest = 400;
// Options that only a whole report has, or that would hide the table or choose other materials.
const kWithValue = ["-o", "--output", "--json", "--csv", "--bench", "--pixel-data", "--annotate", "--material"];
const kAlone = ["--single-file", "-q", "--quiet"];

/**
 * `parity diff` of the row's scene and material by the report's own options; null where the report's command line does
 * not say which file the scene is (a suite's, another program's, two of one name), or the name is too long to be of use.
 */
export function diffCommand(commandLine: string, scene: Scene, row: Row): string | null {
  const words = splitWords(commandLine);
  const at = words.indexOf("report");
  if (at < 0 || words.includes("--suite") || words.some((word) => word.startsWith("--suite="))) return null;
  const fileOf = (word: string): string => word.split("/").pop() ?? "";
  const sources = words.slice(at + 1).filter((word) => word === scene.source || fileOf(word) === scene.source);
  const source = sources[0];
  if (source === undefined || sources.length > 1) return null;
  const isScene = (word: string): boolean => /\.(gltf|glb)$/i.test(word) || word.startsWith("builtin:");
  // Of several environments only the scene's own.
  const several = words.filter((word) => word === "--env" || word.startsWith("--env=")).length > 1;
  const isOther = (value: string): boolean => several && value !== scene.environment && fileOf(value) !== scene.environment;
  const kept: string[] = [...words.slice(0, at), "diff", source];
  for (let i = at + 1; i < words.length; ++i) {
    const word = words[i] ?? "";
    const previous = words[i - 1] ?? "";
    if (kWithValue.includes(word) || (word === "--env" && isOther(words[i + 1] ?? ""))) ++i;
    else if (word.startsWith("--env=") && isOther(word.slice(6))) continue;
    else if (kAlone.includes(word) || word.startsWith("-o") || kWithValue.some((each) => word.startsWith(each + "="))) continue;
    else if (isScene(word) && previous !== "--env") continue;
    else kept.push(word);
  }
  if (row.kind === "material") kept.push("--material", globOf(row.name));
  const command = kept.map(shellWord).join(" ");
  return command.length > kLongest + commandLine.length ? null : command;
}

/** The ways to accept a report as it is. */
export function acceptCommands(): { what: string; command: string }[] {
  return [
    { what: "Make new limits from the figures of this report:", command: "parity budget suggest report.json -o budgets.toml" },
    { what: "Keep this report as the baseline of later runs:", command: "cp report.json baseline.json && parity report ... --baseline baseline.json" },
  ];
}
