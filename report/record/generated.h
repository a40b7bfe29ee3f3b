// The files that are made from the description of the report and committed, so that those who read reports have them.
// build/describe_report makes them again; a test fails where they are old.
#pragma once

#include <string>

namespace parity::report {

// report/report.schema.json: of report.json, by JSON Schema (draft 2020-12).
std::string reportSchema();
// report/dashboard/src/data/types.ts: of report.json and run.json.
std::string reportTypes();

} // namespace parity::report
