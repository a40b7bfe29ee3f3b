// What report.json says of a material; parts of it also of whole images.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/json_writer.h"
#include "compare/report.h"

namespace parity::compare {

void writeChecks(JsonWriter& json, const std::vector<CheckResult>& checks);
void writeImages(JsonWriter& json, const ImageSet& images);
void writeRule(JsonWriter& json, const AppliedRule& rule);
// null where there is none.
void writeBaseline(JsonWriter& json, const std::optional<BaselineChange>& baseline);
// The bias in words; empty without pixels.
std::string describeBiasOf(const Figures& figures);

void writeMaterial(JsonWriter& json, const MaterialResult& material);

} // namespace parity::compare
