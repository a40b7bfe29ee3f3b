// Parts of report.json that several of its objects hold: texts, figures, the ground truth, dropped lights.
#pragma once

#include <string>
#include <vector>

#include "compare/dropped_lights.h"
#include "compare/encoding.h"
#include "compare/figures.h"
#include "compare/json_writer.h"
#include "compare/truth.h"

namespace parity::compare {

void writeTexts(JsonWriter& json, const std::vector<std::string>& texts);

// null where there is no pixel.
void writeFigures(JsonWriter& json, const Figures& figures);

// The stage's target and figures.
void writeEncoding(JsonWriter& json, const Encoding& encoding);
void writeTextures(JsonWriter& json, const TextureCompression& textures);
void writeTruth(JsonWriter& json, const Truth& truth);

void writeDroppedLights(JsonWriter& json, const DroppedLights& dropped);

} // namespace parity::compare
