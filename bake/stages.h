// Work over many texels that is kept as it is done: by chunks, each in the cache, told of, and ended when asked to.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "bake/light/integrate.h"
#include "base/error.h"
#include "base/hash.h"
#include "base/parallel.h"

namespace parity::bake {

[[noreturn]] inline void throwCancelled(bool isCached) {
  throw base::fileError("bake", "",
                        isCached
                            ? "cancelled; the cache keeps the finished part, and the same command continues from there"
                            : "cancelled");
}

class Stages {
public:
  explicit Stages(const Control& control) : m_control(control) {}

  // out[i] = body(i, rays) for every i, or what the cache holds of it. name: of the stage, unique; what: for people;
  // from and to: its share of the whole work. body: called by any thread; the order does not matter to the result.
  // texels: that one i stands for.
  template <typename T, typename Body> void run(const std::string& name, const std::string& what, double from,
                                                double to, std::span<T> out, const Body& body, std::size_t texels = 1) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t size = std::max<std::size_t>(kChunk / texels, 1),
                      grain = std::max<std::size_t>(kGrain / texels, 1);
    for (std::size_t begin = 0; begin < out.size(); begin += size) {
      tell(what, from + (to - from) * static_cast<double>(begin) / static_cast<double>(out.size()));
      const std::span<T> chunk = out.subspan(begin, std::min(size, out.size() - begin));
      const std::string key = keyOf(name, begin);
      if (recall(key, std::as_writable_bytes(chunk))) continue;
      base::parallelFor(chunk.size(), grain, [&](std::size_t first, std::size_t last) {
        std::uint64_t rays = 0;
        for (std::size_t i = first; i < last && !isCancelled(); ++i) chunk[i] = body(begin + i, rays);
        m_rays += rays;
      });
      if (isCancelled()) throwCancelled(m_control.cache && m_control.cache->enabled());
      if (!key.empty()) m_control.cache->store(key, std::as_bytes(chunk));
    }
    tell(what, to);
  }

  std::uint64_t rays() const { return m_rays; }

private:
  static constexpr std::size_t kChunk = 2048, kGrain = 8;

  bool isCancelled() const { return m_control.isCancelled && m_control.isCancelled(); }
  void tell(const std::string& what, double done) const {
    if (m_control.progress) m_control.progress(what, done);
  }
  std::string keyOf(const std::string& name, std::size_t begin) const {
    if (!m_control.cache || !m_control.cache->enabled()) return {};
    return "bake-" + base::Hasher().add(m_control.key).add(name).addValue(begin).hex();
  }
  bool recall(const std::string& key, std::span<std::byte> bytes) const {
    if (key.empty()) return false;
    const auto found = m_control.cache->find(key);
    if (!found || found->size() != bytes.size()) return false;
    std::memcpy(bytes.data(), found->data(), bytes.size());
    return true;
  }

  const Control& m_control;
  std::atomic<std::uint64_t> m_rays{0};
};

} // namespace parity::bake
