// Reads waves: the output of simulators, with its peculiarities, and invalid files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/input/input_error.hpp"
#include "io/waves/wave_reader.hpp"
#include "io/waves/wave_writer.hpp"
#ifdef DSDPV1_WITH_FST
#include "tests/io/waves/gz.hpp"
#endif

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class ReadWaves : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dsdpv1_read_waves_" + std::to_string(::getpid()) +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string file(const std::string& text, const std::string& name = "w.vcd") const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  /// "scope.name [range] kind width signal".
  static std::vector<std::string> variables(const tb::WaveReader& reader) {
    std::vector<std::string> lines;
    const tb::WaveDeclarations& all = reader.declarations();
    for (const tb::WaveVariable& each : all.variables) {
      const tb::WaveSignal& signal = all.signals[each.signal];
      std::string line = all.scopes[each.scope] + "|" + each.name;
      if (each.range) line += "[" + std::to_string(each.range->first) + ":" + std::to_string(each.range->second) + "]";
      line += signal.kind == tb::WaveKind::kBits   ? " " + std::to_string(signal.width)
              : signal.kind == tb::WaveKind::kReal ? " real"
              : signal.kind == tb::WaveKind::kText ? " text"
                                                   : " event";
      lines.push_back(line + " #" + std::to_string(each.signal));
    }
    return lines;
  }
  static std::vector<std::string> events(tb::WaveReader& reader) {
    std::vector<std::string> lines;
    for (tb::WaveEvent event; reader.next(event);) {
      const std::string at = std::to_string(event.time) + " ";
      if (event.kind == tb::WaveEvent::Kind::kOff) lines.push_back(at + "off");
      if (event.kind == tb::WaveEvent::Kind::kOn) lines.push_back(at + "on");
      if (event.kind == tb::WaveEvent::Kind::kTrigger) lines.push_back(at + std::to_string(event.signal) + "!");
      if (event.kind == tb::WaveEvent::Kind::kChange)
        lines.push_back(at + std::to_string(event.signal) + "=" + std::string(event.value));
    }
    return lines;
  }
  /// A reader's error for a rejected file, without the folder.
  std::string refusal(const std::string& name) const {
    try {
      const auto reader = tb::read_wave(path(name));
      events(*reader);
      return "none";
    } catch (const tb::InputError& error) {
      const std::string text = error.what();
      return text.rfind(folder_.string(), 0) == 0 ? text.substr(folder_.string().size() + 1) : text;
    }
  }
  std::string refusal_of(const std::string& text) const {
    file(text, "w");
    return refusal("w");
  }
  fs::path folder_;
};

const std::string kHead =
    "$timescale 1ns $end $scope module t $end $var wire 1 ! a $end $var wire 4 # b [3:0] $end "
    "$var real 64 % r $end $upscope $end $enddefinitions $end\n";

TEST_F(ReadWaves, IcarusNamesAliasesAndEscapedIdentifiers) {
  const auto reader = tb::read_wave(
      file("$date\n\tMon\n$end\n$version\n\tIcarus Verilog\n$end\n$timescale\n\t100ps\n$end\n$scope module i $end\n"
           "$scope module u $end\n$var reg 4 ! \\mem[0] [3:0] $end\n$upscope $end\n$upscope $end\n"
           "$scope module i $end\n$var event 1 \" e $end\n$var wire 1 # q $end\n$var reg 1 $ \\a.b $end\n"
           "$var reg 1 % \\esc[3] $end\n$var reg 4 ' up [0:3] $end\n$var integer 32 * n [31:0] $end\n"
           "$scope module u $end\n$var wire 1 # q $end\n$upscope $end\n$upscope $end\n$enddefinitions $end\n"));
  EXPECT_EQ(reader->declarations().exponent, -10);
  EXPECT_THAT(variables(*reader), ElementsAre("i.u|mem[0][3:0] 4 #0", "i|e event #1", "i|q 1 #2", "i|a.b 1 #3",
                                              "i|esc[3] 1 #4", "i|up[0:3] 4 #5", "i|n[31:0] 32 #6", "i.u|q 1 #2"));
}

TEST_F(ReadWaves, VerilatorAndGhdlPutRangesAtTheName) {
  const auto reader = tb::read_wave(
      file("$timescale 1 fs $end $scope module g $end $var reg 8 ! v[7:0] $end $var wire 1 \" bit[3] $end "
           "$var wire 8 # mem[2][7:0] $end $var wire 8 % mem[3] $end $var string 1 & st $end $comment st is not "
           "handled $end $upscope $end $enddefinitions $end\n"));
  EXPECT_EQ(reader->declarations().exponent, -15);
  EXPECT_THAT(variables(*reader),
              ElementsAre("g|v[7:0] 8 #0", "g|bit[3:3] 1 #1", "g|mem[2][7:0] 8 #2", "g|mem[3] 8 #3", "g|st text #4"));
}

