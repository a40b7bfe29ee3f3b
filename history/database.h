// SQLite: a database and its statements. Errors are base::Error (exit 4), in words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace parity::history {

class Database;

// A statement that is run again and again: bind all, then step until it returns false, which resets it.
class Statement {
public:
  Statement(const Database& database, std::string_view sql);
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  // In the order of the '?'. NaN is NULL, which a figure that is no number is; so is an empty optional.
  template <typename... Values> Statement& bind(const Values&... values) {
    int at = 0;
    (bindOne(++at, values), ...);
    return *this;
  }
  bool step();
  template <typename... Values> void run(const Values&... values) {
    bind(values...);
    while (step()) {
    }
  }

  // Of the row that step() has come to, from 0.
  std::int64_t integer(int column) const; // 0 for NULL
  double real(int column) const;          // NaN for NULL
  std::string text(int column) const;     // empty for NULL
  bool isNull(int column) const;

private:
  void bindOne(int at, std::int64_t value);
  void bindOne(int at, int value) { bindOne(at, static_cast<std::int64_t>(value)); }
  void bindOne(int at, bool value) { bindOne(at, static_cast<std::int64_t>(value)); }
  void bindOne(int at, std::size_t value) { bindOne(at, static_cast<std::int64_t>(value)); }
  void bindOne(int at, double value);
  void bindOne(int at, std::string_view value);
  void bindOne(int at, const std::string& value) { bindOne(at, std::string_view(value)); }
  void bindOne(int at, const char* value) { bindOne(at, std::string_view(value)); }
  void bindOne(int at, const std::optional<std::int64_t>& value);

  const Database* m_database;
  sqlite3_stmt* m_statement = nullptr;
  bool m_isFresh = true; // reset before the next bind
};

enum class Access { read, write };

class Database {
public:
  // Of the file, which `write` makes where it is not there. With journal_mode=TRUNCATE: a write-ahead log is damaged on
  // network file systems. Throws Error.
  Database(const std::filesystem::path& file, Access access);
  ~Database();
  Database(Database&& other) noexcept;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql) const; // several statements
  Statement prepare(std::string_view sql) const { return {*this, sql}; }
  std::int64_t lastId() const;                                    // of the row that was inserted last
  std::optional<std::int64_t> number(std::string_view sql) const; // the first column of the first row; nothing: no row
  const std::filesystem::path& file() const { return m_file; }
  [[noreturn]] void fail() const; // with what went wrong last

private:
  friend class Statement;
  std::filesystem::path m_file;
  sqlite3* m_handle = nullptr;
};

// Rolled back unless it is committed.
class Transaction {
public:
  explicit Transaction(const Database& database) : m_database(database) { m_database.execute("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

private:
  const Database& m_database;
  bool m_isOpen = true;
};

} // namespace parity::history
