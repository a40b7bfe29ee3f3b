// What materials and whole images have in common: how they were judged.
import type { View } from "./types";

export type Judged = View["whole"];
