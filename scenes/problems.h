// What is wrong with a file, gathered so that all of it is told at once.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "base/error.h"

namespace parity::scenes {

// Gathers problems of one file. Any thread may add; the order in which they are told is that of adding.
class Problems {
public:
  // As many are told in words; the others are counted.
  static constexpr std::size_t kMaxTold = 20;

  // label: the file as the user wrote it.
  explicit Problems(std::string label) : m_label(std::move(label)) {}

  // place: a JSON pointer; reason: what is wrong and what was expected. The same line is kept once.
  void add(const std::string& place, const std::string& reason);
  void add(const base::Error& error);

  // Runs `body` and keeps the Error (exit 4) that it throws, other exceptions pass. True where it ran to its end.
  template <typename Body> bool attempt(const Body& body) {
    try {
      body();
      return true;
    } catch (const base::Error& error) {
      if (error.code() != base::ExitCode::failed) throw;
      add(error);
      return false;
    }
  }

  bool isEmpty() const;
  // Throws the one Error, or an ErrorList of all; returns where there is none.
  void throwIfAny() const;

private:
  std::string m_label;
  mutable std::mutex m_mutex;
  std::vector<base::Error> m_errors;
  std::size_t m_more = 0;
};

} // namespace parity::scenes
