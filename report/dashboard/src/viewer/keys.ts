// What keys do to the comparison; the page's own keys come before these.
import type { ViewerState } from "../data/state";
import { clampLook, lookAtWidth, movedBy, type Look, type Size } from "./transform";

export interface KeyScene {
  state: ViewerState;
  look: Look; // what the panes really show
  pane: Size;
  picture: Size;
  isOnPicture: boolean; // a picture has the focus: arrows move the inspected pixel
}

const kArrows: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
const kStep = 1.25; // of the zoom
const kMove = 0.1; // of the pane
export const kExposureStep = 0.25;
export const kMostExposure = 8;

/** Whether the key belongs to a control: text is typed there, or it moves. */
export function isForControl(event: KeyboardEvent): boolean {
  const target = event.target;
  if (target instanceof HTMLInputElement) {
    if (!["range", "checkbox", "radio"].includes(target.type)) return true;
    return event.key.startsWith("Arrow") || event.key === "Home" || event.key === "End";
  }
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement;
}

function movePixel({ state, look, picture }: KeyScene, [dx, dy]: readonly [number, number]): Partial<ViewerState> {
  const clamp = (value: number, size: number): number => Math.min(Math.max(value, 0), size - 1);
  if (state.pixelX < 0 || state.pixelY < 0)
    return {
      pixelX: clamp(Math.floor(look.panX * picture.width), picture.width),
      pixelY: clamp(Math.floor(look.panY * picture.height), picture.height),
    };
  return { pixelX: clamp(state.pixelX + dx, picture.width), pixelY: clamp(state.pixelY + dy, picture.height) };
}

/** How the exposure changes by a step, in its range. */
export function exposedBy(exposure: number, change: number): number {
  return Math.min(Math.max(exposure + change, -kMostExposure), kMostExposure);
}

/** What a key changes; null: it is none of these. */
export function changeOf(event: KeyboardEvent, scene: KeyScene): Partial<ViewerState> | null {
  const { state, look, pane, picture } = scene;
  const arrow = kArrows[event.key];
  if (arrow !== undefined) {
    if (event.shiftKey) return movedBy(look, kMove * arrow[0], kMove * arrow[1], pane, picture);
    return scene.isOnPicture ? movePixel(scene, arrow) : null;
  }
  switch (event.key.toLowerCase()) {
    case "+":
    case "=":
      return clampLook({ ...look, zoom: look.zoom * kStep });
    case "-":
    case "_":
      return clampLook({ ...look, zoom: look.zoom / kStep });
    case "0":
      return { zoom: 1, panX: 0.5, panY: 0.5, exposure: 0 };
    case "w":
      return lookAtWidth(pane, picture);
    case "s":
      return { mode: state.mode === "side" ? "slider" : "side" };
    case "o":
      return { mode: "onion" };
    case "d":
      return { mode: "difference" };
    case "h":
      return { mode: "flip" };
    case "v":
      return { falseColor: !state.falseColor };
    case "a":
      return { autoRange: !state.autoRange };
    case "[":
      return { exposure: exposedBy(state.exposure, -kExposureStep) };
    case "]":
      return { exposure: exposedBy(state.exposure, kExposureStep) };
    default:
      return null;
  }
}
