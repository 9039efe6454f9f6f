// Waves: exact times, X and Z, complete or absent files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>
#ifdef DSDPV1_WITH_FST
#include <fstapi.h>
#endif

#include "io/input/input_error.hpp"
#include "io/waves/fst_blocks.hpp"
#include "io/waves/recover.hpp"
#include "io/waves/wave_reader.hpp"
#include "io/waves/wave_writer.hpp"
#ifdef DSDPV1_WITH_FST
#include "tests/io/waves/gz.hpp"
#endif

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;

class Waves : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dsdpv1_waves_" + std::to_string(::getpid()) +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string read(const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  static void write_example(tb::WaveWriter& wave) {
    wave.open_scope("demo");
    const auto l_req = wave.wire("L_REQ", 1);
    const auto d = wave.wire("D", 8);
    const auto state = wave.words("dp_state");
    wave.close_scope();
    wave.set(0, l_req, 0);
    wave.set(0, d, tb::WaveWriter::kReleased);
    wave.say(0, state, "OFFLINE");
    wave.set(250, l_req, 1);
    wave.set(375, d, tb::WaveWriter::kUnknown);
    wave.set(500, d, 0xA5);
    wave.say(500, state, "WAIT_PRM");
  }
  fs::path folder_;
};

TEST(WaveTime, IsRoundedOnceFromTheAbsoluteTick) {
  EXPECT_EQ(tb::picoseconds(0), 0U);
  EXPECT_EQ(tb::picoseconds(250), 20833U);  // one chip cycle, 20833.33 ps
  EXPECT_EQ(tb::picoseconds(500), 41667U);  // two, 41666.67 ps
  EXPECT_EQ(tb::picoseconds(bus::kTicksPerSecond), 1'000'000'000'000U);
}

TEST_F(Waves, VcdHoldsDeclarationsAndChanges) {
  auto wave = tb::open_wave(path("w.vcd"));
  write_example(*wave);
  wave->finish(750);
  EXPECT_EQ(read(path("w.vcd")),
            "$version dsdpv1-sim " DSDPV1_VERSION
            " $end\n$timescale 1 ps $end\n$scope module demo $end\n"
            "$var wire 1 % L_REQ $end\n$var wire 8 & D [7:0] $end\n$var string 1 ~' dp_state $end\n$upscope $end\n"
            "$enddefinitions $end\n#0\n0%\nbzzzzzzzz &\nsOFFLINE ~'\n#20833\n1%\n#31250\nbxxxxxxxx &\n#41667\n"
            "b10100101 &\nsWAIT_PRM ~'\n#62500\n");
}

TEST_F(Waves, VcdHasTheDateThatItIsGiven) {
  auto wave = tb::open_wave(path("w.vcd"), "2026-11-24 13:15:08 UTC");
  write_example(*wave);
  wave->finish(750);
  EXPECT_EQ(
      read(path("w.vcd")).rfind("$version dsdpv1-sim " DSDPV1_VERSION " $end\n$date 2026-11-24 13:15:08 UTC $end\n", 0),
      0U);
  EXPECT_EQ(tb::wave_format(path("w.vcd")), tb::WaveFormat::kVcd);
}

