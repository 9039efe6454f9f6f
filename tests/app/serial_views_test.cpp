// The serial ports of a DSDPV1-RSU in both views, beyond the shipped scenarios: disturbed telegrams, other timings of
// the user CPU, and resets inside frames and telegrams. Every pin must change at the same ticks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/app/program.hpp"

namespace dsdpv1 {
namespace {

using app_test::call;
using app_test::read;

/// Faults early, then a reset every 1237 us: each at another place in the user CPU's activity.
std::string scenario(const std::string& chip, const std::string& port, const std::vector<std::string>& faults) {
  std::ostringstream text;
  text << "name: serial\nbaud: 1.5M\nend: 60ms\nchip: {kind: dsdpv1_rsu, search_window_ms: 5, " << chip << "}\n"
       << "slaves:\n  - {name: s, address: 5, init: {ident: 1, max_inputs: 2, max_outputs: 2, cfg: \"31\"}, "
       << "user_cpu: {cycle: 1ms, behaviour: loop_back, " << port << "}}\n"
       << "masters:\n  - {name: m, address: 2, start: 1ms, bus: {gap_factor: 0, min_slave_interval: 3000}, "
       << "slaves: [{slave: s, outputs: \"01 02\"}]}\nscript:\n";
  for (std::size_t i = 0; i < faults.size(); ++i)
    text << "  - {at: " << 20 + 4 * i << "ms, do: " << faults[i] << ", slave: s, times: 2}\n";
  for (int i = 0; i < 12; ++i) text << "  - {at: " << 35'000 + 1237 * i << "us, do: reset_chip, slave: s, for: 20us}\n";
  return text.str();
}

/// Changes at one time may come in any order.
std::string sorted_wave(const std::string& vcd) {
  std::istringstream in(vcd);
  std::ostringstream out;
  std::vector<std::string> changes;
  const auto flush = [&] {
    std::sort(changes.begin(), changes.end());
    for (const std::string& change : changes) out << change << "\n";
    changes.clear();
  };
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] == '#') flush();
    changes.push_back(line);
  }
  flush();
  return out.str();
}

void expect_same_in_both_views(const std::string& text) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml")) << text;
  for (const std::string view : {"pins", "tlm"}) {
    const app_test::Called called =
        call(fmt::format("run s.yaml --quiet --checks off --view {0} --wave {0}.vcd --log {0}.log "
                         "--trace {0}.trace",
                         view),
             folder.path());
    ASSERT_LE(called.status, 1) << called.err;  // 1: the resets are violations
  }
  for (const char* ending : {".log", ".trace"})
    EXPECT_TRUE(read(folder.file(std::string("pins") + ending)) == read(folder.file(std::string("tlm") + ending)))
        << ending;
  const std::string wave = sorted_wave(read(folder.file("pins.vcd")));
  EXPECT_GT(std::count(wave.begin(), wave.end(), '#'), 5000);
  EXPECT_TRUE(wave == sorted_wave(read(folder.file("tlm.vcd"))));
}

TEST(SerialViews, SpiIsTheSameWithFaultsGapsAndResets) {
  expect_same_in_both_views(scenario("mode: spi, spi_reply_gap: 2",
                                     "spi: {clock: 7000, byte_gap: 1us, gap: 900ns, mosi_delay: 60ns, spare: 2}",
                                     {"flip_bit", "cut_telegram"}));
}

/// RESET of the board ends the user CPU and the chip at once: a frame that it cuts off breaks no rule. The frames are
/// slow, so that each reset is within one.
TEST(SerialViews, AResetWithinAFrameIsNoViolation) {
  const app_test::Folder folder;
  std::ofstream(folder.file("s.yaml")) << scenario("mode: spi", "spi: {clock: 100}", {});
  for (const std::string view : {"pins", "tlm"}) {
    call("run s.yaml --quiet --checks off --log s.log --view " + view, folder.path());
    const std::string log = read(folder.file("s.log"));
    EXPECT_NE(log.find("SPI_CLAIMED"), std::string::npos) << view;
    EXPECT_EQ(log.find("violation SPI_"), std::string::npos) << view;
  }
}

TEST(SerialViews, UartIsTheSameWithFaultsAnotherRateAndResets) {
  expect_same_in_both_views(scenario("mode: uart, uart_rate: 460.8k", "uart: {rate: 455000, gap: 3us}",
                                     {"flip_bit", "cut_telegram", "wrong_parity"}));
}

}  // namespace
}  // namespace dsdpv1
