// The last column of table 2, written here a second time: what the user may write (P6, P13).
#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {
namespace {

/// Areas marked R. All others are R/W or reserved, and reserved cells belong to neither side (P13).
struct Cells {
  std::uint16_t first, last;
};
constexpr Cells kReadOnly[] = {{0x000, 0x003}, {0x004, 0x004}, {0x008, 0x009}, {0x00A, 0x00B}, {0x012, 0x013},
                               {0x410, 0x4FD}, {0x4FE, 0x4FF}, {0x500, 0x5CA}, {0x5CB, 0x5CC}};

bool is_read_only(int cell) {
  return std::any_of(
      std::begin(kReadOnly), std::end(kReadOnly),
      [cell](const Cells& cells) { return cell >= cells.first && cell <= cells.last; });
}

TEST(UserRights, WritesToCellsThatTable2MarksForReadingAreReportedAndNoOthers) {
  SlaveBench bench(Config{}, Engines::kSkipAlone);
  bench.power_on();
  bench.acquire();
  for (int cell = 0; cell <= 0x7FF; ++cell) {
    if (cell == 0x00A || cell == 0x00B) continue;  // D5 and chapter 8 let the user clear their bits
    const int before = bench.count(dsdpv1::Reason::kReadOnlyWritten);
    bench.write(static_cast<std::uint16_t>(cell), 0xE7);
    bench.run_cycles(4);
    ASSERT_EQ(bench.count(dsdpv1::Reason::kReadOnlyWritten) - before, is_read_only(cell) ? 1 : 0) << std::hex << cell;
    if (is_read_only(cell)) EXPECT_EQ(bench.last(dsdpv1::Reason::kReadOnlyWritten).a, static_cast<unsigned>(cell));
  }
}

}  // namespace
}  // namespace dsdpv1::conformance
