// The gdb server as a raw client sees it.
#include "board/gdb/gdb_server.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gdb_bench.hpp"
#include "io/input/input_error.hpp"

namespace dsdpv1::arm::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// firmware/loop.c: run: movs, movs, lsls, b; loop: adds, str, ldr, b
constexpr std::uint32_t kRun = 0x0800'0008, kLoop = 0x0800'0010;
const std::string kStopped = "T05thread:1;";

class GdbServerTest : public testing::Test {
 protected:
  std::uint32_t pc(RawGdb& gdb) {
    const std::string digits = gdb.ask("pf");
    const auto bytes = from_hex(digits);
    if (!bytes || bytes->size() != 4) return 0;
    std::uint32_t value = 0;
    for (unsigned i = 4; i-- > 0;) value = value << 8U | static_cast<std::uint8_t>((*bytes)[i]);
    return value;
  }
  std::string monitor(RawGdb& gdb, const std::string& words) { return gdb.ask("qRcmd," + to_hex(words)); }
  void start() { bench.start(); }

  GdbBench bench;
};

TEST_F(GdbServerTest, RunWaitsAtTheResetVectorUntilGdbLetsItGo) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("?"), kStopped);
  EXPECT_EQ(pc(gdb), kRun);
  EXPECT_EQ(from_hex(gdb.ask("qRcmd," + to_hex("time"))), "simulated time 0.000000000 s\n");
  EXPECT_THAT(bench.said(), ElementsAre("waiting for gdb: target remote localhost:" + std::to_string(bench.port())));
}

TEST_F(GdbServerTest, WrongChecksumIsAnsweredWithMinusAndPacketIsRepeatedOnRequest) {
  start();
  RawGdb gdb(bench.port());
  gdb.write("$?#00");
  EXPECT_EQ(gdb.read(1), "-");
  EXPECT_EQ(gdb.ask("?"), kStopped);
  gdb.write("-");
  EXPECT_EQ(gdb.reply(), kStopped);
}

TEST_F(GdbServerTest, NothingIsAcknowledgedAfterNoAckMode) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("QStartNoAckMode"), "OK");
  gdb.write(gdb_frame("qC"));
  EXPECT_EQ(gdb.reply(), "QC1");
}

TEST_F(GdbServerTest, SaysWhatItCanDo) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_THAT(gdb.ask("qSupported:hwbreak+"),
              AllOf(HasSubstr("PacketSize=4000"), HasSubstr("QStartNoAckMode+"), HasSubstr("qXfer:features:read+")));
  EXPECT_EQ(gdb.ask("vCont?"), "vCont;c;C;s;S;r");
  EXPECT_EQ(gdb.ask("qAttached"), "1");
  EXPECT_EQ(gdb.ask("qfThreadInfo"), "m1");
  EXPECT_EQ(gdb.ask("qsThreadInfo"), "l");
  EXPECT_EQ(gdb.ask("Hg0"), "OK");
  EXPECT_EQ(gdb.ask("T1"), "OK");
}

TEST_F(GdbServerTest, WhatItDoesNotKnowIsAnsweredEmpty) {
  start();
  RawGdb gdb(bench.port());
  for (const char* const packet : {"", "vMustReplyEmpty", "vAttach;1", "vFlashRead:8000000", "qTStatus", "QNonStop:1",
                                   "Z5,8000000,2", "qXfer:auxv:read::0,10"})
    EXPECT_EQ(gdb.ask(packet), "") << packet;
}

