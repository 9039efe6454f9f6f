// A real gdb against the server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "gdb_bench.hpp"

namespace dsdpv1::arm::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// The output of gdb for these commands; it has five minutes, far more than it needs.
std::string gdb(const GdbBench& bench, const std::vector<std::string>& commands) {
  std::string line = "timeout 300 " GDB " -nx -batch -ex 'set tcp connect-timeout 120' -ex 'file " LOOP_ELF "'";
  line += " -ex 'target remote localhost:" + std::to_string(bench.port()) + "'";
  for (const std::string& command : commands) line += " -ex '" + command + "'";
  std::FILE* const pipe = ::popen((line + " 2>&1 < /dev/null").c_str(), "r");
  if (pipe == nullptr) return "";
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), count);
  EXPECT_EQ(::pclose(pipe), 0) << text;
  return text;
}

TEST(GdbMultiarch, BreaksStepsAndReadsRegistersAndMemory) {
  GdbBench bench;
  bench.start();
  const std::string text = gdb(
      bench, {"info registers pc", "break loop", "continue", "stepi", "print $r0", "stepi", "x/1xw &counter",
              "continue", "print $r0", "print/x $msp", "print/x $control", "print $primask", "monitor time", "detach"});
  EXPECT_THAT(text, ContainsRegex("pc +0x8000008 +0x8000008 <run>"));
  EXPECT_THAT(text, ContainsRegex("Breakpoint 1, loop .*at .*loop.c:[0-9]+"));
  EXPECT_THAT(text, HasSubstr("$1 = 1\n"));
  EXPECT_THAT(text, HasSubstr("<counter>:\t0x00000001"));
  EXPECT_THAT(text, HasSubstr("$2 = 1\n"));
  EXPECT_THAT(text, HasSubstr("$3 = 0x20010000\n"));
  EXPECT_THAT(text, HasSubstr("$4 = 0x0\n"));
  EXPECT_THAT(text, HasSubstr("$5 = 0\n"));
  EXPECT_THAT(text, HasSubstr("simulated time 0.000008000 s"));
  EXPECT_THAT(text, Not(ContainsRegex("[Ww]arning|[Ee]rror|truncated")));
}

TEST(GdbMultiarch, WritesRegistersAndMemory) {
  GdbBench bench;
  bench.start();
  const std::string text = gdb(
      bench, {"set var $r0 = 41", "set var $r1 = 0x20000100", "tbreak *((char*)&loop+4)", "jump *&loop", "print $r0",
              "print *(unsigned*)0x20000100", "set var counter = 7", "set var *(int*)&loop = 0", "print counter"});
  EXPECT_THAT(text, HasSubstr("$1 = 42\n"));
  EXPECT_THAT(text, HasSubstr("$2 = 42\n"));
  EXPECT_THAT(text, HasSubstr("$3 = 7\n"));
  EXPECT_THAT(text, HasSubstr("Writing to flash memory forbidden"));
}

TEST(GdbMultiarch, WatchesData) {
  GdbBench bench;
  bench.start();
  const std::string text = gdb(bench, {"watch *(unsigned*)&counter", "continue", "continue", "delete"});
  EXPECT_THAT(text, HasSubstr("Hardware watchpoint 1"));
  EXPECT_THAT(text, ContainsRegex("Old value = 0\nNew value = 1\n"));
  EXPECT_THAT(text, ContainsRegex("Old value = 1\nNew value = 2\n"));
}

TEST(GdbMultiarch, SetsHardwareBreakpointsInFlash) {
  GdbBench bench;
  bench.start();
  const std::string text = gdb(bench, {"set debug remote 1", "break loop", "continue", "detach"});
  EXPECT_THAT(text, HasSubstr("$Z1,8000010,2#"));
  EXPECT_THAT(text, Not(HasSubstr("$Z0,8000010")));
}

TEST(GdbMultiarch, LoadsTheProgramOfTheRunAndRefusesAnother) {
  GdbBench bench;
  bench.start();
  EXPECT_THAT(gdb(bench, {"load", "compare-sections", "detach"}), ContainsRegex("Transfer rate.*\n.*matched"));
  const std::string text = gdb(bench, {"load " COUNTER_ELF, "compare-sections", "detach"});
  EXPECT_THAT(text, HasSubstr("Error finishing flash operation"));
  EXPECT_THAT(text, Not(HasSubstr("MIS-MATCHED"))) << "the program of the run is there";
  EXPECT_THAT(bench.said().back(), HasSubstr("load: gdb loads another program than that of the run"));
}

TEST(GdbMultiarch, LeavesTheRunGoingWhenItQuits) {
  GdbBench bench;
  bench.start();
  gdb(bench, {"break loop", "continue"});
  EXPECT_THAT(gdb(bench, {"print $r0 > 0"}), HasSubstr("$1 = 1\n"));
  EXPECT_EQ(bench.said().size(), 1U) << "it has detached";
}

TEST(GdbMultiarch, EndsTheRunWithKill) {
  GdbBench bench;
  bench.start();
  EXPECT_THAT(gdb(bench, {"kill"}), HasSubstr("killed]"));
  bench.end();
  EXPECT_TRUE(bench.target.ended());
}

}  // namespace
}  // namespace dsdpv1::arm::test
