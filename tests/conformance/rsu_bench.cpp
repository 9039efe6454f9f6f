#include "tests/conformance/rsu_bench.hpp"

#include <algorithm>
#include <array>

namespace dsdpv1::conformance {
namespace {

Config with(Config config, Engine engine) {
  config.part = Part::kRsu;
  config.engine = engine;
  return config;
}

constexpr std::uint32_t kAccessPins = mask(Pin::kLReq) | mask(Pin::kLSta);
constexpr std::array<int, 8> kBits = {5000, 2500, 1250, 833, 417, 208, 104, 26};  // UA1

void keep_pin(void* self, Tick at, Pin pin, Level level) {
  static_cast<std::vector<PinChange>*>(self)->push_back({at, pin, level});
}
void keep_event(void* self, const profibus::Event& event) {
  static_cast<std::vector<profibus::Event>*>(self)->push_back(event);
}

std::string words(const PinChange& change) {
  return std::string(name(change.pin)) + "=" + std::to_string(change.level) + " at tick " + std::to_string(change.at);
}
std::string words(const profibus::Event& event) { return std::to_string(event.at) + ": " + describe(event); }

bool same(const profibus::Event& a, const profibus::Event& b) {
  return a.at == b.at && a.reason == b.reason && a.a == b.a && a.b == b.b && a.c == b.c;
}

}  // namespace

Bytes part_of(const Bytes& bytes, std::size_t from, std::size_t count) {
  const auto begin = std::min(from, bytes.size()), end = std::min(from + count, bytes.size());
  return {bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end)};
}

RsuBench::RsuBench(const Straps& straps, Config config)
    : skip_(with(config, Engine::kSkip)),
      step_(with(config, Engine::kStep)),
      doze_(with(config, Engine::kSkip)),
      bit_(kBits.at(static_cast<std::size_t>(straps.rate))) {
  skip_.watch({&keep_pin, &skip_trace_}, outputs_of(Part::kRsu));
  step_.watch({&keep_pin, &step_trace_}, outputs_of(Part::kRsu));
  doze_.watch({&keep_pin, &doze_trace_}, outputs_of(Part::kRsu) & ~kAccessPins);
  skip_.on_event({&keep_event, &skip_events_});
  step_.on_event({&keep_event, &step_events_});
  doze_.on_event({&keep_event, &doze_events_});
  set(0, Pin::kMode, static_cast<Level>(straps.mode));
  set(0, Pin::kAdr, straps.address);
  set(0, Pin::kUbr, straps.rate);
  set(0, Pin::kUiv, straps.interval);
}

void RsuBench::set(Tick at, Pin pin, Level level) {
  skip_.set(at, pin, level);
  step_.set(at, pin, level);
  doze_.set(at, pin, level);
  now_ = at;
}

void RsuBench::run_until(Tick until) {
  skip_.advance(until);
  step_.advance(until);
  doze_.advance(until);
  now_ = until;
  compare();
}

void RsuBench::compare() {
  std::vector<PinChange>& step = step_trace_;
  for (; pins_compared_ < std::min(skip_trace_.size(), step.size()); ++pins_compared_)
    ASSERT_TRUE(skip_trace_[pins_compared_] == step[pins_compared_])
        << "skip: " << words(skip_trace_[pins_compared_]) << ", step: " << words(step[pins_compared_]);
  ASSERT_EQ(skip_trace_.size(), step.size())
      << words(skip_trace_.size() > step.size() ? skip_trace_[pins_compared_] : step[pins_compared_]);
  for (; events_compared_ < std::min({skip_events_.size(), step_events_.size(), doze_events_.size()});
       ++events_compared_) {
    const profibus::Event& skip = skip_events_[events_compared_];
    ASSERT_TRUE(same(skip, step_events_[events_compared_]))
        << "skip " << words(skip) << ", step " << words(step_events_[events_compared_]);
    ASSERT_TRUE(same(skip, doze_events_[events_compared_]))
        << "skip " << words(skip) << ", doze " << words(doze_events_[events_compared_]);
  }
  ASSERT_EQ(skip_events_.size(), step_events_.size()) << "at tick " << now_;
  ASSERT_EQ(skip_events_.size(), doze_events_.size()) << "at tick " << now_;
  for (; doze_compared_ < skip_trace_.size(); ++doze_compared_) {  // L_REQ and L_STA are not watched there
    if ((mask(skip_trace_[doze_compared_].pin) & kAccessPins) != 0) continue;
    ASSERT_LT(doze_trace_compared_, doze_trace_.size()) << words(skip_trace_[doze_compared_]);
    ASSERT_TRUE(skip_trace_[doze_compared_] == doze_trace_[doze_trace_compared_++]);
  }
  ASSERT_EQ(doze_trace_compared_, doze_trace_.size()) << "at tick " << now_;
  ASSERT_EQ(doze_.status().accesses, step_.status().accesses);
  restorer_.compared({&skip_, &step_, &doze_});
}

