// Makes the files again that come from the description of the report (report/record/generated.h).
//   describe_report FOLDER: of the sources
#include <filesystem>
#include <iostream>

#include "base/error.h"
#include "base/file.h"
#include "report/record/generated.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "describe_report FOLDER\n";
    return 64;
  }
  const std::filesystem::path folder = std::filesystem::path(argv[1]) / "report";
  try {
    parity::base::writeText(folder / "report.schema.json", parity::report::reportSchema());
    parity::base::writeText(folder / "dashboard/src/data/types.ts", parity::report::reportTypes());
  } catch (const parity::base::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
