#include "job/run_budgets.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/hash.h"

namespace parity::job {

namespace {

// Whether there are rules of the file, each with limits on regressions alone. The built-in ones stand behind them.
bool limitsOnlyRegressions(const std::vector<compare::BudgetRule>& rules) {
  const auto isOfFile = [](const compare::BudgetRule& rule) { return rule.line > 0; };
  return std::ranges::any_of(rules, isOfFile) && std::ranges::all_of(rules, [&](const compare::BudgetRule& rule) {
           return !isOfFile(rule) || (rule.checks.empty() && !rule.regress.empty());
         });
}

} // namespace

RunBudgets::RunBudgets(std::optional<std::string> ofRun, std::optional<std::string> ofSuite, FrozenFiles frozen)
    : m_ofRun(std::move(ofRun)), m_ofSuite(std::move(ofSuite)), m_frozen(std::move(frozen)) {
  if (const auto& first = m_ofRun ? m_ofRun : m_ofSuite) ofFile(*first);
}

std::optional<std::string> RunBudgets::fileOf(const SceneRequest& request) const {
  return m_ofRun ? m_ofRun : request.budgets ? request.budgets : m_ofSuite;
}

const compare::Budgets& RunBudgets::ofFile(const std::string& file) const {
  const std::lock_guard lock(m_mutex);
  if (const auto found = m_read.find(file); found != m_read.end()) return found->second;
  const auto frozen = m_frozen.find(file);
  const std::string& text =
      m_texts.insert_or_assign(file, frozen == m_frozen.end() ? compare::readBudgetText(file) : frozen->second)
          .first->second;
  return m_read.emplace(file, compare::readBudgets(text, file)).first->second;
}

std::string RunBudgets::digestOf(const std::vector<SceneRequest>& requests) const {
  std::set<std::string> known;
  base::Hasher hasher;
  for (const SceneRequest& request : requests)
    if (const std::optional<std::string> file = fileOf(request); file && known.insert(*file).second) {
      try {
        ofFile(*file);
      } catch (const base::Error&) { // the error of the scenes that it would judge
      }
      const std::lock_guard lock(m_mutex);
      const auto text = m_texts.find(*file);
      hasher.add(text == m_texts.end() ? "not readable" : text->second);
    }
  return known.empty() ? std::string() : hasher.hex();
}

void RunBudgets::requireLevels() const {
  const auto& first = m_ofRun ? m_ofRun : m_ofSuite;
  if (!first) return;
  const compare::Budgets& budgets = ofFile(*first);
  if (limitsOnlyRegressions(budgets.materials) || limitsOnlyRegressions(budgets.wholes))
    throw base::fileError(*first, "",
                          "limits only regressions, so the run needs --baseline; a run without --budgets makes one");
}

compare::Approvals RunBudgets::approvalsOf(const std::string& file) const {
  const auto frozen = m_frozen.find(file);
  return frozen == m_frozen.end() ? compare::loadApprovals(file) : compare::readApprovals(frozen->second, file);
}

compare::Budgets RunBudgets::of(const SceneRequest& request) const {
  const std::optional<std::string> file = fileOf(request);
  compare::Budgets budgets = file ? ofFile(*file) : compare::defaultBudgets();
  // A view that was not asked for may show what these do not.
  if (request.partOf && request.partOf->views > request.views.size())
    for (compare::BudgetRule& rule : budgets.materials) rule.requireSeen = false;
  return budgets;
}

} // namespace parity::job
