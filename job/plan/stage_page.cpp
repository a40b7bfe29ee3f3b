#include "job/plan/worker.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/error.h"

namespace parity::job {

// The worker may die between any two bytes: what is read then is still a text.
struct StagePage::Page {
  std::array<std::atomic<char>, kMostStage + 1> text;
};

StagePage::StagePage() {
  m_descriptor = ::memfd_create("parity-stage", MFD_CLOEXEC);
  if (m_descriptor < 0 || ::ftruncate(m_descriptor, sizeof(Page)) != 0)
    throw base::fileError("stage page", "", std::generic_category().message(errno));
  void* memory = ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, m_descriptor, 0);
  if (memory == MAP_FAILED) throw base::fileError("stage page", "", std::generic_category().message(errno));
  m_page = static_cast<Page*>(memory);
}

StagePage::StagePage(int descriptor) {
  if (descriptor < 0) return;
  void* memory = ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (memory != MAP_FAILED) m_page = static_cast<Page*>(memory);
}

StagePage::~StagePage() {
  if (m_page) ::munmap(m_page, sizeof(Page));
  if (m_descriptor >= 0) ::close(m_descriptor);
}

void StagePage::set(const std::string& stage) {
  if (!m_page) return;
  const std::size_t size = std::min(stage.size(), kMostStage);
  m_page->text[size].store(0);
  for (std::size_t i = 0; i < size; ++i) m_page->text[i].store(stage[i]);
}

std::string StagePage::get() const {
  std::string stage;
  if (!m_page) return stage;
  for (std::size_t i = 0; i < kMostStage; ++i) {
    const char c = m_page->text[i].load();
    if (c == 0) break;
    stage += c;
  }
  return stage;
}

} // namespace parity::job
