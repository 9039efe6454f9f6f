// The host at the SPI port: frames with clocks within and beyond SP2, cut anywhere, too long, too soon after another,
// broken by a pulse of XSS, and with SCK high where XSS changes. Excluded is what no ruling covers: SCK periods below a
// cycle in a frame (5.1), and XSS that rises and falls at one tick.
#include <utility>

#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "kinds/dsdpv1/random/random_serial.hpp"
#include "registers/dsdpv1_regs.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kOwnership = 0x014, kUTimer = 0x015;
constexpr int kLeast = 600;        // SP2: 50 ns
constexpr int kLeastPeriod = 250;  // 5.1: no ruling covers less
constexpr int kWriteGap = 32'400;  // SP9
constexpr int kPulse = 700;        // XSS high: seen by no, one or two edges of CLK

class RandomSpi : public RandomSerial {
 public:
  RandomSpi(Random& random, Stimulus& stimulus) : RandomSerial(random, stimulus, HostMode::kSpi) {}

  void take() override {
    if (mishap(3)) ask(kOwnership, 1);
    do write(kOwnership, mishap(8) ? random_.byte() : 2);
    while (random_.one_in(3));
  }
  void give() override {
    if (!mishap(10)) write(kOwnership, 0);
  }
  void edge(AccessPart part, Tick within) override;
  void hurry() override;
  void break_rules() override;
  int slowness() const override { return 2; }

 private:
  void send(const bus::Bytes& telegram, int reply) override;
  bool exchange(int address, const bus::Bytes& bytes) override;
  void own_telegram() override;
  void third(int address, const bus::Bytes& bytes) override;
  void clocks(Action& action);
  Tick pause_before();
  void broken(Action action);
  void overrun();
  void keep();
  void clock_high_at_the_end();

  bool wrote_ = false;
  std::size_t request_ = 0;  ///< bytes of the last frame before its reply
};

void RandomSpi::send(const bus::Bytes& telegram, int reply) {
  Action action;
  action.verb = verb::kSpi;
  action.bytes = finished(telegram);
  request_ = action.bytes.size();
  if (mishap(10)) reply = random_.below(reply + 12);
  for (int i = 0; i < reply; ++i) action.bytes.push_back(random_.one_in(2) ? 0xFF : random_.byte());
  clocks(action);
  action.delay = pause_before();
  wrote_ = !telegram.empty() && telegram[0] >> 5 != 0;
  if (mishap(40)) clock_high_at_the_end();
  if (!action.bytes.empty() && mishap(40))
    pin(Pin::kSck, 1, random_.between(1, kPulse));  // the frame's first rise does not count
  if (action.bytes.size() > 1 && mishap(30)) return broken(std::move(action));
  if (mishap(30) && !action.bytes.empty()) action.bits = random_.between(1, 8 * static_cast<int>(action.bytes.size()));
  push(std::move(action));
}

/// XSS high before a frame: as required by SP2 and SP9, too short after a write, or too short after any frame.
Tick RandomSpi::pause_before() {
  if (mishap(24)) return random_.between(1, kPulse);
  if (mishap(12)) return random_.below(kWriteGap + 1000);
  return (wrote_ ? kWriteGap : kLeast) + random_.below(1000);
}

/// A pulse of XSS in the frame, after a whole byte or within one: a second frame has the rest, or, as seen by CLK, the
/// same one continues.
void RandomSpi::broken(Action action) {
  Action rest = action;
  const int place = random_.between(1, static_cast<int>(action.bytes.size()) - 1);
  action.bytes.resize(static_cast<std::size_t>(place));
  if (random_.one_in(2)) action.bits = random_.between(1, 8 * place);
  rest.bytes.erase(rest.bytes.begin(), rest.bytes.begin() + place);
  rest.delay = random_.between(1, kPulse);
  push(std::move(action));
  push(std::move(rest));
}

/// A frame with one rise of SCK: XSS rises before SCK has fallen.
void RandomSpi::clock_high_at_the_end() {
  pin(Pin::kXss, 0, random_.between(1, 2 * kLeast));
  pin(Pin::kSck, 1, random_.below(kPulse));
  pin(Pin::kXss, 1, random_.between(1, kPulse));
  pin(Pin::kSck, 0, random_.between(kLeastPeriod, kPulse));
}

