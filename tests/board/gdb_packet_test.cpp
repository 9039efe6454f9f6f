// Assembles packets of the remote serial protocol from the pieces delivered by a network.
#include "board/gdb/gdb_packet.hpp"

#include <gtest/gtest.h>

namespace dsdpv1::arm {
namespace {

using Kind = GdbInput::Kind;

TEST(GdbPacket, IsFramedWithItsChecksum) {
  EXPECT_EQ(gdb_frame("OK"), "$OK#9a");
  EXPECT_EQ(gdb_frame(""), "$#00");
}

TEST(GdbPacket, InPiecesIsPutTogether) {
  for (std::size_t piece = 1; piece <= 5; ++piece) {
    const std::string bytes = "+" + gdb_frame("m8000000,4") + "+" + gdb_frame("g");
    GdbReader reader;
    std::vector<std::string> packets;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      reader.take(bytes.substr(at, piece));
      while (const auto input = reader.next()) packets.push_back(input->packet);
    }
    EXPECT_EQ(packets, (std::vector<std::string>{"m8000000,4", "g"})) << piece << " bytes at a time";
  }
}

TEST(GdbPacket, WrongChecksumIsTold) {
  for (const char* const wrong : {"$OK#9b", "$OK#xx", "$OK#9"}) {
    GdbReader reader;
    reader.take(std::string(wrong) + "#");
    ASSERT_TRUE(reader.next());
  }
  GdbReader reader;
  reader.take("$OK#9b$OK#9a");
  EXPECT_EQ(reader.next()->kind, Kind::kWrongChecksum);
  EXPECT_EQ(reader.next()->packet, "OK");
  EXPECT_FALSE(reader.next());
}

TEST(GdbPacket, BegunAnewCountsFromItsLastStart) {
  GdbReader reader;
  reader.take("$m800$OK#9a");
  EXPECT_EQ(reader.next()->packet, "OK");
}

TEST(GdbPacket, InterruptAndRequestToRepeatStandBetweenPackets) {
  GdbReader reader;
  reader.take("\x03-$OK#9a");
  EXPECT_EQ(reader.next()->kind, Kind::kInterrupt);
  EXPECT_EQ(reader.next()->kind, Kind::kRepeat);
  EXPECT_EQ(reader.next()->kind, Kind::kPacket);
}

TEST(GdbPacket, InterruptByteInAPacketIsData) {
  GdbReader reader;
  reader.take(gdb_frame("X20000000,1:\x03"));
  EXPECT_EQ(reader.next()->packet, "X20000000,1:\x03");
}

TEST(GdbPacket, TooLongOneIsRefusedOnceAndTheNextIsRead) {
  const std::string longest(kGdbPacketSize, 'a');
  GdbReader reader;
  reader.take(gdb_frame(longest));
  EXPECT_EQ(reader.next()->packet, longest);
  reader.take(gdb_frame(longest + "a"));
  EXPECT_EQ(reader.next()->kind, Kind::kWrongChecksum);
  EXPECT_FALSE(reader.next());
  reader.take("$" + std::string(10 * kGdbPacketSize, 'a'));
  EXPECT_EQ(reader.next()->kind, Kind::kWrongChecksum);
  reader.take("aaa#00$OK#9a");
  EXPECT_EQ(reader.next()->packet, "OK");
}

TEST(GdbPacket, BinaryDataIsUnescaped) {
  EXPECT_EQ(gdb_unescape("a}\x03}]b"), std::string("a#}b"));
  EXPECT_EQ(gdb_unescape("a}"), "a}");
}

TEST(GdbPacket, HexadecimalIsReadBack) {
  EXPECT_EQ(to_hex("\x01\xFE"), "01fe");
  EXPECT_EQ(from_hex("01Fe"), std::string("\x01\xFE"));
  EXPECT_EQ(from_hex("1"), std::nullopt);
  EXPECT_EQ(from_hex("0g"), std::nullopt);
  EXPECT_EQ(from_hex("-1"), std::nullopt);
}

TEST(GdbPacket, NumbersHaveUpTo32Bits) {
  EXPECT_EQ(GdbFields("ffffffff").number(), 0xFFFF'FFFFU);
  EXPECT_EQ(GdbFields("100000000").number(), std::nullopt);
  EXPECT_EQ(GdbFields("").number(), std::nullopt);
  GdbFields fields("8000000,4:rest");
  const auto range = fields.range();
  ASSERT_TRUE(range);
  EXPECT_EQ(range->address, 0x0800'0000U);
  EXPECT_EQ(range->size, 4U);
  EXPECT_EQ(fields.rest(), ":rest");
}

}  // namespace
}  // namespace dsdpv1::arm
