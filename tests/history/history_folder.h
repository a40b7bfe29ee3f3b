// A history in a folder of its own, and all that its index says, as text.
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "base/temp_folder.h"
#include "history/store.h"

namespace parity::tests {

// Every row of every table of an index.
std::string dumpOf(const std::filesystem::path& index);

class HistoryTest : public testing::Test {
protected:
  std::filesystem::path folder() const { return m_folder / "history"; }
  std::filesystem::path index() const { return folder() / history::kIndexFile; }
  history::Store writer() const { return {folder(), history::Store::For::writing}; }
  history::Store reader() const { return {folder(), history::Store::For::reading}; }
  // The index made anew is what it was.
  void expectSameWhenRebuilt(history::Store& store) const;
  const base::TempFolder m_folder;
};

} // namespace parity::tests
