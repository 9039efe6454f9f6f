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
inline Telegram outputs(const Bytes& data) {
  return bus::make_telegram(kSlave, kMaster, bus::fc::kRequest | bus::fc::kSrdHigh, data);
}
inline Telegram inputs(const Bytes& data, std::uint8_t fc = bus::fc::kDl) {
  return bus::make_telegram(kMaster, kSlave, fc, data);
}

class Capture {
 public:
  explicit Capture(std::uint8_t slave = kSlave) : recorder_("made.pcapng", slave, kBaud) {}

  /// After 40 bit times, an answer after 12. Its start.
  bus::Tick add(const Telegram& telegram) { return add(bus::encode(telegram), telegram.is_response() ? 12 : 40, 0); }
  bus::Tick add(const Bytes& bytes, int pause_bits, std::uint32_t damage) {
    bus::capture::CapturedTelegram telegram;
    telegram.start = now_ + pause_bits * bus::baud(kBaud).bit;
    telegram.end = telegram.start + static_cast<bus::Tick>(bytes.size()) * bus::kCharacterBits * bus::baud(kBaud).bit;
    telegram.baud = kBaud;
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
  bus::Tick now_ = 0;
};

}  // namespace dsdpv1::replay_test
