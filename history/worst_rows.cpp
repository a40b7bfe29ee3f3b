#include "history/worst_rows.h"

#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "history/subject.h"

namespace parity::history {

namespace {

struct Span {
  std::int64_t subject = 0, last = 0; // last: 0: it lasts
  double value = 0;
};

// The values that hold in a run, while runs are gone through in their order.
class Holding {
public:
  void add(const Span& span) {
    m_values.emplace(span.value, span.subject);
    m_sum += span.value;
  }
  void remove(const Span& span) {
    m_values.erase({span.value, span.subject});
    m_sum -= span.value;
  }
  bool isEmpty() const { return m_values.empty(); }
  std::pair<double, std::int64_t> worst() const { return *m_values.rbegin(); }
  double mean() const { return m_sum / static_cast<double>(m_values.size()); }

private:
  std::set<std::pair<double, std::int64_t>> m_values; // and subjects, of which each has one
  double m_sum = 0;
};

std::string pathOf(const Database& index, std::int64_t subject) {
  Statement find = index.prepare("SELECT scene, view, material, ordinal FROM subject WHERE id=?");
  if (!find.bind(subject).step()) return {};
  return SubjectRef{subject, 0, {}, find.text(0), find.text(1), find.text(2), static_cast<int>(find.integer(3))}.path();
}

} // namespace

std::map<std::int64_t, WorstRow> worstRows(const Database& index, const std::string& suite, const std::string& branch,
                                           const std::string& metric) {
  std::map<std::int64_t, WorstRow> worst;
  std::unordered_map<std::int64_t, std::string> paths;
  Statement lanes = index.prepare("SELECT id FROM lane WHERE suite=? AND branch=?");
  Statement values = index.prepare(
      "SELECT first_run, last_run, subject, v FROM value JOIN subject ON subject.id=subject WHERE lane=? AND "
      "metric=(SELECT id FROM metric WHERE name=?) AND v IS NOT NULL AND ordinal>=0 ORDER BY first_run");
  Statement runs = index.prepare("SELECT id FROM run WHERE lane=? ORDER BY id");
  lanes.bind(suite, branch);
  while (lanes.step()) {
    std::multimap<std::int64_t, Span> begins, ends; // by run
    values.bind(lanes.integer(0), metric);
    while (values.step()) {
      const Span span{values.integer(2), values.integer(1), values.real(3)};
      begins.emplace(values.integer(0), span);
      if (span.last != 0) ends.emplace(span.last, span);
    }
    Holding holding;
    auto begin = begins.begin(), end = ends.begin();
    runs.bind(lanes.integer(0));
    while (runs.step()) {
      const std::int64_t run = runs.integer(0);
      for (; end != ends.end() && end->first < run; ++end) holding.remove(end->second);
      for (; begin != begins.end() && begin->first <= run; ++begin) holding.add(begin->second);
      if (holding.isEmpty()) continue;
      const auto [value, subject] = holding.worst();
      std::string& path = paths[subject];
      if (path.empty()) path = pathOf(index, subject);
      worst[run] = {path, value, holding.mean()};
    }
  }
  return worst;
}

} // namespace parity::history
