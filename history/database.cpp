#include "history/database.h"

#include <cmath>
#include <utility>

#include <sqlite3.h>

#include "base/error.h"

namespace parity::history {

Statement::Statement(const Database& database, std::string_view sql) : m_database(&database) {
  if (sqlite3_prepare_v3(database.m_handle, sql.data(), static_cast<int>(sql.size()), SQLITE_PREPARE_PERSISTENT,
                         &m_statement, nullptr) != SQLITE_OK)
    database.fail();
}

Statement::~Statement() { sqlite3_finalize(m_statement); }

Statement::Statement(Statement&& other) noexcept
    : m_database(other.m_database), m_statement(std::exchange(other.m_statement, nullptr)), m_isFresh(other.m_isFresh) {
}

bool Statement::step() {
  const int result = sqlite3_step(m_statement);
  if (result == SQLITE_ROW) {
    m_isFresh = false;
    return true;
  }
  if (result != SQLITE_DONE) {
    try {
      m_database->fail();
    } catch (...) {
      sqlite3_reset(m_statement);
      throw;
    }
  }
  sqlite3_reset(m_statement);
  m_isFresh = true;
  return false;
}

void Statement::bindOne(int at, std::int64_t value) {
  if (!m_isFresh) sqlite3_reset(m_statement), m_isFresh = true;
  sqlite3_bind_int64(m_statement, at, value);
}
void Statement::bindOne(int at, double value) {
  if (!m_isFresh) sqlite3_reset(m_statement), m_isFresh = true;
  if (std::isnan(value))
    sqlite3_bind_null(m_statement, at);
  else
    sqlite3_bind_double(m_statement, at, value);
}
void Statement::bindOne(int at, std::string_view value) {
  if (!m_isFresh) sqlite3_reset(m_statement), m_isFresh = true;
  sqlite3_bind_text64(m_statement, at, value.data() ? value.data() : "", value.size(), SQLITE_TRANSIENT,
                      SQLITE_UTF8); // NOLINT: SQLite's cast
}
void Statement::bindOne(int at, const std::optional<std::int64_t>& value) {
  if (value) return bindOne(at, *value);
  if (!m_isFresh) sqlite3_reset(m_statement), m_isFresh = true;
  sqlite3_bind_null(m_statement, at);
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(m_statement, column); }
double Statement::real(int column) const {
  return isNull(column) ? std::nan("") : sqlite3_column_double(m_statement, column);
}
std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(m_statement, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(m_statement, column))) : std::string();
}
bool Statement::isNull(int column) const { return sqlite3_column_type(m_statement, column) == SQLITE_NULL; }

Database::Database(const std::filesystem::path& file, Access access) : m_file(file) {
  const int flags = access == Access::write ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
  constexpr int kPatienceMs = 10'000; // of a reader while somebody commits
  if (sqlite3_open_v2(file.c_str(), &m_handle, flags | SQLITE_OPEN_NOMUTEX, nullptr) != SQLITE_OK) {
    const std::string reason = m_handle ? sqlite3_errmsg(m_handle) : "out of memory";
    sqlite3_close_v2(std::exchange(m_handle, nullptr));
    throw base::fileError(file.string(), "cannot be opened", reason);
  }
  try {
    sqlite3_busy_timeout(m_handle, kPatienceMs);
    if (access == Access::write) execute("PRAGMA journal_mode=TRUNCATE");
    execute("PRAGMA temp_store=MEMORY; PRAGMA cache_size=-32000");
  } catch (...) {
    sqlite3_close_v2(std::exchange(m_handle, nullptr));
    throw;
  }
}

Database::~Database() { sqlite3_close_v2(m_handle); }

Database::Database(Database&& other) noexcept
    : m_file(std::move(other.m_file)), m_handle(std::exchange(other.m_handle, nullptr)) {}

void Database::execute(const std::string& sql) const {
  if (sqlite3_exec(m_handle, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

std::int64_t Database::lastId() const { return sqlite3_last_insert_rowid(m_handle); }

std::optional<std::int64_t> Database::number(std::string_view sql) const {
  Statement statement = prepare(sql);
  return statement.step() && !statement.isNull(0) ? std::optional(statement.integer(0)) : std::nullopt;
}

void Database::fail() const {
  const int code = sqlite3_errcode(m_handle) & 0xff;
  const std::string words = sqlite3_errmsg(m_handle);
  switch (code) {
  case SQLITE_NOTADB:
  case SQLITE_CORRUPT:
    throw base::fileError(m_file.string(), "", "is damaged; 'parity history rebuild' makes it again from the runs");
  case SQLITE_FULL:
    throw base::fileError(m_file.string(), "cannot be written",
                          "no space is left; the runs are kept, and the next command brings the index up to date");
  case SQLITE_BUSY:
    throw base::Error(base::ExitCode::incomplete, m_file.string(), "", "another process writes it; try again");
  default:
    throw base::fileError(m_file.string(), "", words);
  }
}

Transaction::~Transaction() {
  if (!m_isOpen) return;
  try {
    m_database.execute("ROLLBACK");
  } catch (const base::Error&) { // SQLite has rolled back by itself
  }
}

void Transaction::commit() {
  m_database.execute("COMMIT");
  m_isOpen = false;
}

} // namespace parity::history
