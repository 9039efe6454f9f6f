// The host at the SPI port: frames with clocks within and beyond SP2, cut anywhere, too long, too soon after a write.
#include "registers/dsdpv1_regs.hpp"
#include "tb/dsdpv1/cosim/random_serial.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr int kOwnership = 0x014, kUTimer = 0x015;
constexpr int kLeast = 600;        // SP2: 50 ns
constexpr int kLeastPeriod = 250;  // 5.1: below it nothing is ruled
constexpr int kWriteGap = 32'400;  // SP9

class RandomSpi : public RandomSerial {
 public:
  RandomSpi(Random& random, Stimulus& stimulus) : RandomSerial(random, stimulus, HostMode::kSpi) {}

  void take() override {
    if (random_.one_in(3)) ask(kOwnership, 1);
    do write(kOwnership, random_.one_in(8) ? random_.byte() : 2);
    while (random_.one_in(3));
  }
  void give() override {
    if (!random_.one_in(10)) write(kOwnership, 0);
  }

 private:
  void send(const bus::Bytes& telegram, int reply) override;
  bool exchange(int address, const bus::Bytes& bytes) override;
  void own_telegram() override;
  void clocks(Action& action);

  bool wrote_ = false;
};

void RandomSpi::send(const bus::Bytes& telegram, int reply) {
  Action action;
  action.verb = Verb::kSpi;
  action.bytes = finished(telegram);
  if (random_.one_in(10)) reply = random_.below(reply + 12);
  for (int i = 0; i < reply; ++i) action.bytes.push_back(random_.one_in(2) ? 0xFF : random_.byte());
  clocks(action);
  const bool soon = random_.one_in(12);
  action.delay = soon ? random_.below(kWriteGap + 1000) : (wrote_ ? kWriteGap : kLeast) + random_.below(1000);
  if (random_.one_in(30) && !action.bytes.empty())
    action.bits = random_.between(1, 8 * static_cast<int>(action.bytes.size()));
  wrote_ = !telegram.empty() && telegram[0] >> 5 != 0;
  stimulus_.push_back(action);
}

void RandomSpi::clocks(Action& action) {
  const bool legal = !random_.one_in(5);
  const int spread = random_.one_in(4) ? 4000 : 200;
  action.high = legal ? kLeast + random_.below(spread) : random_.between(1, 800);
  action.low = legal ? kLeast + random_.below(spread) : random_.between(1, 800);
  if (action.high + action.low < kLeastPeriod) action.low = kLeastPeriod - action.high;
  action.lead = legal ? kLeast + random_.below(300) : random_.below(700);
  action.lag = legal ? kLeast + random_.below(300) : random_.below(700);
  action.setup = legal ? random_.between(150, 450) : random_.below(700);
  if (random_.one_in(10)) action.pause = random_.below(20'000);
}

/// Inputs also by a read and write telegram (SP16).
bool RandomSpi::exchange(int address, const bus::Bytes& bytes) {
  if (address != regs::kInput || random_.one_in(2)) return false;
  bus::Bytes telegram = {start(2)};
  telegram.insert(telegram.end(), bytes.begin(), bytes.end());
  send(telegram, random_.one_in(3) ? 250 : random_.between(5, 24));
  return true;
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
  bus::Bytes data = random_.bytes(random_.one_in(6) ? 245 : random_.between(1, 20));
  if (!random_.one_in(8)) data[0] = static_cast<std::uint8_t>(data.size() - 1);
  data.insert(data.begin(), start(2));
  send(data, random_.between(4, 40));
}

}  // namespace

std::unique_ptr<RandomHost> make_random_spi(Random& random, Stimulus& stimulus) {
  return std::make_unique<RandomSpi>(random, stimulus);
}

}  // namespace dsdpv1::cosim
