// A validator for the part of JSON Schema (draft 2020-12) that report/report.schema.json and
// integrations/contract.schema.json use. A keyword that it does
// not know is a finding, so the schema cannot grow past what is checked.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace parity::report {

// What is wrong, one line each, "/path: reason"; empty where the document is valid.
std::vector<std::string> validate(const nlohmann::json& schema, const nlohmann::json& document);

} // namespace parity::report
