// The host at the UART port: telegrams with broken characters and bits too long or too short, silences near the
// interval, breaks, characters during the chip's reply.
#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "kinds/dsdpv1/random/random_serial.hpp"
#include "model/dsdpv1/config.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kInterval = 0x019, kTsdr = 0x01A;
constexpr int kQuick = 6;  // UBR: 460.8 kbit/s
constexpr int kInputs = 0x130, kDiagnosis = 0x227, kC1 = 0x5D0, kC2 = 0x6D0;

/// The interval of a code, in half characters (UA3).
int halves_of(int code) { return static_cast<int>(dsdpv1::Config{}.uart_gaps.at(static_cast<std::size_t>(code))); }

class RandomUart : public RandomSerial {
 public:
  RandomUart(Random& random, Stimulus& stimulus) : RandomSerial(random, stimulus, HostMode::kUart) {}

  void take() override {}
  void give() override {}
  void edge(AccessPart part, Tick within) override;
  void hurry() override;
  int slowness() const override { return 8; }
  bool is_quick() const override { return ubr_ >= kQuick; }

 private:
  void send(const bus::Bytes& telegram, int reply) override;
  bool exchange(int address, const bus::Bytes& bytes) override;
  void own_telegram() override;
  void third(int address, const bus::Bytes& bytes) override;
  void break_it(Action& action);
  void low_line(int bit);
};

void RandomUart::send(const bus::Bytes& telegram, int reply) {
  Action action;
  action.verb = verb::kUart;
  action.bytes = finished(telegram);
  if (action.bytes.empty()) return;
  action.rate = mishap(60) ? random_.between(kQuick, 7) : ubr_;
  if (!is_quick()) action.rate = ubr_;
  const Tick bit = uart_bit(ubr_);
  action.delay = random_.one_in(4) ? random_.below(static_cast<int>(bit)) : bit * random_.below(mishap(2) ? 60 : 12);
  if (random_.one_in(5)) action.ppm = random_.between(-20'000, 20'000);
  if (mishap(20)) action.ppm = random_.between(-80'000, 80'000);  // beyond the tolerance of a stop bit's sample
  if (mishap(12)) break_it(action);
  if (is_quick() && mishap(24)) low_line(static_cast<int>(bit));
  // The host sometimes sends before the end of the reply (UA16).
  action.reply_bits = mishap(12) ? random_.below(40) : 60 + (reply > 0 ? random_.below(300) : 0);
  if (!is_quick()) action.delay = 0;
  push(action);
}

void RandomUart::break_it(Action& action) {
  constexpr int kHalfCharacter = 5500;  // millibits
  const auto at = static_cast<std::size_t>(random_.below(static_cast<int>(action.bytes.size())));
  switch (random_.below(6)) {
    case 0: action.faults.wrong_parity_at = at; break;
    case 1: action.faults.missing_stop_at = at; break;
    case 2: action.faults.wrong_parity_at = action.faults.missing_stop_at = at; break;
    case 3:
      action.faults.gap_before = at;
      action.faults.gap_millibits =
          random_.one_in(2) ? halves_of(uiv_) * kHalfCharacter + random_.between(-600, 600) : random_.below(60'000);
      break;
    case 4:
      action.faults.truncate_after = at;
      action.faults.truncate_bits = random_.below(11);
      break;
    default:
      action.faults.glitch_at = at;
      action.faults.glitch = {random_.below(11'000), random_.between(1, 1500)};
      break;
  }
}

/// RXD low for less than a bit, for some of a character, or for longer than one: a spike, a wrong character, a break.
void RandomUart::low_line(int bit) {
  pin(Pin::kRxd, 0, random_.below(bit));
  pin(Pin::kRxd, 1, random_.between(1, bit * (random_.one_in(2) ? 1 : 40)));
}

bool RandomUart::exchange(int address, const bus::Bytes& bytes) {
  const bool area = address == kInputs || address == kDiagnosis || address == kC1 || address == kC2;
  if (!area || random_.one_in(3)) return false;
  third(address, bytes);
  return true;
}

void RandomUart::third(int address, const bus::Bytes& bytes) {
  const auto function = static_cast<std::uint8_t>(mishap(4) ? random_.byte() : address == kDiagnosis ? 3 : 1);
  bus::Bytes telegram = {start(2), function, static_cast<std::uint8_t>(address >> 8),
                         static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(bytes.size())};
  telegram.insert(telegram.end(), bytes.begin(), bytes.end());
  send(telegram, 250);
}

/// RXD falls: a telegram, a spike, a character or a break. If the chip is replying, waits for the end of the reply
/// first.
void RandomUart::edge(AccessPart part, Tick within) {
  constexpr int kReply = 2000;  // cycles
  aim(part, within);
  random_.one_in(3) ? ask(random_.below(0x20), 1) : low_line(static_cast<int>(uart_bit(ubr_)));
  wait(kReply);
}

void RandomUart::hurry() {
  if (stimulus_.back().verb == verb::kUart) stimulus_.back().reply_bits = 0;
}

void RandomUart::own_telegram() {
  constexpr int kAreas[] = {kInputs, kInputs, kInputs, kDiagnosis, kC1, kC2};
  const int what = random_.below(8);
  if (what == 0) return write(kInterval, random_.below(10));
  if (what == 1) return write(kTsdr, random_.one_in(3) ? random_.byte() : random_.below(40));
  bus::Bytes data = random_.bytes(is_long() ? random_.between(238, 255) : random_.between(1, 12));
  if (random_.one_in(2)) data[0] = static_cast<std::uint8_t>(data.size() - 1);
  if (!exchange(random_.pick(kAreas), data)) ask(random_.one_in(2) ? 0x00B : 0x319, random_.between(1, 8));
}

}  // namespace

std::unique_ptr<RandomHost> make_random_uart(Random& random, Stimulus& stimulus) {
  return std::make_unique<RandomUart>(random, stimulus);
}

}  // namespace dsdpv1::cosim
