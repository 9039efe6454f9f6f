// What programming environments send to gdb at a launch, word for word: the blocks after <!-- gdb: NAME --> in
// docs/arm_board.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "gdb_bench.hpp"

namespace dsdpv1::arm::test {
namespace {

using testing::HasSubstr;
using testing::Not;

void replace(std::string& text, const std::string& old, const std::string& now) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size()))
    text.replace(at, old.size(), now);
}

/// The lines of a block, with this program and port.
std::vector<std::string> commands(const std::string& name, int port) {
  std::ifstream file(ARM_BOARD_PAGE);
  std::stringstream page;
  page << file.rdbuf();
  const std::string mark = "<!-- gdb: " + name + " -->\n```\n";
  const std::size_t begin = page.str().find(mark);
  if (begin == std::string::npos) {
    ADD_FAILURE() << "docs/arm_board.md has no block " << name;
    return {};
  }
  std::string block = page.str().substr(begin + mark.size());
  block.resize(block.find("```"));
  replace(block, "my.elf", LOOP_ELF);
  replace(block, "localhost:3333", "localhost:" + std::to_string(port));
  std::vector<std::string> lines;
  std::stringstream text(block);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// gdb as an environment starts it. It ends with this object.
class MiGdb {
 public:
  MiGdb();
  ~MiGdb();
  MiGdb(const MiGdb&) = delete;
  MiGdb& operator=(const MiGdb&) = delete;

  /// What gdb says, up to its result; if that is ^running, up to the next halt.
  std::string execute(const std::string& command);
  /// All of these; the first that fails is the last.
  std::string execute(const std::vector<std::string>& all);

 private:
  int socket_ = -1;
  std::FILE* from_gdb_ = nullptr;
  pid_t process_ = -1;
};

MiGdb::MiGdb() {
  std::array<int, 2> ends{};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  process_ = ::fork();
  if (process_ == 0) {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(ends[1], descriptor);
    ::execlp("timeout", "timeout", "300", GDB, "-nx", "-q", "--interpreter=mi2", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  from_gdb_ = ::fdopen(socket_, "r");
}

MiGdb::~MiGdb() {
  ::shutdown(socket_, SHUT_WR);
  ::waitpid(process_, nullptr, 0);
  std::fclose(from_gdb_);
}

std::string MiGdb::execute(const std::string& command) {
  const std::string line = command + "\n";
  EXPECT_EQ(::send(socket_, line.data(), line.size(), MSG_NOSIGNAL), static_cast<ssize_t>(line.size()));
  std::string text;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), from_gdb_) != nullptr) {
    const std::string said = buffer.data();
    text += said;
    const bool halted = said.rfind("*stopped", 0) == 0 && text.find("^running") != std::string::npos;
    if (halted || (said.front() == '^' && said.rfind("^running", 0) != 0)) return text;
  }
  ADD_FAILURE() << "gdb has gone: " << command << "\n" << text;
  return text;
}

std::string MiGdb::execute(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& command : all) {
    text += execute(command);
    if (text.find("^error") == std::string::npos) continue;
    ADD_FAILURE() << command << "\n" << text;
    break;
  }
  return text;
}

constexpr const char* kAtMain = R"(addr="0x08000010",func="loop")";  // main is another name of loop
constexpr const char* kAtReset = R"(value="0x8000008)";

class GdbLaunch : public testing::Test {
 protected:
  void SetUp() override { bench.start(); }
  std::string launch(const std::string& name) { return gdb.execute(commands(name, bench.port())); }

  GdbBench bench;
  MiGdb gdb;
};

TEST_F(GdbLaunch, CortexDebugLaunchesRestartsAndLeaves) {
  const std::string text = launch("cortex-debug, launch");
  EXPECT_THAT(text, HasSubstr("reset, halted before the first instruction"));
  EXPECT_THAT(text, HasSubstr("+download"));
  EXPECT_THAT(text, HasSubstr(kAtMain));
  EXPECT_THAT(gdb.execute("-data-evaluate-expression $r0"), HasSubstr(R"(value="0")"));
  EXPECT_THAT(gdb.execute(std::vector<std::string>{"-exec-next-instruction", "-exec-next-instruction"}),
              HasSubstr("end-stepping-range"));
  EXPECT_THAT(launch("cortex-debug, reset"), HasSubstr(kAtMain));
  EXPECT_THAT(gdb.execute("-data-evaluate-expression $r0"), HasSubstr(R"(value="0")")) << "from the beginning";
  launch("cortex-debug, disconnect");
  EXPECT_FALSE(bench.target.ended());
  EXPECT_EQ(bench.said().size(), 1U) << "gdb has detached";
}

TEST_F(GdbLaunch, CortexDebugAttaches) {
  const std::string text = launch("cortex-debug, attach");
  EXPECT_THAT(text, HasSubstr("halted at 0x08000008"));
  EXPECT_THAT(gdb.execute("-data-evaluate-expression $pc"), HasSubstr(kAtReset));
}

TEST_F(GdbLaunch, EclipseLaunches) {
  const std::string text = launch("eclipse");
  EXPECT_THAT(text, HasSubstr("no wait: simulated time stands still"));
  EXPECT_THAT(text, HasSubstr("+download"));
  EXPECT_THAT(text, HasSubstr(kAtMain));
}

TEST_F(GdbLaunch, EclipseWithResetAndHaltLaunches) {
  const std::string text = launch("eclipse, reset and halt");
  EXPECT_THAT(text, HasSubstr("reset, halted before the first instruction"));
  EXPECT_THAT(text, HasSubstr(kAtMain));
}

TEST_F(GdbLaunch, PlainGdbLoadsStartsAndStartsAgain) {
  const std::string text = launch("plain");
  EXPECT_THAT(text, HasSubstr("+download"));
  EXPECT_THAT(text, HasSubstr(kAtMain));
  EXPECT_THAT(gdb.execute(std::vector<std::string>{"stepi", "start"}), HasSubstr(kAtMain));
  EXPECT_THAT(gdb.execute("print $r0"), HasSubstr("= 0")) << "from the beginning";
  EXPECT_FALSE(bench.target.ended()) << "gdb has killed it, to run it again";
}

TEST_F(GdbLaunch, ARunThatIsNotExtendedHasNoStart) {
  gdb.execute(std::vector<std::string>{"file " LOOP_ELF, "target remote localhost:" + std::to_string(bench.port())});
  EXPECT_THAT(gdb.execute("start"), HasSubstr(R"(does not support \"run\")"));
}

}  // namespace
}  // namespace dsdpv1::arm::test
