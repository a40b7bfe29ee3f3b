// Where a picture lies in its pane: from the shared zoom and pan, which do not know the pane's size, and back.

export interface Size {
  width: number;
  height: number;
}

/** In pixels of the picture. */
export interface Box extends Size {
  x: number;
  y: number;
}

/** zoom 1: the picture fits its pane; pan: what is at the pane's centre, 0..1 of the picture. */
export interface Look {
  zoom: number;
  panX: number;
  panY: number;
}

/** A pixel's corner is at x + scale * its place, in CSS pixels of the pane. */
export interface Placement {
  x: number;
  y: number;
  scale: number;
}

export const kLeastZoom = 0.25;
export const kMostZoom = 64;

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

/** The scale at which the whole picture is just seen; 1 while the pane has no size. */
export function fitScale(pane: Size, picture: Size): number {
  const scale = Math.min(pane.width / picture.width, pane.height / picture.height);
  return Number.isFinite(scale) && scale > 0 ? scale : 1;
}

export function place(look: Look, pane: Size, picture: Size): Placement {
  const scale = fitScale(pane, picture) * look.zoom;
  return {
    x: pane.width / 2 - look.panX * picture.width * scale,
    y: pane.height / 2 - look.panY * picture.height * scale,
    scale,
  };
}

/** Within the zoom's range, and with some of the picture at the pane's centre. */
export function clampLook(look: Look): Look {
  return {
    zoom: clamp(look.zoom, kLeastZoom, kMostZoom),
    panX: clamp(look.panX, 0, 1),
    panY: clamp(look.panY, 0, 1),
  };
}

/** The inverse of place, clamped. */
export function lookOf(placement: Placement, pane: Size, picture: Size): Look {
  return clampLook({
    zoom: placement.scale / fitScale(pane, picture),
    panX: (pane.width / 2 - placement.x) / (picture.width * placement.scale),
    panY: (pane.height / 2 - placement.y) / (picture.height * placement.scale),
  });
}

/** What fits that box into the pane, with a rim as the report's crops have; never smaller than the whole picture. */
export function lookAt(box: Box, pane: Size, picture: Size): Look {
  const rim = Math.max(8, Math.max(box.width, box.height) / 16);
  const scale = fitScale(pane, { width: box.width + 2 * rim, height: box.height + 2 * rim });
  return clampLook({
    zoom: Math.max(scale / fitScale(pane, picture), 1),
    panX: (box.x + box.width / 2) / picture.width,
    panY: (box.y + box.height / 2) / picture.height,
  });
}

/** What makes the picture as wide as the pane. Never just 1: at its usual look a pane fits the chosen material. */
export function lookAtWidth(pane: Size, picture: Size): Look {
  const zoom = pane.width / picture.width / fitScale(pane, picture);
  return clampLook({ zoom: zoom > 1.001 ? zoom : 0.999, panX: 0.5, panY: 0.5 });
}

/** Moved by shares of the pane: 0.5 is half of what it shows. */
export function movedBy(look: Look, shareX: number, shareY: number, pane: Size, picture: Size): Look {
  const scale = fitScale(pane, picture) * look.zoom;
  return clampLook({
    zoom: look.zoom,
    panX: look.panX + (shareX * pane.width) / (picture.width * scale),
    panY: look.panY + (shareY * pane.height) / (picture.height * scale),
  });
}

/** The pixel under a point of the pane; null beside the picture. */
export function pixelAt(placement: Placement, x: number, y: number, picture: Size): { x: number; y: number } | null {
  const pixel = {
    x: Math.floor((x - placement.x) / placement.scale),
    y: Math.floor((y - placement.y) / placement.scale),
  };
  const isInside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < picture.width && pixel.y < picture.height;
  return isInside ? pixel : null;
}

/** The smallest box of the pixels that have this value; null for none. */
export function boundsOf(values: Uint16Array, width: number, wanted: number): Box | null {
  let left = width;
  let right = -1;
  let top = -1;
  let bottom = -1;
  for (let i = 0, y = 0; i < values.length; ++y)
    for (let x = 0; x < width; ++x, ++i) {
      if (values[i] !== wanted) continue;
      if (top < 0) top = y;
      bottom = y;
      if (x < left) left = x;
      if (x > right) right = x;
    }
  return top < 0 ? null : { x: left, y: top, width: right - left + 1, height: bottom - top + 1 };
}
