// parity knobs: the reference page of every setting.
#include <fmt/format.h>

#include "base/log.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "job/knob_page.h"
#include "job/knobs.h"

namespace parity::cli {

int runKnobsCommand() {
  base::logDetail(
      fmt::format("{} settings of a run, {} of a view", job::knobs().rows().size(), scenes::viewKnobs().rows().size()));
  printText(job::describeKnobs());
  return 0;
}

} // namespace parity::cli
