// The host at the parallel port: R_REQ and R_STA, strobes mostly with the times of table 15. Excluded is what its times
// do not allow and docs/rtl.md names: two rises of WR within a cycle.
#include <algorithm>
#include <utility>

#include "kinds/dsdpv1/random/host_verbs.hpp"
#include "kinds/dsdpv1/random/random_host.hpp"

namespace dsdpv1::cosim {
namespace {

constexpr Tick kCycle = profibus::kTicksPerCycle;
constexpr Tick kLeast = 150;  // table 15: Ts, Td are 12.5 ns
constexpr Tick kTw = 375;     // ... Tw is 31.25 ns

class RandomParallel : public RandomHost {
 public:
  RandomParallel(Random& random, Stimulus& stimulus, Part part) : RandomHost(random, stimulus), part_(part) {}
  void hold_through_reset() override;
  void take() override;
  void give() override;
  void write(int address, int value) override;
  void read(int address) override;
  void block(int address, int crc_address, const bus::Bytes& bytes) override;
  void rude() override;
  void break_rules() override;
  void edge(AccessPart part, Tick within) override;

 private:
  Action access(Verb verb);
  void amid();
  void late_straps();
  void late_data();
  void late_address();
  void read_back_at_once();
  void half_owned();
  void floating_data();
  void deselected();
  void shorten(Action& action);
  void take_unseen();
  Tick small_delay() { return mishap(8) ? random_.below(20'000) : random_.below(1000); }

  const Part part_;
};

/// Pins in an order that no access has.
void RandomParallel::rude() {
  constexpr Pin kPins[] = {Pin::kRReq, Pin::kRSta, Pin::kCsr, Pin::kRd, Pin::kA, Pin::kWr, Pin::kDIn};
  for (int i = random_.between(2, 12); i > 0; --i) {
    const Tick delay = random_.one_in(4) ? random_.below(20'000) : random_.below(900);
    const Pin which = random_.pick(kPins);
    int value = random_.below(2);
    if (which == Pin::kA) value = random_.below(0x800);
    if (which == Pin::kDIn) value = random_.below(257) - 1;
    pin(which, value, delay);
  }
  for (const Pin strobe : {Pin::kRd, Pin::kWr, Pin::kCsr}) pin(strobe, 1, 500);
  if (dsdpv1::has_serial_ports(part_)) late_straps();
  give();
  wait(1);
}

/// Too late: the straps of the last reset are in force (R11). Restored afterwards.
void RandomParallel::late_straps() {
  constexpr Pin kStraps[] = {Pin::kMode, Pin::kAdr, Pin::kUbr, Pin::kUiv};
  const Pin strap = random_.pick(kStraps);
  pin(strap, random_.between(1, 3), random_.below(900));
  pin(strap, 0, random_.below(900));
}

/// R_REQ rises, for as long as the chip may see it or longer; or the user comes during a chip access.
void RandomParallel::edge(AccessPart part, Tick within) {
  aim(part, within);
  if (random_.one_in(3)) {
    amid();
  } else if (random_.one_in(2)) {
    take();
    read(random_.below(0x800));
  } else {
    pin(Pin::kRReq, 1, 0);
    pin(Pin::kRReq, 0, random_.between(1, 20 * static_cast<int>(kCycle)));
  }
  give();
}

/// With both of R_REQ and R_STA, one or none, early enough to meet the chip in its access (P12, H2).
void RandomParallel::amid() {
  constexpr int kSoon = 100;
  if (random_.one_in(2)) pin(Pin::kRSta, 1, random_.below(kSoon));
  if (random_.one_in(2)) pin(Pin::kRReq, 1, random_.below(kSoon));
  for (int i = random_.between(1, 2); i > 0; --i) {
    Action action;
    action.verb = random_.one_in(2) ? verb::kRead : verb::kWrite;
    action.address = random_.below(0x800);
    action.value = random_.byte();
    action.delay = action.setup = random_.below(kSoon);
    action.low = kTw;
    action.hold = kLeast;
    push(action);
  }
}

void RandomParallel::break_rules() {
  for (int i = random_.between(1, 4); i > 0; --i) {
    const bool owned = random_.one_in(2);
    if (owned) take();
    switch (random_.below(6)) {
      case 0: late_data(); break;
      case 1: late_address(); break;
      case 2: read_back_at_once(); break;
      case 3: half_owned(); break;
      case 4: floating_data(); break;
      default: deselected(); break;
    }
    if (owned) give();
    wait(10);
  }
}

/// D changes less than Td before WR rises (table 15, P11).
void RandomParallel::late_data() {
  pin(Pin::kA, random_.below(0x800), kLeast);
  pin(Pin::kDIn, random_.byte(), 0);
  pin(Pin::kCsr, 0, 0);
  pin(Pin::kWr, 0, kLeast);
  pin(Pin::kDIn, random_.byte(), random_.between(1, 600));
  pin(Pin::kWr, 1, random_.between(1, static_cast<int>(kLeast) - 1));
  pin(Pin::kCsr, 1, kLeast);
  pin(Pin::kDIn, dsdpv1::kLevelZ, kLeast);
}

/// A changes after RD fell, near the chip's sample (Tc, P5).
void RandomParallel::late_address() {
  pin(Pin::kA, random_.below(0x800), kLeast);
  pin(Pin::kCsr, 0, 0);
  pin(Pin::kRd, 0, kLeast);
  pin(Pin::kA, random_.below(0x800), random_.between(1, 2 * static_cast<int>(kCycle)));
  pin(Pin::kRd, 1, kTw + random_.below(400));
  pin(Pin::kCsr, 1, kLeast);
}

/// Reads the cell just written, while the write is still pending (P8).
void RandomParallel::read_back_at_once() {
  Action access;
  access.address = random_.below(0x800);
  access.value = random_.byte();
  access.low = kTw;
  access.hold = kLeast + random_.below(400);
  access.verb = verb::kWrite;
  push(access);
  access.verb = verb::kRead;
  push(access);
}

/// With R_REQ alone, R_STA alone, or neither if the DPRAM was not taken before (P12).
void RandomParallel::half_owned() {
  const Pin raised = random_.one_in(2) ? Pin::kRReq : Pin::kRSta,
            other = raised == Pin::kRReq ? Pin::kRSta : Pin::kRReq;
  pin(other, 0, random_.below(600));
  pin(raised, random_.one_in(4) ? 0 : 1, random_.below(600));
  for (int i = random_.between(1, 3); i > 0; --i)
    random_.one_in(2) ? read(random_.below(0x800)) : write(random_.below(0x800), random_.byte());
  pin(raised, 0, random_.below(600));
}

void RandomParallel::floating_data() {
  pin(Pin::kA, random_.below(0x800), kLeast);
  pin(Pin::kCsr, 0, 0);
  pin(Pin::kWr, 0, kLeast);
  pin(Pin::kWr, 1, kTw);
  pin(Pin::kCsr, 1, kLeast);
}

/// CSR rises before WR: nothing is written (5.2).
void RandomParallel::deselected() {
  pin(Pin::kA, random_.below(0x800), kLeast);
  pin(Pin::kDIn, random_.byte(), 0);
  pin(Pin::kCsr, 0, 0);
  pin(Pin::kWr, 0, kLeast);
  pin(Pin::kCsr, 1, kTw);
  pin(Pin::kWr, 1, random_.between(1, 400));
  pin(Pin::kDIn, dsdpv1::kLevelZ, kLeast);
}

Action RandomParallel::access(Verb verb) {
  Action action;
  action.verb = verb;
  action.delay = random_.below(300);
  action.setup = random_.between(0, 300);
  action.low = kTw + random_.below(mishap(4) ? 2000 : 300);
  action.hold = random_.one_in(4) ? kLeast : kLeast + random_.below(400);
  if (mishap(12)) shorten(action);
  return action;
}

/// A strobe below Tw, A and D removed before Td has passed, the next access at once.
void RandomParallel::shorten(Action& action) {
  action.low = random_.between(1, static_cast<int>(kTw) - 1);
  action.setup = std::max(action.setup, kCycle - action.low);
  action.hold = random_.below(static_cast<int>(kLeast));
}

void RandomParallel::write(int address, int value) {
  Action action = access(verb::kWrite);
  action.address = address;
  action.value = value;
  push(action);
}

void RandomParallel::read(int address) {
  Action action = access(verb::kRead);
  action.address = address;
  push(action);
}

void RandomParallel::block(int address, int crc_address, const bus::Bytes& bytes) {
  Action action = access(verb::kBlock);
  action.address = address;
  action.crc_address = crc_address;
  action.bytes = bytes;
  if (mishap(12)) action.value = 1 << random_.below(16);
  push(action);
}

void RandomParallel::take() {
  if (mishap(24)) take_unseen();
  Action action;
  action.verb = verb::kTake;
  action.delay = small_delay();
  action.low = random_.between(200, 3000);
  push(action);
}

/// R_REQ too short to be seen by the chip, or R_STA with it before the chip can have answered (H2).
void RandomParallel::take_unseen() {
  pin(Pin::kRReq, 1, small_delay());
  if (random_.one_in(2)) pin(Pin::kRSta, 1, random_.below(4 * static_cast<int>(kCycle)));
  pin(Pin::kRSta, 0, random_.between(1, 3 * static_cast<int>(kCycle)));
  pin(Pin::kRReq, 0, random_.below(2 * static_cast<int>(kCycle)));
}

/// R_REQ and R_STA fall together, or separately in either order (H1).
void RandomParallel::give() {
  if (mishap(6)) {
    const bool request_first = random_.one_in(2);
    pin(request_first ? Pin::kRReq : Pin::kRSta, 0, random_.below(600));
    return pin(request_first ? Pin::kRSta : Pin::kRReq, 0, random_.below(random_.one_in(4) ? 20'000 : 900));
  }
  Action action;
  action.verb = verb::kGive;
  action.delay = random_.below(600);
  push(action);
}

void RandomParallel::hold_through_reset() {
  if (random_.one_in(2)) pin(Pin::kRReq, 1, random_.below(600));
  if (random_.one_in(2)) pin(Pin::kRSta, 1, random_.below(600));
}

}  // namespace

void RandomHost::push(Action action) {
  if (aimed_at_ != AccessPart::kNone) {
    constexpr int kShort = kCycle, kLong = 12 * kShort;  // parts of one cycle, and blocks
    action.during = item_of(std::exchange(aimed_at_, AccessPart::kNone));
    action.within = within_;
    action.delay = random_.between(1, random_.one_in(2) ? kShort - 1 : kLong);
  }
  stimulus_.push_back(std::move(action));
}

void RandomHost::aim(AccessPart part, Tick within) {
  aimed_at_ = part;
  within_ = within;
}

void RandomHost::pin(Pin pin, int value, Tick delay) {
  Action action;
  action.verb = Verb::kPin;
  action.delay = delay;
  action.pin = number(pin);
  action.value = value;
  push(action);
}

void RandomHost::wait(int cycles) {
  Action action;  // D is already released: only the delay remains
  action.verb = Verb::kPin;
  action.delay = cycles * kCycle + random_.below(static_cast<int>(kCycle));
  action.pin = number(Pin::kDIn);
  action.value = dsdpv1::kLevelZ;
  push(action);
}

std::unique_ptr<RandomHost> make_random_parallel(Random& random, Stimulus& stimulus, Part part) {
  return std::make_unique<RandomParallel>(random, stimulus, part);
}

}  // namespace dsdpv1::cosim
