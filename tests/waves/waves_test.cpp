// Waves: exact times, X and Z, complete or absent files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#ifdef DSDPV1_WITH_FST
#include <fstapi.h>
#endif

#include "tb/scenario/input_error.hpp"
#include "tb/waves/wave_writer.hpp"

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
            "$version dsdpv1-sim $end\n$timescale 1 ps $end\n$scope module demo $end\n"
            "$var wire 1 ! L_REQ $end\n$var wire 8 \" D [7:0] $end\n$var string 1 # dp_state $end\n$upscope $end\n"
            "$enddefinitions $end\n#0\n0!\nbzzzzzzzz \"\nsOFFLINE #\n#20833\n1!\n#31250\nbxxxxxxxx \"\n#41667\n"
            "b10100101 \"\nsWAIT_PRM #\n#62500\n");
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
  auto wave = tb::open_wave(path("w.fst"));
  write_example(*wave);
  wave->finish(750);
  void* reader = fstReaderOpen(path("w.fst").c_str());
  ASSERT_NE(reader, nullptr);
  EXPECT_EQ(fstReaderGetEndTime(reader), 62500U);
  EXPECT_EQ(fstReaderGetTimescale(reader), -12);
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
#endif

}  // namespace
