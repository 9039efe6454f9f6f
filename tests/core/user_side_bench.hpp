#pragma once
// A station with another user's side, driven at PBRXD by telegrams at 12 Mbit/s.
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "model/profibus/station.hpp"
#include "model/profibus/user_side.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1::profibus {

using Bytes = std::vector<std::uint8_t>;

constexpr int kBit = 4;  // 12 Mbit/s
constexpr std::uint8_t kSlave = 5, kMaster = 1, kSrd = 0x4D, kSdn = 0x46;
constexpr std::uint16_t kIdent = 0x1234;

class UserSideTest : public testing::Test {
 protected:
  explicit UserSideTest(int alarms = 0) : user{recorder.log, {6, 4, 8, 10, alarms}, station} {}

  static SlaveConfig initialisation() {
    SlaveConfig config;
    config.address = kSlave;
    config.ident = kIdent;
    config.sync_supported = config.address_change = config.dpv1 = true;
    config.max_input = config.max_output = 8;
    config.max_prm = 6;
    config.max_cfg = 4;
    config.max_diag = 20;
    config.prm_mode = config.cfg_mode = Judging::kUser;
    const Bytes cfg = {0x11, 0x21};  // 2 inputs, 2 outputs
    config.cfg.assign(cfg.data(), static_cast<int>(cfg.size()));
    return config;
  }

  void SetUp() override {
    user.reset();
    user.initialise(1, initialisation());
  }

  void run(Cycle cycles) {
    for (const Cycle end = now + cycles; now < end;) {
      station.eval(++now);
      hear();
    }
  }
  /// Receives at PBTXD: samples each bit two cycles after its start.
  void hear() {
    if (bit_of_character < 0) {
      if (station.txd()) return;
      bit_of_character = 0;
      sample_at = now + kBit / 2;
    }
    if (now < sample_at) return;
    sample_at += kBit;
    if (bit_of_character >= 1 && bit_of_character <= 8 && station.txd()) received |= 1U << (bit_of_character - 1);
    if (++bit_of_character < 11) return;
    answered.push_back(static_cast<std::uint8_t>(received));
    received = 0;
    bit_of_character = -1;
  }
  void level(bool high, int bits = 1) {
    station.set_rxd(now * kTicksPerCycle, high);
    run(Cycle{bits} * kBit);
  }
  void character(unsigned value) {
    level(false);
    bool odd = false;
    for (int bit = 0; bit < 8; ++bit) {
      level((value >> bit & 1) != 0);
      odd ^= (value >> bit & 1) != 0;
    }
    level(odd);
    level(true);
  }
  /// An SD2 telegram after T_SYN, and the time for its answer.
  void send(const Bytes& body) {
    level(true, 40);
    const auto le = static_cast<std::uint8_t>(body.size());
    for (const unsigned head : {0x68U, unsigned{le}, unsigned{le}, 0x68U}) character(head);
    for (const unsigned byte : body) character(byte);
    character(std::accumulate(body.begin(), body.end(), 0U) & 0xFF);
    character(0x16);
    sent = now;
    answered.clear();
    level(true, 400);
  }
  void service(int dsap, const Bytes& data, std::uint8_t fc = kSrd, int ssap = 62) {
    const bool broadcast = fc == kSdn;
    Bytes body = {static_cast<std::uint8_t>((broadcast ? 127 : kSlave) | 0x80), kMaster | 0x80, fc,
                  static_cast<std::uint8_t>(dsap), static_cast<std::uint8_t>(ssap)};
    body.insert(body.end(), data.begin(), data.end());
    send(body);
  }
  void find_baud() { service(60, {}); }
  void set_prm(const Bytes& user_bytes) {
    Bytes data = {0xA0, 0, 0, 11, kIdent >> 8, kIdent & 0xFF, 0};  // Lock_Req, Sync_Req
    data.insert(data.end(), user_bytes.begin(), user_bytes.end());
    service(61, data);
  }
  void to_exchange(const Bytes& user_prm = {0x80, 0, 0}) {
    find_baud();
    set_prm(user_prm);
    user.mail().prm.due.clear();
    user.prm_verdict(now, true);
    service(62, {0x11, 0x21});
    user.mail().cfg.due.clear();
    user.cfg_verdict(now, true);
    ASSERT_EQ(user.mail().state.state, DpState::kDataExch);
  }
  /// Due since shortly after the end of the last telegram: at its decision.
  void expect_told(const Due& due) const {
    EXPECT_GE(due.since, sent);
    EXPECT_LE(due.since, sent + 4 * kBit);
  }

  core_test::EventRecorder recorder;
  UserSide user;
  Station station{recorder.log, {}, user, &user.msac()};
  Cycle now = 1, sent = 0;
  Bytes answered;  ///< to the last telegram

 private:
  int bit_of_character = -1;
  unsigned received = 0;
  Cycle sample_at = 0;
};

}  // namespace dsdpv1::profibus
