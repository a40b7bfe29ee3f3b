// Blocks of memory are kept for the next of the same kind, up to a limit, and never for another kind.
#include "support/device.h"

#include "gpu/device/memory.h"

namespace parity::gpu {
namespace {

class MemoryTest : public tests::DeviceTest {
protected:
  static constexpr vk::MemoryPropertyFlags kMapped =
      vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;

  std::uint32_t type() { return device().memoryType(~0u, kMapped, {}); }
};

TEST_F(MemoryTest, ABlockServesTheNextOfItsKind) {
  MemoryStore store(device().handle(), 1 << 20);
  vk::DeviceMemory handle;
  const std::byte* mapped = nullptr;
  {
    const Memory first(store, 4096, type(), true);
    handle = first.handle();
    mapped = first.mapped();
    EXPECT_NE(mapped, nullptr);
    EXPECT_EQ(store.kept(), 0u);
  }
  EXPECT_EQ(store.kept(), 4096u);
  const Memory smaller(store, 2048, type(), true), notMapped(store, 4096, type(), false);
  EXPECT_NE(smaller.handle(), handle);
  EXPECT_NE(notMapped.handle(), handle);
  EXPECT_EQ(notMapped.mapped(), nullptr);
  EXPECT_EQ(store.kept(), 4096u);
  const Memory same(store, 4096, type(), true);
  EXPECT_EQ(same.handle(), handle);
  EXPECT_EQ(same.mapped(), mapped);
  EXPECT_EQ(store.kept(), 0u);
}

TEST_F(MemoryTest, NoMoreThanTheLimitIsKept) {
  MemoryStore store(device().handle(), 5000), none(device().handle(), 0);
  { const Memory a(store, 4096, type(), false), b(store, 4096, type(), false), c(none, 4096, type(), false); }
  EXPECT_EQ(store.kept(), 4096u);
  EXPECT_EQ(none.kept(), 0u);
}

TEST_F(MemoryTest, AMovedBlockIsGivenBackOnce) {
  MemoryStore store(device().handle(), 1 << 20);
  {
    Memory from(store, 4096, type(), true);
    const std::byte* mapped = from.mapped();
    Memory to = std::move(from);
    EXPECT_EQ(to.mapped(), mapped);
    Memory assigned(store, 2048, type(), true);
    assigned = std::move(to);
    EXPECT_EQ(assigned.mapped(), mapped);
  }
  EXPECT_EQ(store.kept(), 4096u + 2048u);
}

} // namespace
} // namespace parity::gpu
