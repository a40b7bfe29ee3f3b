// As evaluate.glsl, for baked light: lightmaps, distance-field shadows, captures.

// The same scale and add for all channels of a half.
FN LightmapScales lightmapScalesAt(Inputs i, int at) {
  LightmapScales s;
  s.Scale0 = real32x3(i.x[at], i.x[at], i.x[at]);
  s.Add0 = real32x3(i.x[at + 1], i.x[at + 1], i.x[at + 1]);
  s.Scale1 = real32x3(i.x[at + 2], i.x[at + 2], i.x[at + 2]);
  s.Scale1W = R32(0.0);
  s.Add1 = real32x3(i.x[at + 3], i.x[at + 3], i.x[at + 3]);
  s.Add1W = R32(0.282094791773878143);
  return s;
}

FN Outputs outputs4(real4 a) {
  Outputs o = outputs3(real3(a.x, a.y, a.z));
  o.y[3] = real32(a.w);
  return o;
}

FN Outputs evaluateBaked(int function, Inputs i) {
  real32x3 u = real32x3At(i, 0), v = real32x3At(i, 3), w = real32x3At(i, 6);
  if (function == kFnGetLightMapColorLQ)
    return outputs4(GetLightMapColorLQ(real3At(i, 0), real4(real1At(i, 3), real1At(i, 4), real1At(i, 5), R(0.0)),
                                       lightmapScalesAt(i, 9), w));
  if (function == kFnEncodeLightmapLogRgb) return outputs33(encodeLightmapLogRgb(u), real32x3(R32(0.0), R32(0.0), R32(0.0)));
  if (function == kFnEncodeLightmapSh) {
    LightmapSh SH = encodeLightmapSh(i.x[6], u);
    return outputs33(real32x3(SH.x, SH.y, SH.z), real32x3(SH.w, lightmapDirectionality(SH, v), flatNormalScale(SH, v)));
  }
  if (function == kFnLightmapRoundTrip) {
    LightmapScales s;
    s.Scale0 = real32x3(R32(1.0), R32(1.0), R32(1.0));
    s.Add0 = real32x3(R32(0.0), R32(0.0), R32(0.0));
    s.Scale1 = s.Scale0;
    s.Scale1W = R32(1.0);
    s.Add1 = s.Add0;
    s.Add1W = R32(0.0);
    return outputs4(GetLightMapColorLQ(narrow(encodeLightmapLogRgb(u)), real4(R(0.0), R(0.0), R(0.0), R(1.0)), s, u));
  }
  if (function == kFnDistanceFieldShadow) return outputs1(distanceFieldShadow(real1At(i, 0), i.x[1]));
  if (function == kFnEncodeLightmapDirection)
    return outputs33(encodeLightmapDirection(i.x[3], u), real32x3(R32(0.0), R32(0.0), R32(0.0)));
  if (function == kFnDirectionalLightmapRatio)
    return outputs33(real32x3(nonlinearIrradiance(u, v), directionalLightmapRatio(u, v, w), R32(0.0)),
                     real32x3(R32(0.0), R32(0.0), R32(0.0)));
  if (function == kFnBoxParallax)
    return outputs33(boxParallax(u, v, w, real32x3At(i, 9), real32x3At(i, 12)), real32x3(R32(0.0), R32(0.0), R32(0.0)));
  // kFnCaptureWeight
  return outputs33(real32x3(captureWeight(i.x[0], i.x[1]), R32(0.0), R32(0.0)), real32x3(R32(0.0), R32(0.0), R32(0.0)));
}
