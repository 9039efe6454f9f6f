#include "lab/traces/xz.hpp"

#include <gtest/gtest.h>

namespace dsdpv1 {
namespace {

using tb::traces::compress;
using tb::traces::decompress;

constexpr std::size_t kMuch = 100U << 20U;

TEST(Xz, GivesBackWhatWasCompressed) {
  for (const std::size_t size : {0U, 1U, 1000U, (1U << 20U) - 1, 1U << 20U, 5'000'000U}) {
    const std::string content(size, 'a');
    const auto result = decompress(compress(content), kMuch);
    EXPECT_EQ(result.wrong, "");
    EXPECT_TRUE(result.content == content) << size;
  }
}

TEST(Xz, ReadsUpToALimit) {
  const std::string content(3'000'000, 'a');
  EXPECT_EQ(decompress(compress(content), 3'000'000).wrong, "");
  EXPECT_EQ(decompress(compress(content), 2'999'999).wrong, "holds more than is allowed");
}

TEST(Xz, SaysWhatIsWrong) {
  const std::string file = compress(std::string(10'000, 'a') + "bcd");
  EXPECT_EQ(decompress("", kMuch).wrong, "is truncated");
  EXPECT_EQ(decompress(file.substr(0, file.size() - 5), kMuch).wrong, "is truncated");
  EXPECT_EQ(decompress("no such thing at all", kMuch).wrong, "is no .xz file");
  EXPECT_EQ(decompress(file + "more", kMuch).wrong, "has something after its end");
  std::string damaged = file;
  damaged[file.size() / 2] = static_cast<char>(damaged[file.size() / 2] ^ 1);
  EXPECT_EQ(decompress(damaged, kMuch).wrong, "is damaged");
}

}  // namespace
}  // namespace dsdpv1
