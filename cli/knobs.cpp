// parity knobs: the reference page of every setting.
#include "cli/invocation.h"
#include "cli/output.h"
#include "job/knob_page.h"

namespace parity::cli {

int runKnobsCommand() {
  printText(job::describeKnobs());
  return 0;
}

} // namespace parity::cli
