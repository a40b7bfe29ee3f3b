// The terms that a path's colour is the sum of (docs/design.md 6a), with the ids of shading/terms.h.
#ifndef PARITY_SHADING_TERMS
#define PARITY_SHADING_TERMS

const int kTermSunDiffuse = 0;
const int kTermSunSpecular = 1;
const int kTermLocalDiffuse = 2;
const int kTermLocalSpecular = 3;
const int kTermLightmap = 4;
const int kTermSkyDiffuse = 5;
const int kTermSkySpecular = 6;
const int kTermEmissive = 7;
const int kTermFog = 8;
const int kTermCoatSpecular = 9;
const int kTermSheen = 10;
const int kTermTransmission = 11;
#ifdef PARITY_LOBES
const int kTermCount = 12;
#else
const int kTermCount = 9; // no material of the scene has lobes beside the base's own
#endif

#endif