TEST_F(Waves, UnfinishedFileIsAbsent) {
  for (const char* const name : {"w.vcd", "w.fst"}) {
    try {
      auto wave = tb::open_wave(path(name));
      write_example(*wave);
    } catch (const tb::InputError&) {  // built without FST
    }
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Waves, ChangesOutOfOrderAreAProgrammingError) {
  auto wave = tb::open_wave(path("w.vcd"));
  const auto signal = wave->wire("A", 1);
  wave->set(10, signal, 1);
  EXPECT_THROW(wave->set(9, signal, 0), std::logic_error);
}

TEST_F(Waves, OtherEndingsAreRefused) {
  EXPECT_THROW(tb::open_wave(path("w.png")), tb::InputError);
  EXPECT_THROW(tb::open_wave(path("vcd")), tb::InputError);
}

TEST_F(Waves, FolderThatDoesNotExistIsAnInputError) { EXPECT_THROW(tb::open_wave(path("none/w.vcd")), tb::InputError); }

#ifdef DSDPV1_WITH_FST
void collect(void* text, uint64_t time, fstHandle signal, const unsigned char* value) {
  *static_cast<std::ostringstream*>(text) << time << ' ' << signal << ' ' << value << '\n';
}
void collect_words(void* text, uint64_t time, fstHandle signal, const unsigned char* value, uint32_t length) {
  *static_cast<std::ostringstream*>(text)
      << time << ' ' << signal << ' ' << std::string(reinterpret_cast<const char*>(value), length) << '\n';
}

TEST_F(Waves, FstReadsBackWhatWasWritten) {
  auto wave = tb::open_wave(path("w.fst"), "2026-11-24 13:15:08 UTC");
  write_example(*wave);
  wave->finish(750);
  void* reader = fstReaderOpen(path("w.fst").c_str());
  ASSERT_NE(reader, nullptr);
  EXPECT_EQ(fstReaderGetEndTime(reader), 62500U);
  EXPECT_EQ(fstReaderGetTimescale(reader), -12);
  EXPECT_STREQ(fstReaderGetVersionString(reader), "dsdpv1-sim " DSDPV1_VERSION);
  EXPECT_STREQ(fstReaderGetDateString(reader), "2026-11-24 13:15:08 UTC");
  fstReaderSetFacProcessMaskAll(reader);
  std::ostringstream text;
  fstReaderIterBlocks2(reader, collect, collect_words, &text, nullptr);
  fstReaderClose(reader);
  const std::string changes = text.str();
  EXPECT_NE(changes.find("20833 1 1\n"), std::string::npos) << changes;
  EXPECT_NE(changes.find("31250 2 xxxxxxxx\n"), std::string::npos) << changes;
  EXPECT_NE(changes.find("41667 2 10100101\n"), std::string::npos) << changes;
  EXPECT_NE(changes.find("41667 3 WAIT_PRM\n"), std::string::npos) << changes;
}

/// All changes of an FST file.
std::string changes_of(const std::string& name) {
  void* reader = fstReaderOpen(name.c_str());
  if (reader == nullptr) return "not readable";
  fstReaderSetFacProcessMaskAll(reader);
  std::ostringstream text;
  fstReaderIterBlocks2(reader, collect, collect_words, &text, nullptr);
  text << "until " << fstReaderGetEndTime(reader);
  fstReaderClose(reader);
  return text.str();
}

/// A wave of some 30 KB as FST: `saves` blocks in all.
void write_long(tb::WaveWriter& wave, int saves) {
  const auto d = wave.wire("D", 32);
  const auto state = wave.words("state");
  unsigned random = 1;
  for (int i = 0; i < 6000; ++i) {
    random = random * 1664525U + 1013904223U;
    wave.set(i * 10, d, static_cast<int>(random & 0x7FFFFFFFU));
    if (i % 100 == 0) wave.say(i * 10, state, "S" + std::to_string(i));
    if (i % (6000 / saves) == 0) wave.save(i * 10 + 5);
  }
}

TEST_F(Waves, FstFullDiskIsAnErrorAtEveryByteAndLeavesNothing) {
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  int refused = 0;
  for (rlim_t bytes = 0;; bytes += bytes < 2000 ? 37 : 1999) {
    const rlimit limit{bytes, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    bool written = true;
    try {
      auto wave = tb::open_wave(path("w.fst"));
      write_long(*wave, 3);
      wave->finish(60'000);
    } catch (const tb::InputError& error) {
      written = false;
      ++refused;
      EXPECT_NE(std::string(error.what()).find("w.fst: cannot be written: File too large"), std::string::npos)
          << bytes << " " << error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    if (written) break;
    ASSERT_TRUE(fs::is_empty(folder_)) << bytes;
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_GT(refused, 60);
  EXPECT_NE(changes_of(path("w.fst")).find("until 5000000"), std::string::npos);
}

TEST_F(Waves, FstInBlocksHoldsTheSameChanges) {
  for (const auto& [name, saves] : {std::pair("one.fst", 1), std::pair("many.fst", 60)}) {
    auto wave = tb::open_wave(path(name));
    write_long(*wave, saves);
    for (int idle = 1; idle < 10; ++idle) wave->save(60'000 + idle * 1000);  // time advances without changes
    wave->set(70'000, 1, 7);
    wave->finish(80'000);
  }
  EXPECT_EQ(changes_of(path("one.fst")), changes_of(path("many.fst")));
  EXPECT_GT(changes_of(path("one.fst")).size(), 100'000U);
}

TEST_F(Waves, LargeFstIsWrittenInBlocksAsItGrows) {
  constexpr unsigned kChanges = 600'000;
  auto wave = tb::open_wave(path("w.fst"));
  const auto wire = wave->wire("wire", 1);
  for (unsigned i = 0; i < kChanges; ++i) wave->set(12 * static_cast<bus::Tick>(i), wire, static_cast<int>(i % 2));
  wave->finish(12 * kChanges);
  EXPECT_EQ(tb::fst_blocks(path("w.fst")).changes, 3U);
  const std::string changes = changes_of(path("w.fst"));
  EXPECT_GE(std::count(changes.begin(), changes.end(), '\n'), static_cast<long>(kChanges));
  EXPECT_NE(changes.find("until 600000000"), std::string::npos) << "in ps";
}

/// Each value with its time, and the end.
std::string told_by(const std::string& path) {
  const auto reader = tb::read_wave(path);
  std::ostringstream text;
  for (tb::WaveEvent event; reader->next(event);)
    text << event.time << " " << event.signal << "=" << event.value << (event.value.empty() ? "!\n" : "\n");
  text << "until " << reader->end() << " e" << reader->declarations().exponent;
  return text.str();
}

/// A simulator's FST, not closed: `wave` and its names beside it, as a killed simulator leaves them.
void write_as_a_killed_simulator(const std::string& wave, const std::string& copy) {
  void* const writer = fstWriterCreate(wave.c_str(), 1);
  fstWriterSetTimescale(writer, -9);
  fstWriterSetVersion(writer, "Some simulator");
  fstWriterSetScope(writer, FST_ST_VCD_MODULE, "top", nullptr);
  const fstHandle bus = fstWriterCreateVar(writer, FST_VT_VCD_REG, FST_VD_IMPLICIT, 4, "bus [3:0]", 0);
  fstWriterCreateVar(writer, FST_VT_VCD_WIRE, FST_VD_IMPLICIT, 4, "port [3:0]", bus);
  const fstHandle level = fstWriterCreateVar(writer, FST_VT_VCD_REAL, FST_VD_IMPLICIT, 8, "level", 0),
                  done = fstWriterCreateVar(writer, FST_VT_VCD_EVENT, FST_VD_IMPLICIT, 1, "done", 0),
                  last = fstWriterCreateVar(writer, FST_VT_VCD_WIRE, FST_VD_IMPLICIT, 1, "last", 0);
  fstWriterSetUpscope(writer);
  for (unsigned i = 0; i < 100; ++i) {
    fstWriterEmitTimeChange(writer, 10 * i);
    fstWriterEmitValueChange(writer, bus, i % 2 != 0 ? "1010" : "01xz");
    const double value = i * 0.5;
    fstWriterEmitValueChange(writer, level, &value);
    if (i % 10 == 5) fstWriterEmitValueChange(writer, done, "1");
    fstWriterEmitValueChange(writer, last, i % 3 != 0 ? "1" : "0");
  }
  fstWriterFlushContext(writer);
  fstWriterEmitTimeChange(writer, 1000);
  for (const char* part : {"", ".hier"}) fs::copy_file(wave + part, copy + part);
  fstWriterClose(writer);
}

TEST_F(Waves, AnotherSimulatorsFstIsRecoveredWithAliasesRealsAndItsUnit) {
  write_as_a_killed_simulator(path("whole.fst"), path("killed.fst"));
  EXPECT_THROW(tb::read_wave(path("killed.fst")), tb::InputError);
  EXPECT_EQ(tb::wave_format(path("killed.fst")), tb::WaveFormat::kFst);
  const tb::Recovered until = tb::recover_fst(path("killed.fst"), path("r.fst"));
  EXPECT_EQ(until.time, 990U);
  EXPECT_EQ(until.exponent, -9);
  const auto reader = tb::read_wave(path("r.fst"));
  ASSERT_EQ(reader->declarations().variables.size(), 5U);
  EXPECT_EQ(reader->declarations().variables[1].name, "port");
  EXPECT_EQ(reader->declarations().variables[1].signal, reader->declarations().variables[0].signal);
  const std::string whole = told_by(path("whole.fst")), recovered = told_by(path("r.fst"));
  EXPECT_NE(recovered.find("990 1=49.5"), std::string::npos) << recovered.substr(0, 500);
  EXPECT_NE(recovered.find("950 2=!"), std::string::npos);
  EXPECT_EQ(recovered.substr(recovered.find("until")), "until 990 e-9");
  EXPECT_EQ(recovered.substr(0, recovered.find("until")), whole.substr(0, whole.find("until")));
}

TEST_F(Waves, AnFstWhoseNamesAreOthersIsRefused) {
  write_as_a_killed_simulator(path("whole.fst"), path("killed.fst"));
  std::string names = read(path("killed.fst.hier"));
  const std::string alias("port [3:0]\0\x04\x01", 13);  // of the first signal
  ASSERT_NE(names.find(alias), std::string::npos);
  names[names.find(alias) + 12] = '\x7f';
  std::ofstream(path("killed.fst.hier"), std::ios::binary) << names;
  try {
    tb::recover_fst(path("killed.fst"), path("r.fst"));
    ADD_FAILURE() << "not refused";
  } catch (const tb::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("killed.fst: has other names beside it"));
  }
  EXPECT_FALSE(fs::exists(path("r.fst")));
}

TEST_F(Waves, AnotherSimulatorsVcdIsRecoveredUpToItsLastGoodTime) {
  const std::string head =
      "$date today $end\n$version Some simulator $end\n$timescale 10ns $end\n$scope module t $end\n$var wire 1 !! a "
      "$end\n$var wire 1 ! b $end\n$upscope $end\n$enddefinitions $end\n";
  const std::string whole = head + "#0\n0!!\n$comment\n# $end\n#5\n1!!\n#17\n0!!\n1!\n#123\n1!!\n#1234\n0!!\n";
  const std::vector<std::pair<std::uint64_t, std::string>> kChanges = {
      {0, "0=0"}, {5, "0=1"}, {17, "0=0"}, {17, "1=1"}, {123, "0=1"}};
  std::set<std::uint64_t> ends;
  for (std::size_t size = whole.find("#5") + 2; size <= whole.size(); ++size) {
    std::ofstream(path("cut"), std::ios::binary) << whole.substr(0, size);
    ASSERT_EQ(tb::wave_format(path("cut")), tb::WaveFormat::kVcd);
    const tb::Recovered until = tb::recover_vcd(path("cut"), path("r.vcd"));
    EXPECT_EQ(until.exponent, -8);
    const std::string told = told_by(path("r.vcd"));
    const std::string changes = told.substr(0, told.find("until"));
    EXPECT_EQ(told.substr(changes.size()), "until " + std::to_string(until.time) + " e-8");
    std::string before;
    for (const auto& [time, change] : kChanges)
      if (time <= until.time) before += std::to_string(time) + " " + change + "\n";
    EXPECT_EQ(changes, before) << size;
    ends.insert(until.time);
  }
  EXPECT_THAT(ends, testing::ElementsAre(4, 16, 122, 1233)) << "the unit before each time";
  std::ofstream(path("junk"), std::ios::binary) << whole << std::string(100, '\0');
  EXPECT_EQ(tb::recover_vcd(path("junk"), path("r.vcd")).time, 1233U) << "the end of a file after a loss of power";
  std::ofstream(path("junk"), std::ios::binary) << head << "#0\n0!!\n#5\n#17\ngarbage\n#123\n";
  EXPECT_EQ(tb::recover_vcd(path("junk"), path("r.vcd")).time, 16U);
}

TEST_F(Waves, AGzThatWasCutIsRecoveredUpToItsEnd) {
  std::string text = "$timescale 1ps $end\n$var wire 1 ! a $end\n$enddefinitions $end\n";
  for (int i = 0; i < 100'000; ++i) text += "#" + std::to_string(i) + "\n" + std::to_string(i % 3 == 0) + "!\n";
  const std::string gz = packed(text);
  std::ofstream(path("cut.gz"), std::ios::binary) << gz.substr(0, gz.size() / 2);
  ASSERT_EQ(tb::wave_format(path("cut.gz")), tb::WaveFormat::kVcd);
  EXPECT_GT(tb::recover_vcd(path("cut.gz"), path("r.vcd")).time, 30'000U);
  const std::string recovered = read(path("r.vcd"));
  EXPECT_EQ(recovered, text.substr(0, recovered.size()));
}

TEST_F(Waves, RecoveredIsEverythingUpToTheLastSave) {
  for (const std::string ending : {".vcd", ".fst"}) {
    auto wave = tb::open_wave(path("w" + ending));
    write_long(*wave, 6);  // the last at 50005 ticks
    std::string part;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().extension() == ".part") part = entry.path();
    const auto recover = ending == ".fst" ? tb::recover_fst : tb::recover_vcd;
    const std::uint64_t until = recover(part, path("r" + ending)).time;
    EXPECT_GE(until, tb::picoseconds(50'000) - 1) << ending << ": the last time of a VCD may lack changes";
    EXPECT_TRUE(fs::exists(part)) << "it stays";
    wave->finish(60'000);
    const auto all = [&](const std::string& name) { return ending == ".fst" ? changes_of(name) : read(name); };
    std::string recovered = all(path("r" + ending));
    const std::string whole = all(path("w" + ending));
    recovered.resize(ending == ".fst" ? recovered.find("until") : recovered.rfind('#'));
    EXPECT_EQ(whole.substr(0, recovered.size()), recovered) << ending;
    EXPECT_GT(recovered.size(), whole.size() * 5 / 6 - 1000) << ending;
    fs::remove(folder_ / ("w" + ending));
    fs::remove(folder_ / ("r" + ending));
    EXPECT_TRUE(fs::is_empty(folder_)) << ending;
  }
}

TEST_F(Waves, ChangeAtTheTimeOfASaveIsRecoveredAfterTheNext) {
  auto wave = tb::open_wave(path("w.fst"));
  write_long(*wave, 1);
  wave->set(60'000, 1, 5);
  wave->save(60'000);
  wave->save(61'000);
  std::string part;
  for (const auto& entry : fs::directory_iterator(folder_))
    if (entry.path().extension() == ".part") part = entry.path();
  EXPECT_GE(tb::recover_fst(part, path("r.fst")).time, tb::picoseconds(60'000));
}

TEST_F(Waves, WhatIsNoPartIsNotRecovered) {
  const auto refusal = [&](const std::string& name) -> std::string {
    try {
      if (tb::wave_format(path(name)) == tb::WaveFormat::kFst) tb::recover_fst(path(name), path("out"));
      return "none";
    } catch (const tb::InputError& error) {
      return error.what();
    }
  };
  auto wave = tb::open_wave(path("w.fst"));
  write_example(*wave);
  wave->finish(750);
  EXPECT_NE(refusal("w.fst").find("is complete"), std::string::npos);
  const std::string whole = read(path("w.fst"));
  std::ofstream(path("cut.fst")) << whole.substr(0, 400);
  EXPECT_NE(refusal("cut.fst").find("holds no changes yet"), std::string::npos);
  const std::size_t names = whole.rfind('\x06');
  std::ofstream(path("nameless.fst")) << whole.substr(0, names);
  EXPECT_NE(refusal("nameless.fst").find("needs " + path("nameless.fst") + ".hier"), std::string::npos);
  std::ofstream(path("text")) << "no wave";
  EXPECT_NE(refusal("text").find("is no wave, expected the VCD or FST"), std::string::npos);
  EXPECT_NE(refusal("none").find("is no file"), std::string::npos);
  // A block of changes with its inside turned to junk ends fstapi's reader, not this program.
  std::string damaged = whole.substr(0, names);
  for (std::size_t i = 360; i < damaged.size(); ++i) damaged[i] = static_cast<char>(damaged[i] ^ 0x5A);
  std::ofstream(path("damaged.fst")) << damaged;
  std::ofstream(path("damaged.fst.hier")) << "";
  EXPECT_NE(refusal("damaged.fst"), "none");
  EXPECT_FALSE(fs::exists(path("out")));
}
#endif

}  // namespace
}  // namespace dsdpv1