TEST_F(ReadWaves, ShortVectorsAreExtendedToTheLeft) {
  const auto reader = tb::read_wave(file(kHead + "#0\nb1 #\nb0 #\nbx #\nbz1 #\nbX0 #\nb10110 #\nx#\n"));
  EXPECT_THAT(events(*reader),
              ElementsAre("0 1=0001", "0 1=0000", "0 1=xxxx", "0 1=zzz1", "0 1=xxx0", "0 1=0110", "0 1=xxxx"));
}

TEST_F(ReadWaves, NineValuesOfVhdlAreFour) {
  const auto reader = tb::read_wave(file(kHead + "#5\nH!\nL!\nU!\n-!\nbUXLH #\nbZW-1 #\n"));
  EXPECT_THAT(events(*reader), ElementsAre("5 0=1", "5 0=0", "5 0=x", "5 0=x", "5 1=xx01", "5 1=zxx1"));
  EXPECT_EQ(reader->begin(), 5U);
}

TEST_F(ReadWaves, PausesRealsAndTheLastTimeAreTold) {
  const auto reader = tb::read_wave(
      file(kHead + "#0\n$dumpvars\nr1e-30 %\n0!\n$end\n#7\n$dumpoff\nx!\n$end\n#9\n$dumpon\n1!\n$end\n$comment 1! "
                   "$end\n#12\n"));
  EXPECT_THAT(events(*reader), ElementsAre("0 2=1e-30", "0 0=0", "7 off", "7 0=x", "9 on", "9 0=1"));
  EXPECT_EQ(reader->end(), 12U);
}

TEST_F(ReadWaves, OnlyWhatIsSelectedIsTold) {
  const auto reader = tb::read_wave(file(kHead + "#0\n0!\nb1 #\n#1\n1!\n"));
  reader->select({false, true, false});
  EXPECT_THAT(events(*reader), ElementsAre("0 1=0001"));
}

TEST_F(ReadWaves, LongCodesAreSignalsOfTheirOwn) {
  const auto reader = tb::read_wave(
      file("$var wire 1 aaaa a $end $var wire 1 aaaaaaaaaaaab b $end $var wire 1 aa c $end $enddefinitions $end\n"
           "#0\n1aaaa\n0aaaaaaaaaaaab\nzaa\n"));
  EXPECT_EQ(reader->declarations().exponent, -9) << "without a $timescale";
  EXPECT_THAT(events(*reader), ElementsAre("0 0=1", "0 1=0", "0 2=z"));
}

TEST_F(ReadWaves, ChangesAcrossTheEndOfABufferAreWhole) {
  std::string text = "$var wire 64 ! a $end $var wire 1 long_code b $end $enddefinitions $end\n";
  std::size_t changes = 0;
  for (; text.size() < (std::size_t{18} << 20U); ++changes)
    text += "#" + std::to_string(changes) + "\nb" + std::string(1 + changes % 64, '1') + " !\n" +
            std::string(changes % 7, ' ') + "1long_code\n";
  const auto reader = tb::read_wave(file(text));
  std::size_t seen = 0;
  for (tb::WaveEvent event; reader->next(event); ++seen) {
    ASSERT_EQ(event.time, seen / 2);
    const std::string value = std::string(63 - event.time % 64, '0') + std::string(1 + event.time % 64, '1');
    ASSERT_EQ(event.value, seen % 2 == 0 ? value : "1");
  }
  EXPECT_EQ(seen, 2 * changes);
}

TEST_F(ReadWaves, ATextWithoutANewlineAtItsEndIsWholeIfItsLastWordIs) {
  for (const char* last : {"#12", "1!", "b10 #", "$dumpoff", "x!\n$end"}) {
    file(kHead + "#5\n0!\nb0 #\n" + last);
    EXPECT_EQ(refusal("w.vcd"), "none") << last;
  }
  const std::string many =
      "$var wire 1 ! a $end $var wire 1 !! b $end $var wire 1 abcd c $end $var wire 1 abc d $end $enddefinitions "
      "$end\n#0\n0!\n";
  for (const char* cut : {"1!", "1abc", "b1 !", "b1", "#", "1", "$dumpo", "$comment"})
    EXPECT_THAT(refusal_of(many + cut), HasSubstr("ends within")) << cut << ": may be cut";
  EXPECT_EQ(refusal_of(many + "1!!"), "none");
  EXPECT_EQ(refusal_of(many + "1abcd"), "none");
}

