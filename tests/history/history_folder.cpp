#include "history/history_folder.h"

#include <stdexcept>

#include <sqlite3.h>

namespace parity::tests {

std::string dumpOf(const std::filesystem::path& index) {
  sqlite3* database = nullptr;
  if (sqlite3_open_v2(index.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) != SQLITE_OK)
    throw std::runtime_error("no index " + index.string());
  std::string text;
  for (const char* table : {"lane", "run", "subject", "metric", "value", "state", "input", "timing", "event"}) {
    text += std::string(table) + "\n";
    const auto append = [](void* to, int count, char** values, char**) {
      for (int i = 0; i < count; ++i)
        *static_cast<std::string*>(to) += std::string(values[i] ? values[i] : "NULL") + "|";
      *static_cast<std::string*>(to) += "\n";
      return 0;
    };
    char* error = nullptr;
    if (sqlite3_exec(database,
                     (std::string("SELECT * FROM ") + table + " ORDER BY " +
                      (std::string(table) == "metric" ? "1" : "1, 2, 3, 4"))
                         .c_str(),
                     append, &text, &error) != SQLITE_OK)
      throw std::runtime_error(error);
  }
  sqlite3_close(database);
  return text;
}

void HistoryTest::expectSameWhenRebuilt(history::Store& store) const {
  const std::string before = dumpOf(index());
  store.rebuild();
  EXPECT_TRUE(dumpOf(index()) == before) << "the index is another one once it is rebuilt";
}

} // namespace parity::tests