TEST_F(GdbServerTest, MalformedPacketsAreErrors) {
  start();
  RawGdb gdb(bench.port());
  for (const char* const packet : {"m",
                                   "m8000000",
                                   "mx,4",
                                   "m8000000,",
                                   "m100000000,4",
                                   "M20000000,2:00",
                                   "M20000000,1",
                                   "M20000000,1:0g",
                                   "p",
                                   "p17",
                                   "pffffffff",
                                   "P0",
                                   "P0=00",
                                   "P17=00000000",
                                   "Z0",
                                   "Z0,8000000",
                                   "Z2,20000000,0",
                                   "Gxx",
                                   "G00",
                                   "vCont;",
                                   "vCont;x",
                                   "vCont;r8000000",
                                   "cxyz",
                                   "qRcmd,0",
                                   "vFlashErase:8000000",
                                   "vFlashWrite:8000000",
                                   "qXfer:features:read:target.xml:0"})
    EXPECT_EQ(gdb.ask(packet), "E01") << packet;
  EXPECT_EQ(gdb.ask("G" + std::string((kRegisterCount + 1) * 8, '0')), "E01");
  EXPECT_EQ(pc(gdb), kRun) << "nothing of it has moved the processor";
}

TEST_F(GdbServerTest, RegistersAreReadAndWritten) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("P2=78563412"), "OK");
  EXPECT_EQ(gdb.ask("p2"), "78563412");
  EXPECT_EQ(gdb.ask("p16"), "00000000") << "control";
  const std::string all = gdb.ask("g");
  ASSERT_EQ(all.size(), kRegisterCount * 8);
  EXPECT_EQ(all.substr(2 * 8, 8), "78563412");
  EXPECT_EQ(all.substr(13 * 8, 8), "00000120") << "stack pointer";
  EXPECT_EQ(gdb.ask("G11000000" + all.substr(8)), "OK");
  EXPECT_EQ(gdb.ask("p0"), "11000000");
  EXPECT_EQ(gdb.ask("Pf=11000008"), "OK");
  EXPECT_EQ(pc(gdb), kLoop) << "without Thumb bit";
}

TEST_F(GdbServerTest, MemoryIsReadAndWritten) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("m8000000,8"), "0000012009000008");
  EXPECT_EQ(gdb.ask("M20000010,3:a1b2c3"), "OK");
  EXPECT_EQ(gdb.ask("X20000013,2:}\x03}]"), "OK");
  EXPECT_EQ(gdb.ask("m20000010,5"), "a1b2c3237d");
  EXPECT_EQ(gdb.ask("X20000010,0:"), "OK");
}

TEST_F(GdbServerTest, MemoryThatIsNotThereOrNotWritableIsAnError) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("m40000000,4"), "E0e");
  EXPECT_EQ(gdb.ask("m2000fffe,4"), "0000") << "as much as there is";
  EXPECT_EQ(gdb.ask("M8000000,1:00"), "E0e") << "flash";
  EXPECT_EQ(gdb.ask("m20000000,ffffffff").size(), kGdbPacketSize) << "no more than a packet holds";
}

TEST_F(GdbServerTest, DescriptionsComeInPieces) {
  start();
  RawGdb gdb(bench.port());
  std::string xml, part;
  do {
    part = gdb.ask(fmt::format("qXfer:features:read:target.xml:{:x},100", xml.size()));
    ASSERT_FALSE(part.empty());
    xml += part.substr(1);
  } while (part.front() == 'm');
  EXPECT_THAT(xml, AllOf(HasSubstr("org.gnu.gdb.arm.m-profile"), HasSubstr("org.gnu.gdb.arm.m-system"),
                         HasSubstr("faultmask"), testing::EndsWith("</target>")));
  EXPECT_EQ(gdb.ask("qXfer:features:read:target.xml:ffff,100"), "l");
  EXPECT_THAT(
      gdb.ask("qXfer:memory-map:read::0,1000"),
      AllOf(
          HasSubstr(
              R"(<memory type="flash" start="0x8000000" length="0x1000"><property name="blocksize">0x400</property></memory>)"),
          HasSubstr(R"(<memory type="ram" start="0x20000000" length="0x10000"/>)")));
}

