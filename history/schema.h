// The tables of the index. It is made from the run files alone, and may be removed at any time.
#pragma once

#include "history/database.h"

namespace parity::history {

// The version of the tables: an index of another one is made again.
inline constexpr int kIndexSchema = 3;

// Makes the tables in an empty database.
void createTables(const Database& database);

// 0: no tables yet.
int schemaOf(const Database& database);

} // namespace parity::history
