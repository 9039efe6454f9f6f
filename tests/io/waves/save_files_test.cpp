// Viewer files beside a wave: their signals, order, and names.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "io/waves/save_files.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;

class SaveFiles : public testing::Test {
 public:
  SaveFiles() { fs::create_directories(folder_); }
  ~SaveFiles() override { fs::remove_all(folder_); }

 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream in(path(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// GTKWave's arguments after the file's name.
  std::string gtkwave() const {
    const std::string text = read("my.gtkw");
    return text.substr(text.find("[timestart]"));
  }
  void write(const std::string& declarations) const {
    std::ofstream(path("my.vcd")) << "$timescale 1 ps $end\n" << declarations << "$enddefinitions $end\n#0\n";
    tb::write_save_files(path("my.vcd"), {{"handshake", {"R_REQ", "L_REQ"}}, {"host", {"A"}}, {"none", {"X"}}});
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("dsdpv1_save_" + std::to_string(::getpid()) +
                                                  testing::UnitTest::GetInstance()->current_test_info()->name());
};

constexpr const char* kStation =
    "$scope module demo $end\n$var wire 1 ! L_REQ $end\n$var wire 11 # A [10:0] $end\n$var wire 1 $ R_REQ $end\n"
    "$var string 1 % dp_state $end\n"
    "$scope module rtl $end\n$var wire 8 & count_q [7:0] $end\n"
    "$scope module deep $end\n$var wire 1 ' hidden $end\n$upscope $end\n$upscope $end\n$upscope $end\n";

TEST_F(SaveFiles, GroupsComeInTheirOrderThenWhatIsInNoneThenScopes) {
  write(kStation);
  EXPECT_EQ(
      gtkwave(),
      "[timestart] 0\n*-31.0 -1\n@800200\n-demo\n@200\n-handshake\n@28\ndemo.R_REQ\n@28\ndemo.L_REQ\n@200\n-host\n"
      "@22\ndemo.A[10:0]\n@200\n-states\n@28\ndemo.dp_state\n@800200\n-rtl\n@22\ndemo.rtl.count_q[7:0]\n"
      "@1000200\n-rtl\n@1000200\n-demo\n");
  EXPECT_EQ(read("my.sucl"),
            "divider_add demo:handshake\nvariable_add demo.R_REQ\nvariable_add demo.L_REQ\n"
            "divider_add demo:host\nvariable_add demo.A\ndivider_add demo:states\nvariable_add demo.dp_state\n"
            "divider_add demo:rtl\nvariable_add demo.rtl.count_q\nzoom_fit\n");
}

TEST_F(SaveFiles, ClockIsFirstAndScopeWithoutGroupsIsAsDeclared) {
  write(
      "$scope module plc $end\n$var string 1 ! b $end\n$var string 1 # a $end\n$upscope $end\n"
      "$scope module clock $end\n$var wire 1 $ CLK $end\n$upscope $end\n");
  EXPECT_EQ(gtkwave(),
            "[timestart] 0\n*-31.0 -1\n@800200\n-clock\n@28\nclock.CLK\n@1000200\n-clock\n"
            "@800200\n-plc\n@28\nplc.b\n@28\nplc.a\n@1000200\n-plc\n");
}

TEST_F(SaveFiles, NameIsThatOfTheWaveWithAnEndingOfItsOwn) {
  const tb::SaveFiles files = tb::save_files_of("out/a.b.fst");
  EXPECT_EQ(files.gtkwave, "out/a.b.gtkw");
  EXPECT_EQ(files.surfer, "out/a.b.sucl");
}

}  // namespace
}  // namespace dsdpv1
