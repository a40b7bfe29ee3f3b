#include "cli/input_list.h"

#include <algorithm>
#include <sstream>

#include "base/error.h"
#include "base/standard_input.h"

namespace parity::cli {

namespace {

std::vector<std::string> readList(const std::string& what) {
  constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
  constexpr const char* kSpaces = " \t\r";
  std::istringstream lines(base::readStdin(kMaxBytes));
  std::vector<std::string> values;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(kSpaces);
    if (begin == std::string::npos || line[begin] == '#') continue;
    values.push_back(line.substr(begin, line.find_last_not_of(kSpaces) + 1 - begin));
  }
  if (values.empty()) throw base::fileError("stdin", "", "names no " + what);
  return values;
}

} // namespace

std::vector<std::string> withListed(const std::vector<std::string>& values, const std::string& what) {
  if (std::ranges::count(values, "-") > 1)
    throw base::Error(base::ExitCode::usage, "-", "", "standard input is one list; give it once");
  std::vector<std::string> all;
  for (const std::string& value : values) {
    const std::vector<std::string> listed = value == "-" ? readList(what) : std::vector{value};
    all.insert(all.end(), listed.begin(), listed.end());
  }
  return all;
}

} // namespace parity::cli