void RandomSpi::clocks(Action& action) {
  const bool legal = !mishap(5);
  const int spread = mishap(4) ? 4000 : 200;
  action.high = legal ? kLeast + random_.below(spread) : random_.between(1, 800);
  action.low = legal ? kLeast + random_.below(spread) : random_.between(1, 800);
  if (action.high + action.low < kLeastPeriod) action.low = kLeastPeriod - action.high;
  action.lead = legal ? kLeast + random_.below(300) : random_.one_in(8) ? 0 : random_.below(700);
  action.lag = legal ? kLeast + random_.below(300) : random_.one_in(8) ? 0 : random_.below(700);
  action.setup = legal ? random_.between(150, 450) : random_.below(700);
  if (mishap(10)) action.pause = random_.below(20'000);
}

/// Inputs may also go in a read and write telegram (SP16).
bool RandomSpi::exchange(int address, const bus::Bytes& bytes) {
  if (address != regs::kInput || random_.one_in(2)) return false;
  bus::Bytes telegram = {start(2)};
  telegram.insert(telegram.end(), bytes.begin(), bytes.end());
  send(telegram, random_.one_in(3) ? 250 : random_.between(5, 24));
  return true;
}

/// A read and write: `bytes` after a length byte that counts them.
void RandomSpi::third(int /*address*/, const bus::Bytes& bytes) {
  bus::Bytes telegram = {start(2), static_cast<std::uint8_t>(bytes.size())};
  telegram.insert(telegram.end(), bytes.begin(), bytes.end());
  send(telegram, random_.between(4, 40));
}

void RandomSpi::break_rules() {
  RandomSerial::break_rules();
  if (random_.one_in(6)) overrun();
  if (random_.one_in(6)) keep();
}

/// Keeps the DPRAM until U_Timer ends the ownership (SP17).
void RandomSpi::keep() {
  constexpr int kUTimerEnds = 21'000;  // cycles
  write(kUTimer, 1);
  take();
  wait(kUTimerEnds);
}

/// A long write, and as soon as frames are accepted again one so fast that it is judged before all bytes are written
/// (SP13).
void RandomSpi::overrun() {
  constexpr int kArea = 0x5D0, kMost = 245;
  write_bytes(kArea, random_.bytes(kMost));
  hurry();
  write(kArea, random_.byte());
  Action& frame = stimulus_.back();
  if (frame.verb != verb::kSpi) return;
  frame.delay = kWriteGap + random_.below(1000);
  frame.high = frame.low = random_.between(kLeastPeriod / 2, kLeastPeriod);
  frame.lead = frame.setup = kLeastPeriod / 2;
}

/// XSS falls: a frame, or a pulse without a bit.
void RandomSpi::edge(AccessPart part, Tick within) {
  aim(part, within);
  if (random_.one_in(2)) return ask(random_.below(0x20), random_.between(1, 4));
  pin(Pin::kXss, 0, 0);
  pin(Pin::kXss, 1, random_.between(1, 2 * kPulse));
}

/// XSS rises after the request's last byte.
void RandomSpi::hurry() {
  Action& frame = stimulus_.back();
  if (frame.verb == verb::kSpi && frame.bytes.size() > request_) frame.bytes.resize(request_);
}

void RandomSpi::own_telegram() {
  switch (random_.below(6)) {
    case 0: return take();
    case 1: return give();
    case 2: return write(kUTimer, random_.below(2));
    case 3: return ask(random_.between(kOwnership - 2, kOwnership), random_.between(1, 4));
    case 4: return write_bytes(kOwnership - random_.below(3), random_.bytes(random_.between(1, 6)));
    default: break;
  }
  bus::Bytes data = random_.bytes(is_long() ? 245 : random_.between(1, 20));
  if (!random_.one_in(8)) data[0] = static_cast<std::uint8_t>(data.size() - 1);
  data.insert(data.begin(), start(2));
  send(data, random_.between(4, 40));
}

}  // namespace

std::unique_ptr<RandomHost> make_random_spi(Random& random, Stimulus& stimulus) {
  return std::make_unique<RandomSpi>(random, stimulus);
}

}  // namespace dsdpv1::cosim
