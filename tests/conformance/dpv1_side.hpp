#pragma once
// DPV1 in short words for the conformance tests: requests and polls on the SAPs of table 24, and a user that answers in
// the C1 and C2 areas of the DPRAM. Numbers are the datasheet's (7.2, 7.3), written apart from the chip's.
#include <string>

#include "tests/conformance/master_side.hpp"
#include "tests/conformance/user_helpers.hpp"

namespace dsdpv1::conformance {

constexpr int kC1Sap = 0x33, kManagerSap = 0x31, kFirstChannel = 0x30, kSecondChannel = 0x2F, kC2Ssap = 0x32;
constexpr Cycle kSendTimeoutUnit = 480'000;  ///< 10 ms

/// The C1 or the C2 area: where a request comes, how it is flagged, where the answer goes.
struct Area {
  std::uint16_t base, crc;
  std::uint8_t flag;       ///< in B00F and B011
  std::uint8_t crc_error;  ///< in B00B
};
constexpr Area kC1Area = {0x5D0, 0x6C4, 0x01, 0x10}, kC2Area = {0x6D0, 0x7C4, 0x02, 0x20};

/// A slave at 5 in data exchange with DPV1 on at both sides; the class 2 master of the tests is 1.
class Dpv1Test : public testing::Test {
 protected:
  static constexpr std::uint8_t kClass2 = 1;

  void start(bool b005 = true, bool dpv1_enable = true) {
    bench.power_on();
    bench.enable_dpv1(b005);
    ASSERT_TRUE(bench.initialise());
    bench.find_baud(0);
    Prm prm;
    prm.user = {static_cast<std::uint8_t>(dpv1_enable ? 0x80 : 0x00), 0, 0};
    ASSERT_TRUE(is_sc(bench.set_prm(prm)));
    ASSERT_TRUE(is_sc(bench.check_cfg()));
    ASSERT_EQ(bench.dp_state(), DpState::kDataExch);
  }

  Exchange c1(const Bytes& pdu, std::uint8_t master = 2) {
    return send_fc(bench, kSrdFirst, kC1Sap, kC1Sap, pdu, master);
  }
  Exchange c2(int sap, const Bytes& pdu = {}, std::uint8_t master = kClass2) {
    return send_fc(bench, kSrdFirst, sap, kC2Ssap, pdu, master);
  }

  static Bytes initiate_pdu(int send_timeout = 100, const Bytes& add_addr = {0, 2, 0, 2, 0x0A, 0x0B, 0x0C, 0x0D}) {
    Bytes pdu = {0x57,
                 0,
                 0,
                 0,
                 static_cast<std::uint8_t>(send_timeout >> 8),
                 static_cast<std::uint8_t>(send_timeout & 0xFF),
                 1,
                 0,
                 0,
                 0,
                 0,
                 0};
    pdu.insert(pdu.end(), add_addr.begin(), add_addr.end());
    return pdu;
  }
  /// Initiate and the poll that connects; the SAP, 0 when refused.
  int connect(std::uint8_t master = kClass2, int send_timeout = 100) {
    const Exchange immediate = c2(kManagerSap, initiate_pdu(send_timeout), master);
    if (!is_data(immediate)) return 0;
    const int sap = immediate.answer().data.at(1);
    EXPECT_TRUE(is_data(c2(sap, {}, master)));
    return sap;
  }

  Bytes fetch(const Area& area) { return fetch(bench, area); }
  void give(const Area& area, const Bytes& pdu, std::uint16_t crc_error = 0) { give(bench, area, pdu, crc_error); }

  /// The request in an area with its CRC checked; empty when the flag is not set. Clears the flag.
  static Bytes fetch(SlaveBench& bench, const Area& area) {
    bench.acquire();
    Bytes pdu;
    const std::uint8_t flags = bench.read(0x00F);
    if ((flags & area.flag) != 0) {
      for (int i = 0; i < 4; ++i) pdu.push_back(bench.read(static_cast<std::uint16_t>(area.base + i)));
      const int data = pdu[0] == 0x5E ? 0 : pdu[3];
      for (int i = 0; i < data; ++i) pdu.push_back(bench.read(static_cast<std::uint16_t>(area.base + 4 + i)));
      const int crc = bench.read(area.crc) << 8 | bench.read(static_cast<std::uint16_t>(area.crc + 1));
      EXPECT_EQ(crc, document_crc(pdu));
      bench.write(0x00F, static_cast<std::uint8_t>(flags & ~area.flag));
    }
    bench.release();
    return pdu;
  }
  /// The user's answer, and three accesses of the chip. As a good driver, nothing when a newer request has come (V13):
  /// false.
  static bool give(SlaveBench& bench, const Area& area, const Bytes& pdu, std::uint16_t crc_error = 0) {
    bench.acquire();
    const bool newer = (bench.read(0x00F) & area.flag) != 0;
    if (!newer) {
      bench.write_block(area.base, pdu, area.crc, crc_error);
      bench.write(0x011, static_cast<std::uint8_t>(bench.read(0x011) | area.flag));
    }
    bench.release();
    bench.chip_accesses(3);
    return !newer;
  }
  static Bytes read_request(int slot, int index, int length) { return pdu_of(0x5E, slot, index, length); }
  static Bytes pdu_of(int function, int slot, int index, int length, const Bytes& data = {}) {
    Bytes pdu = {static_cast<std::uint8_t>(function), static_cast<std::uint8_t>(slot), static_cast<std::uint8_t>(index),
                 static_cast<std::uint8_t>(length)};
    pdu.insert(pdu.end(), data.begin(), data.end());
    return pdu;
  }
  static Bytes counting(int size, int first = 1) {
    Bytes bytes;
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(first + i));
    return bytes;
  }
  static std::string text(const Exchange& exchange) {
    return is_data(exchange) ? testing::PrintToString(exchange.answer().data) : kind_of(exchange);
  }
  profibus::RmEntry registry(int sap) const { return bench.chip.status().c2.at(static_cast<std::size_t>(0x30 - sap)); }

  SlaveBench bench{quick_search()};
};

}  // namespace dsdpv1::conformance
