// Work that is given up because the run was told to stop.
#pragma once

namespace parity::job {

// Thrown by Context::requireGoesOn(). No std::exception: what makes an error of one must not make one of this.
struct Stopped {
  int signal = 0;
};

} // namespace parity::job