TEST_F(GdbServerTest, BreakpointsOfBothKindsStopBeforeTheInstruction) {
  start();
  RawGdb gdb(bench.port());
  for (const char* const kind : {"0", "1"}) {
    EXPECT_EQ(gdb.ask("Z" + std::string(kind) + ",8000012,2"), "OK");
    EXPECT_EQ(gdb.ask("vCont;c"), kStopped);
    EXPECT_EQ(pc(gdb), kLoop + 2);
    EXPECT_EQ(gdb.ask("z" + std::string(kind) + ",8000012,2"), "OK");
    EXPECT_EQ(gdb.ask("vCont;s:1;c"), kStopped);
  }
  EXPECT_EQ(gdb.ask("p0"), "02000000") << "the second time round";
}

TEST_F(GdbServerTest, BreakpointStopsAgainEachTimeRound) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Z1,8000010,2"), "OK");
  for (const char* const count : {"00000000", "01000000", "02000000"}) {
    EXPECT_EQ(gdb.ask("c"), kStopped);
    EXPECT_EQ(gdb.ask("p0"), count);
  }
}

TEST_F(GdbServerTest, StepExecutesOneInstruction) {
  start();
  RawGdb gdb(bench.port());
  for (std::uint32_t at = kRun + 2; at <= kLoop + 6; at += 2) {
    EXPECT_EQ(gdb.ask("s"), kStopped);
    EXPECT_EQ(pc(gdb), at);
  }
  EXPECT_EQ(gdb.ask("s"), kStopped);
  EXPECT_EQ(pc(gdb), kLoop) << "b loop";
  EXPECT_EQ(from_hex(gdb.ask("qRcmd," + to_hex("time"))), "simulated time 0.000008000 s\n");
}

TEST_F(GdbServerTest, RangeIsSteppedThroughAtOnce) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("vCont;r8000008,8000010:1;c"), kStopped);
  EXPECT_EQ(pc(gdb), kLoop);
  EXPECT_EQ(gdb.ask("vCont;s"), kStopped);
  EXPECT_EQ(pc(gdb), kLoop + 2) << "the range is forgotten";
}

TEST_F(GdbServerTest, RunGoesOnAtAnotherAddressWhenAsked) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("s8000016"), kStopped);
  EXPECT_EQ(pc(gdb), kLoop) << "b loop";
}

TEST_F(GdbServerTest, WatchpointsStopAfterTheAccess) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Z2,20000002,1"), "OK");
  EXPECT_EQ(gdb.ask("c"), kStopped + "watch:20000002;");
  EXPECT_EQ(pc(gdb), kLoop + 4) << "behind str";
  EXPECT_EQ(gdb.ask("z2,20000002,1"), "OK");
  EXPECT_EQ(gdb.ask("Z3,20000000,4"), "OK");
  EXPECT_EQ(gdb.ask("c"), kStopped + "rwatch:20000000;");
  EXPECT_EQ(pc(gdb), kLoop + 6) << "behind ldr";
  EXPECT_EQ(gdb.ask("z3,20000000,4"), "OK");
  EXPECT_EQ(gdb.ask("Z4,20000000,4"), "OK");
  EXPECT_EQ(gdb.ask("c"), kStopped + "awatch:20000000;");
  EXPECT_EQ(pc(gdb), kLoop + 4);
  EXPECT_EQ(gdb.ask("Z4,20000004,4"), "OK");
  EXPECT_EQ(gdb.ask("z4,20000000,4"), "OK");
  EXPECT_EQ(gdb.ask("Z1,8000016,2"), "OK");
  EXPECT_EQ(gdb.ask("c"), kStopped) << "the neighbour is not touched";
}

TEST_F(GdbServerTest, AccessesAreReportedOnlyWhileOneIsWatched) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Z2,20000000,4"), "OK");
  EXPECT_TRUE(bench.target.reports_accesses());
  EXPECT_EQ(gdb.ask("z2,20000000,4"), "OK");
  EXPECT_FALSE(bench.target.reports_accesses());
  EXPECT_EQ(gdb.ask("Z2,20000000,4"), "OK");
  EXPECT_EQ(gdb.ask("D"), "OK");
  EXPECT_TRUE(gdb.closed());
  bench.stop();
  bench.end();
  EXPECT_FALSE(bench.target.reports_accesses());
}