void RsuBench::power_on() {
  set(5000, Pin::kReset, 1);
  run_until(2100 * 250);
}

void RsuBench::reset_for(Cycle cycles) {
  set(now_, Pin::kReset, 0);
  run_cycles(cycles);
  set(now_, Pin::kReset, 1);
}

Bytes RsuBench::peek(std::uint16_t cell, int count) const {
  Bytes bytes;
  for (int i = 0; i < count; ++i) bytes.push_back(skip_.peek(static_cast<std::uint16_t>(cell + i)));
  return bytes;
}

void RsuBench::poke(std::uint16_t cell, std::uint8_t value) {
  for (Chip* chip : {&skip_, &step_, &doze_}) chip->poke(cell, value);
}

std::vector<PinChange> RsuBench::changes(Pin pin) const {
  std::vector<PinChange> found;
  for (const PinChange& change : skip_trace_)
    if (change.pin == pin) found.push_back(change);
  return found;
}

int RsuBench::count(profibus::Reason reason) const {
  return static_cast<int>(std::count_if(
      skip_events_.begin(), skip_events_.end(), [&](const profibus::Event& event) { return event.reason == reason; }));
}

profibus::Event RsuBench::last(profibus::Reason reason) const {
  for (auto event = skip_events_.rbegin(); event != skip_events_.rend(); ++event)
    if (event->reason == reason) return *event;
  ADD_FAILURE() << "no " << profibus::code(reason);
  return {};
}

void RsuBench::forget_events() {
  compare();
  skip_events_.clear();
  step_events_.clear();
  doze_events_.clear();
  skip_trace_.clear();
  step_trace_.clear();
  doze_trace_.clear();
  pins_compared_ = events_compared_ = doze_compared_ = doze_trace_compared_ = 0;
}

// --- SPI -------------------------------------------------------------------------------------------------------------

Bytes RsuBench::clock(const Bytes& mosi, const Frame& frame) {
  Bytes miso;
  if (!mosi.empty()) set(now_, Pin::kMosi, static_cast<Level>(mosi[0] >> 7));
  for (std::size_t i = 0; i < mosi.size(); ++i) {
    unsigned byte = 0;
    const bool last = i + 1 == mosi.size();
    const int bits = last && frame.bits > 0 ? frame.bits : 8;
    for (int bit = 0; bit < bits; ++bit) {
      run_until(now_ + frame.low);
      byte = byte << 1 | (level(Pin::kMiso) == 1 ? 1U : 0U);
      set(now_, Pin::kSck, 1);
      run_until(now_ + frame.high);
      set(now_, Pin::kSck, 0);
      const std::size_t next = bit == 7 ? i + 1 : i;
      if (next < mosi.size()) set(now_, Pin::kMosi, static_cast<Level>(mosi[next] >> (bit == 7 ? 7 : 6 - bit) & 1));
    }
    miso.push_back(static_cast<std::uint8_t>(byte));
  }
  return miso;
}

