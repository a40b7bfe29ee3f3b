// Blocks of memory are kept for the next of the same size and kind, up to a limit.
#include "support/device.h"

#include <cstring>

#include "base/error.h"
#include "base/parallel.h"
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
  EXPECT_EQ(store.kept(), 4096u); // the second dropped the first
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

// A device has no block of this size; what is kept goes, and the error remains that of the device.
TEST_F(MemoryTest, WhatIsKeptGoesWhereTheDeviceHasNoMore) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer ends a software device that asks the host for so much";
#endif
  MemoryStore store(device().handle(), 1 << 20);
  { const Memory kept(store, 4096, type(), false); }
  ASSERT_EQ(store.kept(), 4096u);
  EXPECT_THROW(store.take(vk::DeviceSize{1} << 60, type(), false), vk::SystemError);
  EXPECT_EQ(store.kept(), 0u);
  EXPECT_THROW(device().checkValidation(), base::Error); // the layer has noticed
}

TEST_F(MemoryTest, ThreadsShareAStore) {
  MemoryStore store(device().handle(), 1 << 20);
  base::parallelFor(64, 1, [&](std::size_t i, std::size_t) {
    const Memory memory(store, 1024 * (1 + i % 3), type(), true);
    std::memset(memory.mapped(), static_cast<int>(i), 1024);
    EXPECT_EQ(memory.mapped()[1023], static_cast<std::byte>(i));
  });
  EXPECT_LE(store.kept(), 64u * 3 * 1024);
}

} // namespace
} // namespace parity::gpu