TEST_F(GdbServerTest, TargetWithoutWatchpointsHasNone) {
  bench.target.watchable = false;
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Z2,20000000,4"), "");
}

TEST_F(GdbServerTest, CtrlCHaltsTheRun) {
  start();
  RawGdb gdb(bench.port());
  gdb.send("vCont;c");
  gdb.write("\x03");
  EXPECT_EQ(gdb.reply(), "T02thread:1;");
  EXPECT_EQ(gdb.ask("?"), "T02thread:1;");
  const std::string time = gdb.ask("qRcmd," + to_hex("time"));
  EXPECT_EQ(gdb.ask("qRcmd," + to_hex("time")), time) << "simulated time stands still";
  gdb.write("\x03");
  EXPECT_EQ(gdb.ask("s"), kStopped) << "a late Ctrl-C is nothing";
}

TEST_F(GdbServerTest, CtrlCHaltsARunThatIsNotPolledBecauseOfABreakpoint) {
  bench.target.polls_when_wanted = false;
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Z1,8000008,2"), "OK") << "not on the way";
  gdb.send("c");
  gdb.write("\x03");
  EXPECT_EQ(gdb.reply(), "T02thread:1;");
  EXPECT_EQ(gdb.ask("s"), kStopped);
}

TEST_F(GdbServerTest, CtrlCHaltsAStepThroughARangeThatIsNeverLeft) {
  bench.target.polls_when_wanted = false;
  start();
  RawGdb gdb(bench.port());
  gdb.send("vCont;r8000008,8000018");
  gdb.write("\x03");
  EXPECT_EQ(gdb.reply(), "T02thread:1;");
}

TEST_F(GdbServerTest, StepAfterAChangeOfPcExecutesTheInstructionThere) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("s"), kStopped);
  EXPECT_EQ(gdb.ask("Pf=0c000008"), "OK");
  EXPECT_EQ(gdb.ask("s"), kStopped);
  EXPECT_EQ(pc(gdb), kRun + 6);
  EXPECT_EQ(from_hex(gdb.ask("qRcmd," + to_hex("time"))), "simulated time 0.000002000 s\n");
}

TEST_F(GdbServerTest, BreakpointWhereTheRunIsLetGoDoesNotStopItAtOnce) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Z1,8000008,2"), "OK");
  EXPECT_EQ(gdb.ask("Z1,8000010,2"), "OK");
  EXPECT_EQ(gdb.ask("c"), kStopped);
  EXPECT_EQ(pc(gdb), kLoop);
  EXPECT_EQ(gdb.ask("c8000010"), kStopped);
  EXPECT_EQ(gdb.ask("p0"), "01000000") << "once round";
}

TEST_F(GdbServerTest, AfterDetachTheRunGoesOnAndTheNextGdbHaltsIt) {
  start();
  RawGdb first(bench.port());
  EXPECT_EQ(first.ask("Z1,8000012,2"), "OK");
  EXPECT_EQ(first.ask("D"), "OK");
  EXPECT_TRUE(first.closed());
  RawGdb second(bench.port());
  EXPECT_EQ(second.ask("?"), kStopped);
  EXPECT_NE(second.ask("p0"), "00000000") << "the breakpoint has gone with the first one";
  EXPECT_EQ(bench.said().size(), 1U) << "waiting";
}

TEST_F(GdbServerTest, GdbThatGoesWithoutDetachLetsTheRunGoOnWithAMessage) {
  start();
  {
    RawGdb halted(bench.port());
    EXPECT_EQ(halted.ask("Z1,8000012,2"), "OK");
  }
  {
    RawGdb running(bench.port());
    EXPECT_EQ(running.ask("?"), kStopped);
    running.send("c");
  }
  RawGdb next(bench.port());
  EXPECT_EQ(next.ask("?"), kStopped);
  EXPECT_THAT(bench.said(), ElementsAre(StartsWith("waiting"), "gdb has gone without `detach`: the run goes on",
                                        "gdb has gone without `detach`: the run goes on"));
}

