#pragma once
// Captures made from telegrams in sequence.
#include <utility>
#include <vector>

#include "bus/baud.hpp"
#include "lab/replay/recording.hpp"

namespace dsdpv1::replay_test {

using bus::Bytes;
using bus::Telegram;

constexpr int kBaud = 3;  // 1.5M
constexpr std::uint8_t kSlave = 5, kMaster = 2;

inline Telegram to_slave(std::uint8_t dsap, const Bytes& data = {}) {
  return bus::make_telegram(kSlave, kMaster, bus::fc::kRequest | bus::fc::kSrdHigh, data, dsap, bus::sap::kMaster);
}
inline Telegram from_slave(std::uint8_t ssap, const Bytes& data) {
  return bus::make_telegram(kMaster, kSlave, bus::fc::kDl, data, bus::sap::kMaster, ssap);
}
/// Slave_Diag of ident number 0x1234.
inline Bytes diagnosis(std::uint8_t first, std::uint8_t second, const Bytes& own = {}, std::uint8_t master = kMaster) {
  Bytes bytes = {first, second, 0, master, 0x12, 0x34};
  bytes.insert(bytes.end(), own.begin(), own.end());
  return bytes;
}
inline Telegram outputs(const Bytes& data) {
  return bus::make_telegram(kSlave, kMaster, bus::fc::kRequest | bus::fc::kSrdHigh, data);
}
inline Telegram inputs(const Bytes& data, std::uint8_t fc = bus::fc::kDl) {
  return bus::make_telegram(kMaster, kSlave, fc, data);
}

class Capture {
 public:
  explicit Capture(std::uint8_t slave = kSlave) : recorder_("made.pcapng", slave, {}) {}

  /// The next telegrams have this rate.
  void set_baud(int baud) { baud_ = baud; }
  /// After 40 bit times, an answer after 12. Its start.
  bus::Tick add(const Telegram& telegram) { return add(bus::encode(telegram), telegram.is_response() ? 12 : 40, 0); }
  bus::Tick add(const Bytes& bytes, int pause_bits, std::uint32_t damage) {
    bus::capture::CapturedTelegram telegram;
    const bus::Tick bit = bus::baud(baud_).bit;
    telegram.start = now_ + pause_bits * bit;
    telegram.end = telegram.start + static_cast<bus::Tick>(bytes.size()) * bus::kCharacterBits * bit;
    telegram.baud = baud_;
    telegram.damage = damage;
    telegram.bytes = bytes;
    recorder_.telegram(telegram);
    now_ = telegram.end;
    return telegram.start;
  }
  /// The end of the last one.
  bus::Tick now() const { return now_; }
  tb::replay::Recording finish() { return recorder_.finish(); }

 private:
  tb::replay::Recorder recorder_;
  int baud_ = kBaud;
  bus::Tick now_ = 0;
};

}  // namespace dsdpv1::replay_test
