// pcapng as it is written and read, block by block.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "bus/capture/link_type.hpp"
#include "bus/capture/pcap_reader.hpp"
#include "bus/capture/pcapng_writer.hpp"

namespace dsdpv1::bus::capture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

CapturedTelegram token(Tick start, int baud = 0) {
  return {start, start + 3 * kCharacterBits * bus::baud(baud).bit, baud, 0, {0xDC, 2, 2}, {}};
}

std::string written(const std::vector<CapturedTelegram>& telegrams, std::uint16_t link = 257) {
  std::string file;
  PcapngWriter writer({link, "test", 0}, [&file](std::string_view bytes) { file += bytes; });
  for (const CapturedTelegram& each : telegrams) writer.telegram(each);
  return file;
}

std::vector<CapturedTelegram> read(const std::string& file) {
  std::vector<CapturedTelegram> telegrams;
  std::istringstream in(file);
  read_pcapng(in, [&telegrams](const CapturedTelegram& each) { telegrams.push_back(each); });
  return telegrams;
}

std::string error_of(const std::string& file) {
  try {
    read(file);
  } catch (const CaptureError& error) {
    return error.what();
  }
  return "";
}

TEST(Pcapng, BytesAreThoseOfTheFormat) {
  const std::string file = written({});
  EXPECT_EQ(file.substr(0, 16), std::string("\x0A\x0D\x0D\x0A\x28\0\0\0\x4D\x3C\x2B\x1A\x01\0\0\0", 16));
  EXPECT_EQ(file.size() % 4, 0U);
  EXPECT_THAT(file, HasSubstr("PROFIBUS DP at 12M, 12000000 bit/s"));
}

TEST(Pcapng, TelegramsComeBackWithTimeRateDamageAndRemarks) {
  CapturedTelegram damaged = token(36, 4);
  damaged.damage = damage::kFcs | damage::kCharacter;
  damaged.remarks = {"character error: wrong parity"};
  const auto back = read(written({token(12), damaged}));
  ASSERT_THAT(back, SizeIs(2));
  EXPECT_EQ(back[0].start, 12);
  EXPECT_EQ(back[0].end, 12 + 33 * 1000);
  EXPECT_EQ(back[0].bytes, (Bytes{0xDC, 2, 2}));
  EXPECT_EQ(back[1].start, 36);
  EXPECT_EQ(back[1].baud, 4);
  EXPECT_EQ(back[1].damage, damaged.damage);
  EXPECT_THAT(back[1].remarks, ElementsAre("character error: wrong parity"));
}

TEST(Pcapng, EveryRateIsKnownByItsSpeed) {
  for (int baud = 0; baud < kBaudCount; ++baud) EXPECT_EQ(read(written({token(0, baud)}))[0].baud, baud);
}

TEST(Pcapng, TimesAreRoundedToTheNearestNanosecond) {
  EXPECT_EQ(read(written({token(12 * 1'000'000'000LL * 5 + 5)}))[0].start, 12 * 1'000'000'000LL * 5);
  EXPECT_EQ(read(written({token(6)}))[0].start, 12);
}

TEST(Pcapng, EndThatIsNotThatOfTheCharactersIsSaid) {
  CapturedTelegram late = token(0);
  late.end += 1200;
  EXPECT_THAT(read(written({late}))[0].remarks, ElementsAre("ends at 2850 ns"));
}

TEST(Pcapng, UserLinkTypesAreReadOthersAreRefused) {
  for (const std::uint16_t link : std::initializer_list<std::uint16_t>{257, 147, 162})
    EXPECT_THAT(read(written({token(0)}, link)), SizeIs(1));
  EXPECT_EQ(error_of(written({token(0)}, 1)),
            "packets of link type 1, expected 257 (PROFIBUS) and 147 to 162 (USER0 to USER15)");
}

TEST(Pcapng, WordsOfLinkTypes) {
  EXPECT_EQ(link_type("profibus"), 257);
  EXPECT_EQ(link_type("user0"), 147);
  EXPECT_EQ(link_type("user15"), 162);
  for (const char* word : {"user16", "user", "257", ""}) EXPECT_EQ(link_type(word), std::nullopt) << word;
}

TEST(Pcapng, CutOffAnywhereIsSaidAfterWhatWasThere) {
  const std::string file = written({token(0), token(12'000)});
  const std::size_t header = written({}).size();
  for (std::size_t size = header + 1; size < file.size(); ++size) {
    const std::string error = error_of(file.substr(0, size));
    const bool whole = size == (file.size() + header) / 2;
    EXPECT_EQ(error.empty(), whole) << size;
    if (!whole) EXPECT_THAT(error, HasSubstr("it was cut off")) << size;
  }
}

TEST(Pcapng, EveryByteMayBeWrong) {
  const std::string file = written({token(0), token(12'000)});
  for (std::size_t at = 0; at < file.size(); ++at)
    for (const char wrong : {'\0', '\x7F', '\xFF'}) {
      std::string bad = file;
      bad[at] = wrong;
      error_of(bad);  // an error or not, but neither a crash nor a large memory
    }
}

TEST(Pcapng, BlockOfAnyLengthIsNotBelieved) {
  std::string file = written({token(0)});
  const std::size_t length = written({}).size() + 4;
  file.replace(length, 4, std::string("\xF0\xFF\xFF\xFF", 4));
  EXPECT_THAT(error_of(file), HasSubstr("a block of 4294967280 bytes"));
}

}  // namespace
}  // namespace dsdpv1::bus::capture