TEST_F(GdbServerTest, KillEndsTheRun) {
  for (const char* const packet : {"k", "vKill;1"}) {
    GdbBench run;
    run.start();
    RawGdb gdb(run.port());
    gdb.send(packet);
    if (packet[0] == 'v') EXPECT_EQ(gdb.reply(), "OK");
    EXPECT_TRUE(gdb.closed());
    run.end();
    EXPECT_TRUE(run.target.ended());
    EXPECT_EQ(run.target.done(), 0U);
    EXPECT_EQ(run.said().size(), 1U) << "waiting";
  }
}

TEST_F(GdbServerTest, EndOfTheRunIsToldToAGdbThatWaits) {
  GdbBench run(5000);
  run.start();
  RawGdb gdb(run.port());
  EXPECT_EQ(gdb.ask("c"), "W00");
  EXPECT_TRUE(gdb.closed());
  run.end();
  EXPECT_EQ(run.target.done(), 5000U);
}

TEST_F(GdbServerTest, SigintEndsARunThatWaitsForGdb) {
  start();
  bench.stop();
  bench.end();
  EXPECT_LE(bench.target.done(), 1000U);
}

TEST_F(GdbServerTest, SigintEndsARunThatIsHalted) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("?"), kStopped);
  bench.stop();
  bench.end();
  EXPECT_TRUE(gdb.closed());
}

TEST_F(GdbServerTest, SecondGdbIsTurnedAway) {
  start();
  RawGdb first(bench.port());
  EXPECT_EQ(first.ask("?"), kStopped);
  RawGdb second(bench.port());
  EXPECT_TRUE(second.closed());
  EXPECT_EQ(first.ask("qC"), "QC1");
  EXPECT_TRUE(RawGdb(bench.port()).closed());
  const std::vector<std::string> said = bench.said();
  const auto told = std::count_if(said.begin(), said.end(), [](const std::string& line) {
    return line.find("is turned away: one gdb at a time") != std::string::npos;
  });
  EXPECT_EQ(told, 1) << "a line for the first one, however many come";
}

TEST_F(GdbServerTest, NoiseIsSurvived) {
  start();
  RawGdb gdb(bench.port());
  gdb.write("GET / HTTP/1.1\r\n\r\n");
  std::string noise;
  for (unsigned i = 1; i <= 5000; ++i) noise += static_cast<char>(i * 2654435761U >> 13U);
  gdb.write(noise);
  gdb.hang_up();
  RawGdb next(bench.port());
  EXPECT_EQ(next.ask("?"), kStopped);
}

TEST_F(GdbServerTest, FaultIsShownBeforeTheRunEnds) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("Pf=00000008"), "OK");
  EXPECT_EQ(gdb.ask("P0=00000000"), "OK");
  EXPECT_EQ(gdb.ask("Z1,8000000,2"), "OK");
  gdb.send("Pf=00010008");  // 0x08000100 holds 0xFFFF
  EXPECT_EQ(gdb.reply(), "OK");
  gdb.send("c");
  EXPECT_EQ(gdb.reply(), "O" + to_hex("an instruction that nobody knows\n"));
  EXPECT_EQ(gdb.reply(), "T0bthread:1;");
  EXPECT_EQ(gdb.ask("c"), "W00");
}

TEST_F(GdbServerTest, EachMonitorResetLeavesTheProcessorAtItsFirstInstruction) {
  start();
  RawGdb gdb(bench.port());
  for (const char* const words : {"reset", "reset halt", "reset init", "reset run"}) {
    EXPECT_EQ(gdb.ask("s"), kStopped);
    EXPECT_EQ(gdb.ask("Pf=" + std::string("11000008")), "OK") << "a new pc does not come before the reset";
    EXPECT_EQ(from_hex(monitor(gdb, words)), "reset, halted before the first instruction of the reset handler\n")
        << words;
    EXPECT_EQ(pc(gdb), kRun) << words;
    EXPECT_EQ(gdb.ask("?"), kStopped);
  }
  EXPECT_EQ(from_hex(monitor(gdb, "time")), "simulated time 0.000004000 s\n");
  EXPECT_EQ(gdb.ask("s"), kStopped);
  EXPECT_EQ(pc(gdb), kRun + 2) << "it goes on from there";
}

