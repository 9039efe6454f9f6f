#pragma once
// A module between a host that sends bytes at 3 Mbit/s (or by SPI) and a master that sends telegrams at 12 Mbit/s. All
// pins are recorded, and what the module sends is read from the recording.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "model/xgate/module.hpp"
#include "tests/core/event_recorder.hpp"

namespace dsdpv1::xgate {

using Bytes = std::vector<std::uint8_t>;

constexpr Cycle kByte = 160;                     // 10 bits at 3 Mbit/s
constexpr Cycle kBit = 4;                        // 12 Mbit/s
constexpr std::uint8_t kSlave = 6, kMaster = 1;  // the address is that of the examples in 4.5.1
constexpr Cycle kSilent = 1'000'000;             // no answer comes any more

enum class Way : std::uint8_t { kSkip, kStep, kRestored };
enum Pin : std::uint8_t { kTxd, kRts, kInt, kFirstLed };

struct Change {
  Cycle at;
  int pin, level;
  friend bool operator==(const Change& a, const Change& b) {
    return a.at == b.at && a.pin == b.pin && a.level == b.level;
  }
};

/// `7E CMD len special data XOR`.
inline Bytes frame(std::uint8_t command, const Bytes& data, std::uint8_t special = 0x11) {
  Bytes bytes = {0x7E, command, static_cast<std::uint8_t>(data.size()), special};
  bytes.insert(bytes.end(), data.begin(), data.end());
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) sum = static_cast<std::uint8_t>(sum ^ byte);
  bytes.push_back(sum);
  return bytes;
}
inline Bytes error_frame(ErrorForm form, std::uint8_t command, Error error) {
  Bytes bytes = frame(command, {error.type, error.code, 0}, form == ErrorForm::kFlag ? 0x91 : 0x11);
  if (form == ErrorForm::kFlag) return bytes;
  bytes[2] = 0x83;
  bytes.back() ^= 0x83 ^ 0x03;
  return bytes;
}
/// `id, length, 00, data, XOR of data`.
inline Bytes box(std::uint8_t id, const Bytes& data) {
  Bytes bytes = {id, static_cast<std::uint8_t>(data.size()), 0};
  bytes.insert(bytes.end(), data.begin(), data.end());
  bytes.push_back(std::accumulate(data.begin(), data.end(), std::uint8_t{0}, std::bit_xor<std::uint8_t>()));
  return bytes;
}
inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class ModuleBench {
 public:
  static Config quick() {
    Config config;
    config.rate = 3'000'000;
    config.answer_delay = 300;
    config.frame_gap = 5'000;
    config.power_up = 1'000;
    config.rate_hold = 500;
    config.host_shown = 50'000;
    return config;
  }

  explicit ModuleBench(const Config& settings = quick(), Way how = Way::kSkip)
      : config(settings), way(how), module(std::make_unique<Module>(settings)) {
    module->on_byte({&hear_byte, this});
    module->on_event({&take_event, this});
    levels.fill(-1);
    look();
    run(10);
    reset(false);
    run(config.power_up + 10);
  }

  // --- time ---------------------------------------------------------------------------------------------------------
  void run(Cycle cycles) {
    const Cycle end = now + cycles;
    while (true) {
      const Cycle next = way == Way::kStep ? now + 1 : std::max(module->next(), now + 1);
      const Cycle byte = coming.empty() ? profibus::kNever : coming.front().first;
      if (std::min(next, byte) > end) break;
      if (byte < next) {
        deliver(byte);
        continue;
      }
      now = next;
      module->eval(now);
      ++evaluated;
      look();
      if (way == Way::kRestored) replace();
    }
    now = end;
  }
  void look() {
    const int seen[] = {module->txd(),
                        module->rts(),
                        module->interrupt() ? 0 : 1,
                        module->led(Led::kNetworkGreen),
                        module->led(Led::kNetworkRed),
                        module->led(Led::kModuleGreen),
                        module->led(Led::kModuleRed)};
    for (int pin = 0; pin < static_cast<int>(levels.size()); ++pin) {
      int& level = levels[static_cast<std::size_t>(pin)];
      if (seen[pin] != level) changes.push_back({now, pin, seen[pin]});
      level = seen[pin];
    }
  }
  /// The rest is done by another module, made from this one's saved state.
  void replace() {
    const Bytes saved = save(*module);
    auto other = std::make_unique<Module>(config);
    other->on_byte({&hear_byte, this});
    other->on_event({&take_event, this});
    restore(other, saved.data(), saved.size());
    ASSERT_EQ(save(*other), saved);
    module = std::move(other);
  }
  void reset(bool low) {
    module->set_reset(now, low);
    look();
  }

  // --- the host -----------------------------------------------------------------------------------------------------
  void put(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      run(byte_time);
      module->receive(now, byte);
      look();
    }
  }
  /// Bytes that come while the bench runs: the first ends at `first`.
  void put_later(Cycle first, const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) {
      coming.emplace_back(first, byte);
      first += kByte;
    }
  }
  /// The bytes of the answer.
  Bytes send(const Bytes& bytes) {
    heard.clear();
    put(bytes);
    return hear();
  }
  Bytes hear() {
    const Cycle end = now + kSilent;
    while (heard.empty() && now < end) run(100);
    while (!heard.empty() && now < heard_until) run(heard_until - now);
    return heard;
  }
  /// SPI at 6 Mbit/s: MISO.
  std::uint8_t transfer(std::uint8_t mosi) {
    const std::uint8_t miso = module->begin_byte();
    run(64);
    module->end_byte(now, mosi);
    look();
    return miso;
  }
  Bytes transfer(const Bytes& mosi) {
    Bytes miso;
    for (const std::uint8_t byte : mosi) miso.push_back(transfer(byte));
    return miso;
  }
  Bytes ask(std::uint8_t command, const Bytes& data = {}, std::uint8_t special = 0x11) {
    return send(frame(command, data, special));
  }
  Bytes wrong(std::uint8_t command, Error error) const { return error_frame(config.errors, command, error); }
  bool int_low() const { return module->interrupt(); }

  // --- the master ---------------------------------------------------------------------------------------------------
  void level(bool high, int bits = 1) {
    module->set_rxd(now * profibus::kTicksPerCycle, high);
    run(bits * kBit);
  }
  void character(unsigned value) {
    level(false);
    bool odd = false;
    for (unsigned bit = 0; bit < 8; ++bit) {
      level((value >> bit & 1) != 0);
      odd ^= (value >> bit & 1) != 0;
    }
    level(odd);
    level(true);
  }
  /// The data of the answer; {} for E5 or a status, see `answered`.
  Bytes telegram(const Bytes& body) {
    level(true, 40);
    const auto le = static_cast<std::uint8_t>(body.size());
    const std::size_t before = changes.size();
    for (const std::uint8_t head : {std::uint8_t{0x68}, le, le, std::uint8_t{0x68}}) character(head);
    for (const std::uint8_t byte : body) character(byte);
    character(std::accumulate(body.begin(), body.end(), 0U) & 0xFF);
    character(0x16);
    level(true, 400);
    while (levels[kRts] == 1) run(100);
    answered = read_txd(before);
    return answered.size() < 11 ? Bytes{} : Bytes(answered.begin() + 9, answered.end() - 2);
  }
  /// SRD to a SAP; `dsap` < 0: data exchange, whose data begin two bytes earlier.
  Bytes service(int dsap, const Bytes& data = {}, int ssap = 62) {
    if (dsap < 0) {
      telegram(Bytes{kSlave, kMaster, 0x4D} + data);
      return answered.size() < 9 ? Bytes{} : Bytes(answered.begin() + 7, answered.end() - 2);
    }
    return telegram(
        Bytes{kSlave | 0x80, kMaster | 0x80, 0x4D, static_cast<std::uint8_t>(dsap), static_cast<std::uint8_t>(ssap)} +
        data);
  }
  Bytes diagnosis() { return service(60); }
  /// Polls a SAP until it answers with data.
  Bytes poll(int sap, int ssap) {
    for (int i = 0; i < 3; ++i)
      if (const Bytes data = service(sap, {}, ssap); !data.empty()) return data;
    return {};
  }
  void set_prm(const Bytes& user) { service(61, Bytes{0x80, 0, 0, 11, 0x0F, 0x01, 0} + user); }
  bool has(const std::string& reason) const {
    return std::any_of(
        events.begin(), events.end(), [&](const auto& event) { return code(event.reason) == reason; });
  }
  bool exchanging() const { return module->bus().exchanging(); }

  /// The host's 04, Set_Prm and Chk_Cfg: 3 inputs, 3 outputs, as 4.5.1's example. DPV1 with alarms.
  static Bytes initialisation(std::uint8_t prm_size = 5) {
    return Bytes{kSlave, 0x01, 0x0F, 4, 3, 3, prm_size} + Bytes{1, 0, 0, 0, 0x12, 0x34, 10, 20, 30, 0x80, 0xFC, 1} +
           cfg();
  }
  static Bytes cfg() { return {0x50, 0x60, 0x10, 0x20}; }
  static Bytes prm() { return {0x80, 0xFC, 0x05, 0xAA, 0x55}; }  // DPV1, all alarms, 16 at once
  void to_exchange() {
    ASSERT_EQ(ask(0x04, initialisation()), frame(0x04, {}));
    diagnosis();
    set_prm(prm());
    service(62, cfg());
    ASSERT_TRUE(exchanging());
  }

  Config config;
  Way way;
  std::unique_ptr<Module> module;
  std::deque<std::pair<Cycle, std::uint8_t>> coming;  ///< the host's bytes
  std::function<void()> on_heard;                     ///< at each byte of the module
  Cycle now = 0, byte_time = kByte;
  std::uint64_t evaluated = 0;
  std::array<int, kFirstLed + kLeds> levels{};
  std::vector<Change> changes;
  std::vector<profibus::Event> events;
  Bytes heard;
  std::vector<Cycle> begins;  ///< of every byte
  Cycle heard_until = 0;
  Bytes answered;  ///< to the last telegram

 private:
  void deliver(Cycle at) {
    now = at;
    const std::uint8_t byte = coming.front().second;
    coming.pop_front();
    module->receive(now, byte);
    look();
  }
  static void hear_byte(void* self, Cycle begins, Cycle ends, std::uint8_t byte) {
    auto& bench = *static_cast<ModuleBench*>(self);
    bench.heard.push_back(byte);
    bench.begins.push_back(begins);
    bench.heard_until = ends;
    if (bench.on_heard) bench.on_heard();
  }
  static void take_event(void* self, const profibus::Event& event) {
    static_cast<ModuleBench*>(self)->events.push_back(event);
  }
  /// The characters at P-TXD since change `from`.
  Bytes read_txd(std::size_t from) const {
    Bytes bytes;
    Cycle free = 0;
    for (std::size_t i = from; i < changes.size(); ++i) {
      const Change& start = changes[i];
      if (start.pin != kTxd || start.level != 0 || start.at < free) continue;
      unsigned value = 0;
      for (unsigned bit = 0; bit < 8; ++bit)
        value |= static_cast<unsigned>(txd_at(i, start.at + (2 * bit + 3) * kBit / 2)) << bit;
      bytes.push_back(static_cast<std::uint8_t>(value));
      free = start.at + 10 * kBit;
    }
    return bytes;
  }
  int txd_at(std::size_t from, Cycle at) const {
    int level = 1;
    for (; from < changes.size() && changes[from].at <= at; ++from)
      if (changes[from].pin == kTxd) level = changes[from].level;
    return level;
  }
};

}  // namespace dsdpv1::xgate
