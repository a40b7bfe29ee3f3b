#include "report/term_words.h"

#include <algorithm>

#include <fmt/format.h>

namespace parity::report {

std::string termWithWords(const std::string& term) {
  const auto found = std::ranges::find(kTermWords, term, &TermWords::term);
  return found == kTermWords.end() ? term : fmt::format("{} ({})", term, found->words);
}

} // namespace parity::report
