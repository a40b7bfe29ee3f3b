// What is wrong with a file, gathered so that all of it is told at once.
#include "scenes/problems.h"

#include <algorithm>
#include <string_view>

namespace parity::scenes {

void Problems::add(const std::string& place, const std::string& reason) {
  if (const std::scoped_lock lock(m_mutex); m_errors.size() == kMaxTold) { // a million of them are only counted
    ++m_more;
    return;
  }
  add(base::fileError(m_label, place, reason));
}

void Problems::add(const base::Error& error) {
  const std::scoped_lock lock(m_mutex);
  const auto isSame = [&](const base::Error& known) { return std::string_view(known.what()) == error.what(); };
  if (std::any_of(m_errors.begin(), m_errors.end(), isSame)) return;
  if (m_errors.size() < kMaxTold)
    m_errors.push_back(error);
  else
    ++m_more;
}

bool Problems::isEmpty() const {
  const std::scoped_lock lock(m_mutex);
  return m_errors.empty();
}

void Problems::throwIfAny() const {
  const std::scoped_lock lock(m_mutex);
  if (m_errors.empty()) return;
  if (m_errors.size() == 1) throw base::Error(m_errors.front());
  throw base::ErrorList(m_errors, m_more);
}

} // namespace parity::scenes