TEST_F(GdbServerTest, MonitorHaltAndSleepChangeNothing) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(from_hex(monitor(gdb, "halt")), "halted at 0x08000008\n");
  for (const char* const words : {"sleep 500", "delay 3000"})
    EXPECT_EQ(from_hex(monitor(gdb, words)), "no wait: simulated time stands still while the processor is halted\n");
  EXPECT_EQ(
      from_hex(monitor(gdb, "arm semihosting enable")),
      "monitor arm semihosting enable: expected time, reset, reset halt, reset init, reset run, halt, sleep MS\n");
  EXPECT_EQ(pc(gdb), kRun);
}

/// Flash of the fake target from `address` on, as vFlashWrite has it.
std::string flash_write(RawGdb& gdb, std::uint32_t address, std::uint32_t size) {
  const auto bytes = from_hex(gdb.ask(fmt::format("m{:x},{:x}", address, size)));
  std::string escaped;
  for (const char byte : bytes.value_or("")) {
    const bool special = byte == '#' || byte == '$' || byte == '}' || byte == '*';
    escaped += special ? std::string{'}', static_cast<char>(byte ^ 0x20)} : std::string{byte};
  }
  return fmt::format("vFlashWrite:{:x}:", address) + escaped;
}

TEST_F(GdbServerTest, FlashTakesTheProgramThatItHas) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("vFlashErase:8000000,800"), "OK");
  EXPECT_EQ(gdb.ask(flash_write(gdb, 0x08000000, 7)), "OK") << "packets end anywhere";
  EXPECT_EQ(gdb.ask(flash_write(gdb, 0x08000007, 0x7F9)), "OK");
  EXPECT_EQ(gdb.ask("vFlashDone"), "OK");
  EXPECT_EQ(gdb.ask("vFlashDone"), "OK");
  EXPECT_EQ(bench.said().size(), 1U);
}

TEST_F(GdbServerTest, LoadThatHasBrokenOffIsForgotten) {
  start();
  RawGdb first(bench.port());
  EXPECT_EQ(first.ask("vFlashErase:8000000,400"), "OK");
  EXPECT_EQ(first.ask("D"), "OK");
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("vFlashErase:8000400,400"), "OK");
  EXPECT_EQ(gdb.ask("vFlashDone"), "OK") << "nothing is there";
}

TEST_F(GdbServerTest, FlashRefusesInWordsAnotherProgramAndWhatARealOneDoesNotDo) {
  start();
  RawGdb gdb(bench.port());
  const std::string other = "; start the run again with this program (--set user_cpu.elf=FILE)";
  const std::vector<std::pair<std::string, std::string>> refused = {
      {"vFlashWrite:8000000:x", "flash at 0x08000000 must be erased before it is written"},
      {"vFlashErase:8000200,400", "1024 bytes at 0x08000200 cannot be erased, flash has pages of 1024 bytes"},
      {"vFlashErase:8000000,200", "512 bytes at 0x08000000 cannot be erased, flash has pages of 1024 bytes"},
      {"vFlashErase:8000c00,800", "there is no flash of 2048 bytes at 0x08000c00 to erase"},
      {"vFlashErase:20000000,400", "there is no flash of 1024 bytes at 0x20000000 to erase"},
      {"vFlashWrite:8000fff:xx", "there is no flash of 2 bytes at 0x08000fff to write"},
      {"vFlashErase:8000000,400", ""},
      {"vFlashWrite:8000000:x", ""},
      {"vFlashWrite:8000000:y", "flash at 0x08000000 must be erased before it is written"},
      {"vFlashDone", "gdb loads another program than that of the run: 0x78 at 0x08000000, expected 0x00" + other},
      {"vFlashErase:8000000,400", ""},
      {"vFlashDone", "gdb loads another program than that of the run: 0xff at 0x08000000, expected 0x00" + other},
      {"vFlashWrite:8000000:x", "flash at 0x08000000 must be erased before it is written"},
  };
  std::vector<std::string> said = {fmt::format("waiting for gdb: target remote localhost:{}", bench.port())};
  for (const auto& [packet, words] : refused) {
    EXPECT_EQ(gdb.ask(packet), words.empty() ? "OK" : "E." + words);
    if (!words.empty()) said.push_back("load: " + words);
    EXPECT_EQ(bench.said(), said);
  }
  EXPECT_EQ(gdb.ask("m8000000,8"), "0000012009000008") << "the program is there";
}

