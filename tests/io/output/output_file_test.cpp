// Output files: complete or absent, and only outputs are replaced.
#include "io/output/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "io/input/input_error.hpp"

namespace dsdpv1 {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dsdpv1_report_" + std::to_string(::getpid()));
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
  void make(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path().filename());
    return found;
  }
  static void write(const std::string& name, const std::string& text) {
    tb::OutputFile file(name);
    file.write(text);
    file.commit();
  }
  static std::string refusal(const std::string& name) {
    try {
      write(name, "text");
    } catch (const tb::InputError& error) {
      return error.what();
    }
    return "none";
  }
  fs::path folder_;
};

/// Limits the length of files during its lifetime.
class LargestFile {
 public:
  explicit LargestFile(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~LargestFile() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  LargestFile(const LargestFile&) = delete;
  LargestFile& operator=(const LargestFile&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(OutputFiles, LinkIsFollowedAndStaysOne) {
  fs::create_directory(folder_ / "far");
  make("far/there", "before");
  fs::create_symlink("far/there", folder_ / "direct");
  fs::create_symlink(path("direct"), folder_ / "link");
  fs::create_symlink("far/new", folder_ / "dangling");
  write(path("link"), "after");
  write(path("dangling"), "made");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(read(path("far/there")), "after");
  EXPECT_EQ(read(path("far/new")), "made");
}

TEST_F(OutputFiles, CircleOfLinksIsRefused) {
  fs::create_symlink("b", folder_ / "a");
  fs::create_symlink("a", folder_ / "b");
  EXPECT_EQ(refusal(path("a")), path("a") + ": cannot be written: Too many levels of symbolic links");
}

TEST_F(OutputFiles, FifoIsWrittenTo) {
  ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = read(path("fifo")); });
  write(path("fifo"), "through");
  reader.join();
  EXPECT_EQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(folder_ / "fifo"));
  EXPECT_EQ(names().size(), 1U);
}

TEST_F(OutputFiles, FullDeviceIsAnErrorThatIsKept) {
  fs::create_symlink("/dev/full", folder_ / "full");
  EXPECT_EQ(refusal(path("full")), path("full") + ": cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_symlink(folder_ / "full"));
}

TEST_F(OutputFiles, FolderIsRefused) {
  EXPECT_EQ(refusal(folder_.string()), folder_.string() + ": cannot be written: Is a directory");
  EXPECT_TRUE(names().empty());
}

TEST_F(OutputFiles, TwoOfOneNameAreBothWholeAndTheLastWins) {
  tb::OutputFile first(path("log")), second(path("log"));
  EXPECT_NE(first.grows_at(), second.grows_at());
  for (int i = 0; i < 10000; ++i) {
    first.write("first\n");
    second.write("second\n");
  }
  second.commit();
  EXPECT_EQ(read(path("log")).size(), 70000U);
  first.commit();
  EXPECT_EQ(read(path("log")).size(), 60000U);
  EXPECT_EQ(names(), std::vector<std::string>{"log"});
}

TEST_F(OutputFiles, WhatWasFlushedStandsUnderTheTemporaryName) {
  tb::OutputFile file(path("log"));
  file.write("so far");
  file.flush();
  EXPECT_EQ(read(file.grows_at()), "so far");
  EXPECT_EQ(file.grows_at(), path("log") + "." + std::to_string(::getpid()) + ".part");
}

TEST_F(OutputFiles, LongestNamesWorkAndLongerOnesLeaveNothing) {
  for (const std::size_t length : {std::size_t{249}, std::size_t{255}}) {
    const std::string name(length, 'n');
    write(path(name), "text");
    EXPECT_EQ(names(), std::vector<std::string>{name});
    fs::remove(folder_ / name);
  }
  const std::string name(256, 'n');
  EXPECT_EQ(refusal(path(name)), path(name) + ": cannot be written: File name too long");
  EXPECT_TRUE(names().empty());
}

TEST_F(OutputFiles, LongNameIsCutBetweenCharacters) {
  std::string name;
  while (name.size() < 254) name += "\u00E9";
  tb::OutputFile file(path(name));
  const std::string part = fs::path(file.grows_at()).filename();
  EXPECT_EQ(part.substr(0, part.find('.')), name.substr(0, part.find('.')));
  EXPECT_EQ(part.find('.') % 2, 0U);
  EXPECT_LE(part.size() + tb::PartFile::kRoom, 255U);
}

TEST_F(OutputFiles, ModeOfTheReplacedFileIsKept) {
  make("result", "before");
  fs::permissions(folder_ / "result", fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
  write(path("result"), "after");
  EXPECT_EQ(fs::status(folder_ / "result").permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
}

TEST_F(OutputFiles, FullDiskIsSeenBeforeTheEndAndLeavesNothing) {
  make("log", "before");
  {
    const LargestFile full(100'000);
    tb::OutputFile file(path("log"));
    for (int i = 0; i < 20'000; ++i) file.write("0123456789");
    EXPECT_TRUE(file.failed());
    EXPECT_THROW(file.check(), tb::InputError);
    EXPECT_THROW(file.commit(), tb::InputError);
  }
  EXPECT_EQ(names(), std::vector<std::string>{"log"});
  EXPECT_EQ(read(path("log")), "before") << "what was there stays";
}

TEST_F(OutputFiles, FullDiskAtTheLastByteIsSeen) {
  {
    const LargestFile full(9);
    EXPECT_EQ(refusal(path("log")), "none") << "4 bytes fit";
    tb::OutputFile file(path("log"));
    file.write("0123456789");
    EXPECT_FALSE(file.failed()) << "it is in the buffer";
    EXPECT_THROW(file.commit(), tb::InputError);
  }
  EXPECT_EQ(read(path("log")), "text");
}

TEST_F(OutputFiles, DescriptorsOfTheProcessAreWrittenTo) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  fs::create_symlink("/dev/fd/" + std::to_string(ends[1]), folder_ / "link");
  write(path("link"), "there");
  char text[6] = {};
  EXPECT_EQ(::read(ends[0], text, 5), 5);
  EXPECT_STREQ(text, "there");
  ::close(ends[0]);
  ::close(ends[1]);
  EXPECT_EQ(refusal(path("link")), path("link") + ": cannot be written: Bad file descriptor");
}

TEST_F(OutputFiles, NamesOfOneFileAreKnownAsOne) {
  make("file", "");
  fs::create_symlink("file", folder_ / "link");
  fs::create_symlink("new", folder_ / "dangling");
  fs::create_hard_link(folder_ / "file", folder_ / "hard");
  for (const char* name : {"./file", "link", "hard"})
    EXPECT_EQ(tb::output_identity(path(name)), tb::output_identity(path("file"))) << name;
  EXPECT_EQ(tb::output_identity(path("dangling")),
            tb::output_identity(path("../" + folder_.filename().string() + "/new")));
  EXPECT_NE(tb::output_identity(path("file")), tb::output_identity(path("new")));
  for (const char* name : {"/dev/null", "/dev/stdout", "/dev/fd/1"}) EXPECT_EQ(tb::output_identity(name), std::nullopt);
}

}  // namespace
}  // namespace dsdpv1
