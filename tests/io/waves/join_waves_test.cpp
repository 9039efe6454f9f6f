// Several waves as one: scopes, aliases, the beginning and the end of the first.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "io/input/input_error.hpp"
#include "io/waves/join_waves.hpp"
#include "io/waves/wave_writer.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;

class JoinWaves : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dsdpv1_join_" + std::to_string(::getpid()) +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
    return path(name);
  }
  std::string model() const {
    return written("model.vcd",
                   "$timescale 1 ps $end\n$scope module demo $end\n$var wire 1 ! READY $end\n"
                   "$var string 1 # state $end\n$upscope $end\n$enddefinitions $end\n"
                   "#100\n0!\nsOFFLINE #\n#300\n1!\n#500\n");
  }
  std::string rtl() const {
    return written("rtl.vcd",
                   "$timescale 1 ps $end\n$scope module TOP $end\n$var wire 1 a ready_o $end\n"
                   "$scope module chip $end\n$var wire 1 a ready_o $end\n$var wire 8 b count_q [7:0] $end\n"
                   "$upscope $end\n$upscope $end\n$enddefinitions $end\n"
                   "#0\n0a\nb00000001 b\n#50\nb00000010 b\n#300\nb00000011 b\n#400\n1a\n#600\n0a\n");
  }
  static std::string read(const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder_;
};

TEST_F(JoinWaves, SecondStandsInTheScopeThatIsGivenAndKeepsToTheTimesOfTheFirst) {
  tb::join_waves({{model(), "", ""}, {rtl(), "TOP", "demo.rtl"}}, path("both.vcd"));
  EXPECT_EQ(read(path("both.vcd")),
            "$version dsdpv1-sim " DSDPV1_VERSION
            " $end\n$timescale 1 ps $end\n"
            "$scope module demo $end\n$var wire 1 % READY $end\n$var string 1 ~& state $end\n"
            "$scope module rtl $end\n$var wire 1 ' ready_o $end\n"
            "$scope module chip $end\n$var wire 1 ' ready_o $end\n$var wire 8 ( count_q [7:0] $end\n$upscope $end\n"
            "$upscope $end\n$upscope $end\n$enddefinitions $end\n"
            "#100\n0'\nb00000010 (\n0%\nsOFFLINE ~&\n#300\n1%\nb00000011 (\n#400\n1'\n#500\n");
}

#ifdef DSDPV1_WITH_FST
TEST_F(JoinWaves, FstHasTheSameAsVcd) {
  tb::join_waves({{model(), "", ""}, {rtl(), "TOP", "demo.rtl"}}, path("both.fst"));
  tb::join_waves({{path("both.fst"), "", ""}}, path("again.vcd"));
  tb::join_waves({{model(), "", ""}, {rtl(), "TOP", "demo.rtl"}}, path("both.vcd"));
  const std::string declared = read(path("both.vcd"));
  EXPECT_EQ(read(path("again.vcd")).substr(0, declared.find("#100")), declared.substr(0, declared.find("#100")));
  EXPECT_NE(read(path("again.vcd")).find("#300\n"), std::string::npos);
  EXPECT_NE(read(path("again.vcd")).find("#400\n1'\n#500\n"), std::string::npos);
}
#endif

TEST_F(JoinWaves, PartOfAnotherTimeScaleIsRefusedAndNothingIsWritten) {
  const std::string other =
      written("ns.vcd", "$timescale 1 ns $end\n$var wire 1 ! A $end\n$enddefinitions $end\n#0\n0!\n");
  try {
    tb::join_waves({{model(), "", ""}, {other, "", "x"}}, path("both.vcd"));
    FAIL();
  } catch (const tb::InputError& error) {
    EXPECT_EQ(error.what(), other + ": is a wave of another time scale, expected picoseconds");
  }
  EXPECT_FALSE(fs::exists(path("both.vcd")));
}

}  // namespace
}  // namespace dsdpv1