Bytes RsuBench::spi(const Bytes& mosi, const Frame& frame) {
  set(now_, Pin::kXss, 0);
  if (!mosi.empty()) set(now_, Pin::kMosi, static_cast<Level>(mosi[0] >> 7));
  run_until(now_ + frame.lead - frame.low);
  Bytes miso = clock(mosi, frame);
  run_until(now_ + frame.lag);
  if (!frame.stays) set(now_, Pin::kXss, 1);
  return miso;
}

Bytes RsuBench::ask(const Bytes& request, std::size_t reply) {
  Bytes mosi = request;
  mosi.resize(request.size() + reply, 0xFF);
  const Bytes miso = spi(mosi);
  EXPECT_EQ(part_of(miso, 0, request.size()), Bytes(request.size(), 0xFF)) << "before the reply";
  run_until(now_ + 33000);
  return part_of(miso, request.size(), reply);
}

Bytes RsuBench::read(std::uint16_t address, std::uint8_t length) {
  const Bytes reply = ask(read_telegram(address, length), length + 4U);
  EXPECT_EQ(reply[0], 0x81);
  EXPECT_EQ(reply[1], 0x00);
  EXPECT_EQ(reply, with_crc(part_of(reply, 0, length + 2U)));
  return part_of(reply, 2, length);
}

void RsuBench::write(std::uint16_t address, const Bytes& data) {
  EXPECT_EQ(ask(write_telegram(address, data), 4), with_crc({0xA1, 0x00}));
}

void RsuBench::claim() {
  for (int i = 0; i < 100; ++i)
    if (ask(write_telegram(0x014, {0x02}), 4) == with_crc({0xA1, 0x00})) return;
  ADD_FAILURE() << "never granted";
}

// --- UART ------------------------------------------------------------------------------------------------------------

void RsuBench::send(std::uint8_t byte, const Character& how) {
  unsigned frame = static_cast<unsigned>(byte) << 1;
  const bool parity = ((__builtin_popcount(byte) & 1) != 0) != how.parity_wrong;
  frame |= (parity ? 1U : 0U) << 9 | (how.no_stop ? 0U : 1U) << 10;
  for (int i = 0; i < 11; ++i) {
    set(now_, Pin::kRxd, static_cast<Level>(frame >> i & 1));
    run_until(now_ + Tick{bit_} * 250);
  }
}

void RsuBench::send(const Bytes& bytes) {
  for (const std::uint8_t byte : bytes) send(byte, {});
}

Bytes RsuBench::talk(const Bytes& request) {
  send(request);
  const Tick from = now_;
  const Tick silence = Tick{100} * bit_ * 250;
  run_until(now_ + silence + Tick{300} * bit_ * 250);
  for (;;) {
    const std::vector<PinChange> txd = changes(Pin::kTxd);
    if (txd.empty() || txd.back().at + silence < now_) break;
    run_until(now_ + silence);
  }
  return sent_since(from);
}

Bytes RsuBench::sent_since(Tick from) const {
  std::vector<PinChange> txd;
  for (const PinChange& change : changes(Pin::kTxd))
    if (change.at >= from) txd.push_back(change);
  const auto level_at = [&](Tick at) {
    Level level = 1;
    for (const PinChange& change : txd)
      if (change.at <= at) level = change.level;
    return level;
  };
  Bytes bytes;
  const Tick bit = Tick{bit_} * 250;
  for (Tick start = txd.empty() ? 0 : txd[0].at; !txd.empty() && level_at(start) == 0; start += 11 * bit) {
    unsigned frame = 0;
    for (int i = 0; i < 11; ++i) frame |= static_cast<unsigned>(level_at(start + i * bit + bit / 2)) << i;
    EXPECT_EQ(frame & 1U, 0U);
    EXPECT_EQ(__builtin_popcount(frame >> 1 & 0x1FFU) & 1, 0) << "parity";
    EXPECT_EQ(frame >> 10, 1U) << "stop bit";
    bytes.push_back(static_cast<std::uint8_t>(frame >> 1 & 0xFFU));
    if (start + 11 * bit >= now_) break;
  }
  return bytes;
}

}  // namespace dsdpv1::conformance
