// Rulings P2, S2; chapter 8.3 of the micro-architecture.
#include "model/profibus/uart_tx.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dsdpv1::profibus {
namespace {

/// The level that the wire must have `cycle` cycles after the first start bit.
bool expected_level(const std::vector<std::uint8_t>& bytes, int bit, Cycle cycle) {
  const auto index = static_cast<std::size_t>(cycle / bit);
  const std::uint8_t byte = bytes[index / 11];
  const auto position = static_cast<unsigned>(index % 11);
  if (position == 0) return false;
  if (position <= 8) return (byte >> (position - 1) & 1) != 0;
  if (position == 10) return true;
  bool parity = false;
  for (unsigned i = 0; i < 8; ++i) parity ^= (byte >> i & 1) != 0;
  return parity;
}

TEST(UartTxBlock, SendsEveryBitForItsTimeAtEveryRate) {
  std::vector<std::uint8_t> bytes = {0x00, 0xFF, 0x55, 0xA5, 0x01, 0x80, 0xE5};
  for (const int bit : kBitCycles) {
    UartTx tx;
    const Cycle begin = 100, end = begin + static_cast<Cycle>(bytes.size()) * 11 * bit;
    tx.send(bytes.data(), static_cast<int>(bytes.size()), bit, begin, 4, 4);
    EXPECT_EQ(tx.end(), end);
    for (Cycle now = 50; now < end + 20; ++now) {
      const bool falls = tx.eval(now);
      ASSERT_EQ(tx.rts(), now >= begin - 4 && now < end + 4) << now;
      ASSERT_EQ(falls, now == end + 4) << now;
      const bool level = now < begin || now >= end || expected_level(bytes, bit, now - begin);
      ASSERT_EQ(tx.txd(), level) << "cycle " << now << " at " << bit << " cycles a bit";
    }
    EXPECT_FALSE(tx.planned());
  }
}

TEST(UartTxBlock, AbortReleasesTheLineAtOnce) {
  const std::uint8_t bytes[] = {0x00, 0x00};
  UartTx tx;
  tx.send(bytes, 2, 4, 10, 4, 4);
  for (Cycle now = 0; now < 30; ++now) tx.eval(now);
  ASSERT_FALSE(tx.txd());
  tx.abort();
  EXPECT_TRUE(tx.txd());
  EXPECT_FALSE(tx.rts());
  EXPECT_FALSE(tx.planned());
  EXPECT_EQ(tx.next(), kNever);
}

TEST(UartTxBlock, EvaluatedOnlyAtNextItIsTheSame) {
  std::mt19937 random(3);
  UartTx every, sparse;
  std::vector<std::uint8_t> bytes;
  for (Cycle now = 0; now < 300'000; ++now) {
    const bool falls = every.eval(now);
    bool sparse_falls = false;
    if (now >= sparse.next()) {
      ASSERT_EQ(now, sparse.next()) << "next() lies in the past";
      sparse_falls = sparse.eval(now);
    }
    ASSERT_EQ(falls, sparse_falls) << now;
    ASSERT_EQ(every.txd(), sparse.txd()) << now;
    ASSERT_EQ(every.rts(), sparse.rts()) << now;
    if (every.rts() && random() % 3000 == 0) {
      every.abort();
      sparse.abort();
    }
    if (every.planned() || random() % 50 != 0) continue;
    bytes.resize(1 + random() % 20);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    const int bit = kBitCycles[random() % 6];
    const Cycle begin = now + 5 + static_cast<Cycle>(random() % 60);
    const auto lead = static_cast<Cycle>(random() % 5), trail = static_cast<Cycle>(random() % 5);
    every.send(bytes.data(), static_cast<int>(bytes.size()), bit, begin, lead, trail);
    sparse.send(bytes.data(), static_cast<int>(bytes.size()), bit, begin, lead, trail);
  }
}

}  // namespace
}  // namespace dsdpv1::profibus