TEST_F(GdbServerTest, ExtendedGdbMayKillAndRunAgain) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("!"), "OK");
  EXPECT_EQ(gdb.ask("s"), kStopped);
  EXPECT_EQ(gdb.ask("vKill;a410"), "OK");
  EXPECT_EQ(gdb.ask("?"), "W00");
  EXPECT_EQ(gdb.ask("vRun;"), kStopped);
  EXPECT_EQ(pc(gdb), kRun);
  EXPECT_EQ(gdb.ask("vRun;6c6f6f70;61"), kStopped) << "also without kill";
  EXPECT_EQ(gdb.ask("?"), kStopped);
  EXPECT_EQ(gdb.ask("D"), "OK");
  EXPECT_FALSE(bench.target.ended());
}

TEST_F(GdbServerTest, ExtendedGdbThatKillsAndGoesEndsTheRun) {
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(gdb.ask("!"), "OK");
  gdb.send("k");
  gdb.hang_up();
  bench.end();
  EXPECT_TRUE(bench.target.ended());
  EXPECT_EQ(bench.said().size(), 1U);
}

TEST_F(GdbServerTest, TargetThatCannotBeResetSaysSo) {
  bench.target.resettable = false;
  start();
  RawGdb gdb(bench.port());
  EXPECT_EQ(from_hex(monitor(gdb, "reset")), "the processor cannot be reset\n");
  EXPECT_EQ(gdb.ask("vRun;"), "E01");
}

TEST_F(GdbServerTest, DebuggerIsWantedOnlyWhileSomethingMayStopTheRun) {
  FakeTarget target(load_elf(LOOP_ELF));
  GdbOptions options;
  bool stopped = false;
  options.stopped = [&] { return stopped; };
  GdbServer server(target, options);
  EXPECT_TRUE(server.wanted()) << "waiting for gdb";
  RawGdb gdb(server.port());
  gdb.write(gdb_frame("Z1,8000010,2") + gdb_frame("c"));
  server.before_instruction(kRun);
  EXPECT_TRUE(server.wanted()) << "a breakpoint";
  gdb.write(gdb_frame("z1,8000010,2") + gdb_frame("s"));
  server.before_instruction(kLoop);
  EXPECT_TRUE(server.wanted()) << "a step";
  gdb.write(gdb_frame("c"));
  server.before_instruction(kLoop + 2);
  EXPECT_FALSE(server.wanted()) << "running free";
  gdb.write("\x03");
  stopped = true;
  server.poll();
  EXPECT_FALSE(server.wanted()) << "the run ends";
}

TEST_F(GdbServerTest, PortInUseIsOneLine) {
  start();
  FakeTarget target(load_elf(LOOP_ELF));
  GdbOptions options;
  options.port = bench.port();
  try {
    const GdbServer second(target, options);
    FAIL() << "two servers at one port";
  } catch (const tb::InputError& error) {
    EXPECT_EQ(std::string(error.what()), "--gdb: TCP port 127.0.0.1:" + std::to_string(bench.port()) +
                                             " cannot be had: Address already in use, expected a free one");
  }
}

}  // namespace
}  // namespace dsdpv1::arm::test
