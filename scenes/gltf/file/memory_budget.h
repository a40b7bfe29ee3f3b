// How much memory one scene may take, counted before it is taken.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::scenes {

class MemoryBudget {
public:
  // label: the file, for messages.
  MemoryBudget(std::string label, std::size_t maxBytes) : m_label(std::move(label)), m_maxBytes(maxBytes) {}

  // Counts bytes that are about to be taken, by any thread. Throws Error (exit 4) with the place where they are too
  // many.
  void take(std::size_t bytes, const std::string& place) {
    const std::size_t before = m_taken.fetch_add(bytes);
    if (bytes <= m_maxBytes && before <= m_maxBytes - bytes) return;
    m_taken -= bytes;
    throw base::fileError(
        m_label, place,
        fmt::format("needs {} MiB in addition to {} MiB; the limit for a scene is {} MiB (--max-memory)",
                    (bytes >> 20) + 1, before >> 20, m_maxBytes >> 20));
  }
  // Counts bytes that are about to be decoded, which may be the same ones again and again: what a small file can make
  // us do is bounded, too, by twice as much. Throws Error (exit 4).
  void work(std::size_t bytes, const std::string& place) {
    if ((m_worked.fetch_add(bytes) + bytes) / 2 <= m_maxBytes) return;
    throw base::fileError(
        m_label, place,
        fmt::format("more than {} MiB of accessors need decoding, because many are used several times "
                    "(--max-memory)",
                    m_maxBytes >> 19));
  }
  // Of those taken, bytes that have been released.
  void release(std::size_t bytes) { m_taken -= bytes; }
  std::size_t taken() const { return m_taken; }

private:
  std::string m_label;
  std::size_t m_maxBytes;
  std::atomic<std::size_t> m_taken = 0, m_worked = 0;
};

// Bytes of a budget that are taken as long as this lives.
class MemoryCharge {
public:
  MemoryCharge(MemoryBudget& budget, std::size_t bytes, const std::string& place) : m_budget(budget), m_bytes(bytes) {
    budget.take(bytes, place);
  }
  ~MemoryCharge() { m_budget.release(m_bytes); }
  MemoryCharge(const MemoryCharge&) = delete;
  MemoryCharge& operator=(const MemoryCharge&) = delete;

private:
  MemoryBudget& m_budget;
  std::size_t m_bytes;
};

} // namespace parity::scenes