TEST_F(ReadWaves, EscapesInTextsAreTheirCharacters) {
  const auto reader = tb::read_wave(file(
      "$var string 1 s s $end $enddefinitions $end\n#0\nsa\\040b\\x20\\'\\\"\\? s\ns\\\\040\\n\\7 s\ns\\q\\x\\ s\n"));
  EXPECT_THAT(events(*reader), ElementsAre("0 0=a b '\"?", "0 0=\\040\n\a", "0 0=\\q\\x\\"));
  const auto wave = tb::open_wave(path("own.vcd"));
  const auto words = wave->words("w");
  wave->say(0, words, "a\\040b");
  wave->finish(12'000);
  EXPECT_THAT(events(*tb::read_wave(path("own.vcd"))), ElementsAre("0 0=a\\040b")) << "as it was written";
}

TEST_F(ReadWaves, EventsAreMomentsWithoutAValue) {
  const auto reader =
      tb::read_wave(file("$scope module t $end $var event 1 e done $end $upscope $end $enddefinitions "
                         "$end\n#0\nxe\n#5\n1e\n#9\n1e\n"));
  EXPECT_THAT(variables(*reader), ElementsAre("t|done event #0"));
  EXPECT_THAT(events(*reader), ElementsAre("5 0!", "9 0!"));
}

TEST_F(ReadWaves, WavesOfOtherFormsAreNamed) {
  EXPECT_THAT(refusal_of("GHDLwave\n\x10\x01"),
              HasSubstr("w: is GHW of GHDL, expected VCD or FST, as ghdl -r TOP --fst"));
  EXPECT_THAT(refusal_of(std::string("\x13\x80\x00\x01", 4)), HasSubstr("w: is LXT2, expected VCD or FST: lxt2vcd"));
  EXPECT_THAT(refusal_of(std::string("\x01\x38\x00\x04", 4)), HasSubstr("w: is LXT, expected VCD or FST"));
  EXPECT_THAT(refusal_of(std::string("VZ\x00\x01", 4)), HasSubstr("w: is VZT, expected VCD or FST: vzt2vcd"));
  EXPECT_THAT(refusal_of("PK\x03\x04"), HasSubstr("w: is an archive, perhaps a session of sigrok"));
}

TEST_F(ReadWaves, DamagedVcdIsRefusedInOneLine) {
  EXPECT_THAT(refusal_of(""), HasSubstr("w: is empty, expected a wave"));
  EXPECT_THAT(refusal("none"), HasSubstr("none: no such file, expected a wave"));
  fs::create_directory(path("folder"));
  EXPECT_THAT(refusal("folder"), HasSubstr("folder: is a folder"));
  EXPECT_THAT(refusal_of("hello\n"), HasSubstr("w:1: \"hello\" stands where a declaration of a VCD should"));
  EXPECT_THAT(refusal_of("\x7f"
                         "ELF\x02\x01"),
              HasSubstr("w:1: "));
  EXPECT_THAT(refusal_of("$date\n" + std::string(3, '\0')), HasSubstr("w:2: has a zero byte here"));
  EXPECT_THAT(refusal_of("$date today\n$end\n"), HasSubstr("w:3: ends within its declarations"));
  EXPECT_THAT(refusal_of(kHead + "#20\n1!\n#12"), HasSubstr("w:4: ends within a line"));
  EXPECT_THAT(refusal_of(kHead + "#0\nb10"), HasSubstr("w:3: ends within a line"));
  EXPECT_THAT(refusal_of(kHead + "#5\n#4\n"), HasSubstr("w:3: time 4 comes after 5"));
  EXPECT_THAT(refusal_of(kHead + "#99999999999999999999\n"), HasSubstr("is no time"));
  EXPECT_THAT(refusal_of(kHead + "#0\n1?\n"), HasSubstr("w:3: a value of \"?\", expected the codes"));
  EXPECT_THAT(refusal_of(kHead + "#0\n2!\n"), HasSubstr("w:3: \"2!\" is no change"));
  EXPECT_THAT(refusal_of(kHead + "#0\nb12 #\n"), HasSubstr("\"b12\" is no change"));
  EXPECT_THAT(refusal_of(kHead + "#0\npH 0 6 !\n"), HasSubstr("\"pH\" is no change"));
  EXPECT_THAT(refusal_of("$timescale 3 ns $end\n"), HasSubstr("$timescale is 3 ns, expected 1, 10 or 100 fs"));
  EXPECT_THAT(refusal_of("$var wire 99999999 ! a $end "), HasSubstr("$var has the size 99999999, expected 0 to"));
  EXPECT_THAT(refusal_of("$var port 1 ! a $end "), HasSubstr("is an extended VCD"));
  EXPECT_THAT(refusal_of("$var port [7:0] <0 a $end "), HasSubstr("is an extended VCD"));
  EXPECT_THAT(refusal_of("$upscope $end "), HasSubstr("$upscope without a $scope"));
  EXPECT_THAT(refusal_of(std::string(8U << 20U, 'a') + std::string(1U << 20U, 'a')),
              HasSubstr("longer than any right one"));
}

#ifdef DSDPV1_WITH_FST
TEST_F(ReadWaves, AGzIsWhatItHolds) {
  std::string text = kHead;
  for (int i = 0; i < 400'000; ++i) text += "#" + std::to_string(i) + "\nb" + std::to_string(i % 2) + " #\n";
  const std::string gz = packed(text);
  std::size_t seen = 0;
  const auto reader = tb::read_wave(file(gz, "w.vcd.gz"));
  for (tb::WaveEvent event; reader->next(event);) ASSERT_EQ(event.time, seen++);
  EXPECT_EQ(seen, 400'000U);
  EXPECT_EQ(reader->share(), 1.0);
  const std::string half = text.substr(0, text.size() / 2), rest = text.substr(text.size() / 2);
  file(packed(half) + packed(rest) + std::string(512, '\0'), "w");
  EXPECT_EQ(refusal("w"), "none") << "several in one file, and padding";
  EXPECT_THAT(refusal_of(gz.substr(0, gz.size() / 2)), HasSubstr("w: is a gz that was cut"));
  EXPECT_THAT(refusal_of(gz.substr(0, gz.size() - 1)), HasSubstr("w: is a gz that was cut"));
  std::string damaged = gz;
  damaged[gz.size() / 2] = static_cast<char>(damaged[gz.size() / 2] ^ 0x55);
  EXPECT_NE(refusal_of(damaged), "none");
  EXPECT_THAT(refusal_of(packed(std::string(400, '\0'))), HasSubstr("w: is an FST within a gz"));
}

void write_example(const std::string& path) {
  const auto wave = tb::open_wave(path);
  wave->open_scope("demo");
  const auto bit = wave->wire("L_REQ", 1), byte = wave->wire("D", 8), state = wave->words("dp_state");
  wave->close_scope();
  wave->set(0, bit, 0);
  wave->set(0, byte, tb::WaveWriter::kReleased);
  wave->say(0, state, "OFFLINE");
  wave->set(250, bit, 1);
  wave->set(375, byte, tb::WaveWriter::kUnknown);
  wave->set(500, byte, 0xA5);
  wave->say(500, state, "WAIT_PRM");
  for (int i = 0; i < 5000; ++i) wave->set(1000 + i * 10, byte, i & 0xFF);
  wave->finish(60'000);
}

TEST_F(ReadWaves, FstTellsWhatTheVcdOfTheSameRunDoes) {
  for (const char* name : {"w.vcd", "w.fst"}) write_example(path(name));
  const auto vcd = tb::read_wave(path("w.vcd")), fst = tb::read_wave(path("w.fst"));
  EXPECT_EQ(vcd->declarations().exponent, fst->declarations().exponent);
  EXPECT_EQ(variables(*vcd), variables(*fst));
  std::vector<std::string> of_vcd = events(*vcd), of_fst = events(*fst);
  for (auto* of_one : {&of_vcd, &of_fst}) std::sort(of_one->begin(), of_one->end());  // at one time in any order
  EXPECT_EQ(of_vcd, of_fst);
  EXPECT_EQ(vcd->end(), fst->end());
}

TEST_F(ReadWaves, FstThatIsNotReadToItsEndLeavesNoProcess) {
  write_example(path("w.fst"));
  const auto reader = tb::read_wave(path("w.fst"));
  tb::WaveEvent event;
  EXPECT_TRUE(reader->next(event));
}

TEST_F(ReadWaves, FstThatWasCutOrDamagedIsRefusedWhereverThatIs) {
  write_example(path("w.fst"));
  std::ifstream in(path("w.fst"), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 40) {
    file(whole.substr(0, size), "cut.fst");
    EXPECT_THAT(refusal("cut.fst"), HasSubstr("cut.fst: ")) << size;
  }
  int refused = 0;
  for (std::size_t at = 330; at < whole.size(); at += 97) {
    std::string damaged = whole;
    for (std::size_t i = at; i < std::min(at + 8, damaged.size()); ++i)
      damaged[i] = static_cast<char>(damaged[i] ^ 0x5A);
    file(damaged, "damaged.fst");
    const std::string said = refusal("damaged.fst");
    if (said == "none") continue;  // these bytes were values, which can be others
    EXPECT_THAT(said,
                testing::MatchesRegex("damaged.fst: is an FST that (was cut|is damaged), expected a complete one.*"))
        << at;
    ++refused;
  }
  EXPECT_GT(refused, 3);
  EXPECT_THAT(refusal_of(std::string(400, '\0')), HasSubstr("w: is no wave, expected VCD and FST"));
}
#endif

}  // namespace
}  // namespace dsdpv1
