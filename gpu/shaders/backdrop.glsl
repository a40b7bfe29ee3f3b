// Reads of the backdrop (gpu/surface/backdrop.h): what is rendered behind surfaces that light passes through.

// A texel about a place of the world, the mean over `width` pixels; nothing outside the picture.
vec4 backdropTexel(vec3 place, float width, float layer) {
  vec4 p = vec4(place, 1.0);
  float w = dot(view.picture[2], p);
  vec2 uv = vec2(dot(view.picture[0], p), dot(view.picture[1], p)) / w;
  bool isSeen = w > 0.0 && uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0;
  vec4 texel = textureLod(backdrop, vec3(uv, layer), log2(max(width, 1.0)));
  return isSeen ? texel : vec4(0.0);
}

// Widths over which the depth behind is sought, in pixels: fine, and coarse where there is nothing near.
const float kNearWidth = 2.0, kFarWidth = 32.0;

// What a ray from `origin` meets behind, seen by the eye: radiance times coverage, and coverage. The ray is followed to the
// depth that is read where it was thought to end. spread: side of the lobe's square at unit distance. direction: unit.
vec4 seenBehind(vec3 origin, vec3 direction, float spread) {
  float along = dot(view.forward.xyz, direction), begin = dot(view.forward.xyz, origin) - view.forward.w;
  if (along < 0.01) return vec4(0.0);
  float t = 0.0;
  for (int k = 0; k < 4; ++k) {
    vec3 place = origin + t * direction;
    vec2 near = vec2(backdropTexel(place, kNearWidth, 1.0).x, backdropTexel(place, kNearWidth, 0.0).w);
    if (near.y < 0.01) near = vec2(backdropTexel(place, kFarWidth, 1.0).x, backdropTexel(place, kFarWidth, 0.0).w);
    if (near.y < 0.001) break;
    t = max(near.x / near.y - begin, 0.0) / along;
  }
  vec3 place = origin + t * direction;
  float w = dot(view.picture[2], vec4(place, 1.0));
  return backdropTexel(place, spread * t * view.pictureScale.x / max(w, 1e-6), 0.0);
}
