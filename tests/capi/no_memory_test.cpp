// A separate program, because its operator new can run out of memory; the library allocates through it as well.
#include <cstdlib>
#include <new>

#include "tests/capi/capi.hpp"

namespace {

thread_local int blocks_left = -1;  ///< that operator new still provides; below 0: no limit

}  // namespace

void* operator new(std::size_t size, const std::nothrow_t& /*unused*/) noexcept {
  if (blocks_left == 0) return nullptr;
  if (blocks_left > 0) --blocks_left;
  return std::malloc(size);
}
void* operator new(std::size_t size) {
  void* block = operator new(size, std::nothrow);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

namespace dsdpv1::capi_test {
namespace {

TEST(CapiMemory, WithoutMemoryNothingIsMadeAndNothingIsLost) {
  dpsim_bus* bus = nullptr;
  blocks_left = 0;
  const dpsim_status status = dpsim_bus_create(nullptr, &bus);
  blocks_left = -1;
  EXPECT_EQ(status, DPSIM_ERR_NO_MEMORY);
  EXPECT_EQ(bus, nullptr);
  EXPECT_STREQ(dpsim_error_message(), "there is no memory left");
  const auto chip = make_chip();
  ok(dpsim_chip_watch(chip.get(), DPSIM_ALL_PINS, nullptr, nullptr));
  blocks_left = 0;
  const dpsim_status lost = dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_RESET, 1);
  blocks_left = -1;
  EXPECT_EQ(lost, DPSIM_ERR_NO_MEMORY);
  ok(dpsim_chip_advance(chip.get(), kMs));
}

}  // namespace
}  // namespace dsdpv1::capi_test
