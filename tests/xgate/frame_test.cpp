// Frames (tables 4.3 to 4.5), and every frame that clause 4.5.1 prints.
#include "model/xgate/frame.hpp"

#include <gtest/gtest.h>

#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

Bytes bytes_of(const Wire& wire) { return {wire.bytes.begin(), wire.bytes.begin() + wire.size}; }

/// In the order of the clause.
const std::vector<Bytes> kPrinted = {
    {0x7E, 0x01, 0x01, 0x11, 0x01, 0x6E},
    {0x7E, 0x01, 0x02, 0x11, 0x01, 0x00, 0x6D},
    {0x7E, 0x02, 0x0D, 0x11, 0x08, 0x00, 0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08, 0x09, 0x0A, 0x0B, 0x68},
    {0x7E, 0x02, 0x00, 0x11, 0x6D},
    {0x7E, 0x03, 0x03, 0x11, 0x00, 0x4B, 0x00, 0x24},
    {0x7E, 0x03, 0x00, 0x11, 0x6C},
    {0x7E, 0x04, 0x04, 0x11, 0x06, 0x01, 0x0F, 0x00, 0x67},
    {0x7E, 0x04, 0x00, 0x11, 0x6B},
    {0x7E, 0x12, 0x01, 0x11, 0x01, 0x7D},
    {0x7E, 0x12, 0x00, 0x11, 0x7D},
    {0x7E, 0x13, 0x02, 0x11, 0x01, 0x02, 0x7D},
    {0x7E, 0x04, 0x00, 0x11, 0x6B},
    {0x7E, 0x15, 0x02, 0x11, 0x02, 0x02, 0x78},
    {0x7E, 0x15, 0x00, 0x11, 0x7A},
    {0x7E, 0x16, 0x02, 0x11, 0x80, 0xFF, 0x04},
    {0x7E, 0x16, 0x00, 0x11, 0x79},
    {0x7E, 0x20, 0x03, 0x11, 0x01, 0x02, 0x03, 0x4C},
    {0x7E, 0x20, 0x03, 0x11, 0x09, 0x09, 0x09, 0x45},
    {0x7E, 0x21, 0x03, 0x11, 0x09, 0x09, 0x09, 0x44},
    {0x7E, 0x21, 0x03, 0x11, 0x01, 0x02, 0x03, 0x4D},
    {0x7E, 0x22, 0x00, 0x11, 0x4D},
    {0x7E, 0x23, 0x00, 0x11, 0x4C},
    {0x7E, 0x23, 0x04, 0x11, 0x50, 0x60, 0x10, 0x20, 0x48},
    {0x7E, 0x24, 0x00, 0x11, 0x4B},
    {0x7E, 0x24, 0x02, 0x11, 0x03, 0x03, 0x49}};

TEST(XgateFrame, EveryPrintedOneIsReadAndWritten) {
  ASSERT_EQ(kPrinted.size(), 25U);
  for (const Bytes& printed : kPrinted) {
    FrameParser parser;
    for (std::size_t i = 0; i + 1 < printed.size(); ++i)
      EXPECT_EQ(parser.take(printed[i]), FrameParser::Got::kNothing) << testing::PrintToString(printed);
    ASSERT_EQ(parser.take(printed.back()), FrameParser::Got::kFrame) << testing::PrintToString(printed);
    EXPECT_EQ(parser.frame().command, printed[1]);
    EXPECT_EQ(parser.frame().size(), printed[2]);
    Wire wire;
    compose(parser.frame(), wire);
    EXPECT_EQ(bytes_of(wire), printed);
  }
}

TEST(XgateFrame, EachWrongBitIsNoFrame) {
  for (const Bytes& printed : kPrinted)
    for (std::size_t place = 1; place < printed.size(); ++place)
      for (unsigned bit = 0; bit < 8; ++bit) {
        if (place == 2) continue;  // another length
        FrameParser parser;
        FrameParser::Got got{};
        for (std::size_t i = 0; i < printed.size(); ++i)
          got = parser.take(static_cast<std::uint8_t>(printed[i] ^ (i == place ? 1U << bit : 0U)));
        EXPECT_EQ(got, FrameParser::Got::kWrongXor) << place << ' ' << bit;
        EXPECT_FALSE(parser.open());
      }
}

TEST(XgateFrame, AnyLengthAndBytesBeforeIt) {
  for (int size = 0; size <= kMostData; ++size) {
    Frame frame;
    frame.command = 0x20;
    for (int i = 0; i < size; ++i) frame.data.bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(0x7E + i);
    frame.data.size = size;
    Wire wire;
    compose(frame, wire);
    ASSERT_EQ(wire.size, size + 5) << "4.3.1";
    FrameParser parser;
    for (const std::uint8_t noise : Bytes{0x00, 0xFF, 0x7D}) parser.take(noise);
    EXPECT_FALSE(parser.open());
    FrameParser::Got got{};
    for (const std::uint8_t byte : bytes_of(wire)) got = parser.take(byte);
    ASSERT_EQ(got, FrameParser::Got::kFrame) << size;
    EXPECT_TRUE(parser.frame().data.equals(frame.data.bytes.data(), size));
  }
}

TEST(XgateFrame, ErrorsInBothForms) {
  Wire wire;
  compose_error(0x20, 0x11, error::kNotConnected, ErrorForm::kFlag, wire);
  EXPECT_EQ(bytes_of(wire), Bytes({0x7E, 0x20, 0x03, 0x91, 3, 4, 0, 0x7E ^ 0x20 ^ 0x03 ^ 0x91 ^ 3 ^ 4}));
  compose_error(0x20, 0x51, error::kNotConnected, ErrorForm::kFlag, wire);
  EXPECT_EQ(wire.bytes[3], 0xD1) << "and an acknowledged alarm";
  compose_error(0x20, 0x11, error::kNotConnected, ErrorForm::kPrinted, wire);
  EXPECT_EQ(bytes_of(wire), Bytes({0x7E, 0x20, 0x83, 0x11, 3, 4, 0, 0x7E ^ 0x20 ^ 0x83 ^ 0x11 ^ 3 ^ 4}));
}

}  // namespace
}  // namespace dsdpv1::xgate
