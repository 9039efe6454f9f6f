#include "tests/spc3/bench.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string_view>

namespace dsdpv1::spc3_test {
namespace {

constexpr std::uint8_t kSrdFirst = 0x6D;  // SRD high, FCB = 1, FCV = 0: the start of a series, always executed
constexpr std::uint8_t kSdnHigh = 0x46;

spc3::Config with(spc3::Config config, spc3::Engine engine) {
  config.engine = engine;
  return config;
}

spc3::Config named(spc3::Config config, Variant variant) {
  config.variant = variant;
  return config;
}

// SPC3_FORCED, name=value: a parameter of all chips, whatever the test says (parameters_test.cpp).
spc3::Config forced(spc3::Config config) {
  static const char* const text = std::getenv("SPC3_FORCED");
  const char* const equals = text == nullptr ? nullptr : std::strchr(text, '=');
  if (equals == nullptr) return config;
  const std::string_view parameter(text, static_cast<std::size_t>(equals - text));
  const auto value = static_cast<std::uint32_t>(std::strtoul(equals + 1, nullptr, 10));
#define SPC3_PARAMETER(name, ...) \
  if (parameter == #name) config.name = value;
#include "model/spc3/parameters.inc"
  return config;
}

std::string words(const PinChange& change) {
  return std::string(spc3::name(change.pin)) + "=" + std::to_string(change.level) + " at cycle " +
         std::to_string(change.at / profibus::kTicksPerCycle);
}
std::string words(const profibus::Event& event) {
  return std::string(profibus::code(event.reason)) + " at cycle " +
         std::to_string(event.at / profibus::kTicksPerCycle) + ": " + spc3::describe(event);
}
bool same(const PinChange& a, const PinChange& b) { return a.at == b.at && a.pin == b.pin && a.level == b.level; }
bool same(const profibus::Event& a, const profibus::Event& b) {
  return a.at == b.at && a.reason == b.reason && a.a == b.a && a.b == b.b && a.c == b.c;
}

template <class T>
void compare_lists(const std::vector<T>& skip, const std::vector<T>& step, std::size_t& compared) {
  for (; compared < skip.size() && compared < step.size(); ++compared)
    ASSERT_TRUE(same(skip[compared], step[compared]))
        << "skip: " << words(skip[compared]) << "\nstep: " << words(step[compared]);
  ASSERT_EQ(skip.size(), step.size()) << "one did more, first: "
                                      << words(skip.size() > step.size() ? skip[compared] : step[compared]);
}

std::optional<std::uint8_t> optional_sap(int sap) {
  return sap < 0 ? std::optional<std::uint8_t>{} : std::optional<std::uint8_t>{static_cast<std::uint8_t>(sap)};
}

}  // namespace

// --- both chips ------------------------------------------------------------------------------------------------------

Twins::Twins(bus::Segment& segment, const spc3::Config& config, Engines engines)
    : twin_(engines == Engines::kStepAndSkip),
      segment_(segment),
      station_(segment.attach("chip", this)),
      skip_(with(config, spc3::Engine::kSkip)),
      step_(with(config, spc3::Engine::kStep)) {
  skip_.watch({&on_skip_pin, this}, twin_ ? spc3::kOutputPins : mask(Pin::kTxd) | mask(Pin::kRts));
  if (!twin_) return;
  step_.watch({&on_step_pin, this}, spc3::kOutputPins);
  skip_.on_event({&on_skip_event, this});
  step_.on_event({&on_step_event, this});
  segment.attach("step", &ear_);
}

std::uint8_t Twins::load(Cycle cycle, Address address) {
  announce();
  hear();
  const std::uint8_t value = skip_.load(cycle, address);
  leave_run(skip_.now());
  if (twin_) EXPECT_EQ(step_.load(cycle, address), value) << std::hex << address;
  return value;
}

void Twins::store(Cycle cycle, Address address, std::uint8_t value) {
  announce();
  hear();
  skip_.store(cycle, address, value);
  leave_run(skip_.now());
  if (twin_) step_.store(cycle, address, value);
}

void Twins::set(Tick at, Pin pin, spc3::Level level) {
  announce();
  hear();
  skip_.set(at, pin, level);
  leave_run(at);
  if (twin_) step_.set(at, pin, level);
}

spc3::Level Twins::sample(Tick at) {
  announce();
  hear();
  const spc3::Level level = skip_.sample(at);
  if (twin_) EXPECT_EQ(step_.sample(at), level);
  return level;
}

void Twins::poke(Address address, std::uint8_t value) {
  skip_.poke(address, value);
  if (twin_) step_.poke(address, value);
}

void Twins::line_changed(Tick at, bool level) {
  const profibus::Unheard may_wait = skip_.unheard();
  if (at >= may_wait.from && at < may_wait.until)
    return unheard_.push_back({at, Pin::kRxd, level ? spc3::Level{1} : spc3::Level{0}});
  announce();
  hear();
  skip_.set(at, Pin::kRxd, level ? 1 : 0);
  leave_run(at);
}

// One that the filter has skipped is for others: it comes late, and must be taken.
bool Twins::run_begins(const bus::CharacterRun& run) {
  const int to = profibus::addressee(run.bytes, run.size);
  if ((to == skip_.address() || to == profibus::kBroadcast) && ++own_runs_ % 2 == 0) return false;
  announce();
  hear();
  const bool taken =
      skip_.hear(run.start, {run.start, run.bit / profibus::kTicksPerCycle, run.bytes, static_cast<int>(run.size)});
  if (taken) ++runs_taken;
  return taken;
}

void Twins::run_cut(Tick at, bool /*level*/) {
  announce();
  hear();
  skip_.leave_run(at);
}

/// Also all that the line has for skip_, which then receives everything until filter().
void Twins::hear() {
  segment_.hear(station_);
  segment_.set_filter(station_, {});
  for (const PinChange& change : unheard_) skip_.hear(change.at, change.level != 0);
  unheard_.clear();
}

void Twins::leave_run(Tick at) {
  if (!skip_.left_run()) return;
  segment_.cut_run(at);
  skip_.leave_run(at);
}

void Twins::filter() {
  const profibus::Unconcerned unconcerned = skip_.unconcerned();
  segment_.set_filter(station_, {&profibus::addressee, unconcerned.from, unconcerned.bit * profibus::kTicksPerCycle,
                                 unconcerned.address});
}

void Twins::run(Tick now) {
  hear();
  skip_.advance(now);
  leave_run(now);
  filter();
}

void Twins::compare(Tick at) {
  announce();
  hear();
  skip_.advance(at);
  leave_run(at);
  if (twin_) compare_with_step(at);
  filter();
}

void Twins::compare_with_step(Tick at) {
  step_.advance(at);
  compare_traces();
  if (++comparisons_ % restored == 0) restore_one(at);
}

// In a run only its own state: that of the other expects changes of the line.
void Twins::restore_one(Tick at) {
  const unsigned way = comparisons_ / restored;
  spc3::Chip &saved = way % 3 == 0 ? step_ : skip_, &one = way % 2 == 0 ? skip_ : step_;
  if (&saved != &one) segment_.cut_run(at);
  const std::vector<std::uint8_t> state = saved.save();
  one.restore(state.data(), state.size());
  ASSERT_TRUE(one.save() == state) << "at tick " << one.now();
}

void Twins::compare_traces() {
  compare_lists(trace, step_trace_, compared_pins_);
  compare_lists(events, step_events_, compared_events_);
  const spc3::Status skip = skip_.status(), step = step_.status();
  ASSERT_EQ(skip.telegrams_received, step.telegrams_received);
  ASSERT_EQ(skip.data_exchanges, step.data_exchanges);
}

void Twins::on_skip_pin(void* self, Tick at, Pin pin, spc3::Level level) {
  auto& twins = *static_cast<Twins*>(self);
  if (twins.twin_) twins.trace.push_back({at, pin, level});
  if (pin == Pin::kTxd || pin == Pin::kRts)
    twins.segment_.drive(twins.station_, at, twins.skip_.level(Pin::kRts) != 0, twins.skip_.level(Pin::kTxd) != 0);
}
void Twins::on_step_pin(void* self, Tick at, Pin pin, spc3::Level level) {
  static_cast<Twins*>(self)->step_trace_.push_back({at, pin, level});
}
void Twins::on_skip_event(void* self, const profibus::Event& event) {
  static_cast<Twins*>(self)->events.push_back(event);
}
void Twins::on_step_event(void* self, const profibus::Event& event) {
  static_cast<Twins*>(self)->step_events_.push_back(event);
}

// --- the user --------------------------------------------------------------------------------------------------------

Bench::Bench(Variant variant, spc3::Config config, Engines engines)
    : twins(segment, forced(named(config, variant)), engines), requester(segment), variant_(variant) {
  timeline.check_announcements();
  timeline.add(twins);
  timeline.add(requester);
}

void Bench::run_until(Tick until) {
  timeline.run_until(until);
  twins.compare(until);
}

void Bench::acknowledge(std::uint16_t events) {
  store(regs::kIar, static_cast<std::uint8_t>(events & 0xFF));
  store(regs::kIar + 1, static_cast<std::uint8_t>(events >> 8));
}

Bytes Bench::buffer(Address pointer, int size) {
  const int begin = load(pointer) * 8;
  Bytes bytes;
  for (int i = 0; i < size; ++i) bytes.push_back(load(static_cast<Address>(begin + i)));
  return bytes;
}

void Bench::fill(Address pointer, const Bytes& bytes) {
  const int begin = load(pointer) * 8;
  for (std::size_t i = 0; i < bytes.size(); ++i) store(static_cast<Address>(begin + static_cast<int>(i)), bytes[i]);
}

int Bench::give_inputs(const Bytes& bytes) {
  const unsigned user = load(regs::kDinSm) >> 4 & 3U;
  fill(static_cast<Address>(regs::kOrgDinPointer + user - 1), bytes);
  return load(regs::kNewDin);
}

Bytes Bench::fetch_outputs(int* answer) {
  const std::uint8_t given = load(regs::kNextDout);
  if (answer != nullptr) *answer = given;
  return buffer(static_cast<Address>(regs::kOrgDoutPointer + (given & 3U) - 1), load(regs::kOrgDoutLength));
}

void Bench::power_on() {
  run_cycles(10);
  twins.set(now(), Pin::kReset, 0);
  run_cycles(10);
}

void Bench::initialise(const Organisation& given) {
  organisation = given;
  address = given.address;
  const auto cells = [this](Address first, const Bytes& bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) store(static_cast<Address>(first + i), bytes[i]);
  };
  const auto low = [](unsigned word) { return static_cast<std::uint8_t>(word & 0xFF); };
  for (Address cell = regs::kOrg; cell < 0x400; ++cell) store(cell, 0);
  cells(regs::kOrgAddress, {given.address, 0xFF, low(given.user_watchdog), low(given.user_watchdog >> 8U)});
  cells(regs::kOrgDoutLength, {given.outputs, kDout, kDout + 8, kDout + 16});
  cells(regs::kOrgDinLength, {given.inputs, kDin, kDin + 8, kDin + 16});
  cells(regs::kOrgDiagLength, {6, 6, kDiag, kDiag + 8});
  cells(regs::kOrgAuxLength, {kBufferSize, kBufferSize, given.aux_select, kAux, kAux + 8});
  cells(regs::kOrgSsaPointer, {given.ssa ? kSsa : std::uint8_t{0}});
  cells(regs::kOrgPrmPointer, {kPrm});
  cells(regs::kOrgCfgPointer, {kCfg, low(static_cast<unsigned>(given.read_cfg.size())), kReadCfg});
  cells(regs::kOrgNoAddressChange,
        {given.no_add_change ? std::uint8_t{0xFF} : std::uint8_t{0}, low(given.ident), low(given.ident >> 8U)});
  cells(kReadCfg * 8, given.read_cfg);
  cells(regs::kMode0, {low(given.modes), low(given.modes >> 8U)});
  cells(regs::kImr, {0, 0});
}

void Bench::start() {
  set_mode1(regs::kMode1Start | regs::kMode1ResUserWd);
  run_cycles(2);
}

void Bench::find_baud(int index) {
  constexpr std::uint8_t kNobody = 100, kFdlStatus = 0x49;
  requester.set_baud(index);
  for (int i = 0; i < 100'000 && twins.chip().status().baud_index.code() != index; ++i) {
    requester.send(timeline, bus::make_telegram(kNobody, 2, kFdlStatus), {.wants_answer = false});
    run_until(now() + requester.bit() * 60);
  }
  ASSERT_EQ(twins.chip().status().baud_index.code(), index);
  settle();
}

// --- the master ------------------------------------------------------------------------------------------------------

bus::Exchange Bench::ask(int dsap, const Bytes& data, std::uint8_t master) {
  const auto telegram =
      bus::make_telegram(address, master, kSrdFirst, data, optional_sap(dsap), optional_sap(dsap < 0 ? dsap : 62));
  bus::Exchange exchange = requester.send(timeline, telegram);
  twins.compare(now());
  settle();
  return exchange;
}

bus::Exchange Bench::repeat(int dsap, const Bytes& data, std::uint8_t master, bool fcb) {
  const auto fc = static_cast<std::uint8_t>(0x5D | (fcb ? 0x20 : 0));
  const auto telegram =
      bus::make_telegram(address, master, fc, data, optional_sap(dsap), optional_sap(dsap < 0 ? dsap : 62));
  bus::Exchange exchange = requester.send(timeline, telegram);
  twins.compare(now());
  settle();
  return exchange;
}

void Bench::control(std::uint8_t command, std::uint8_t group, std::uint8_t master) {
  requester.send(timeline, bus::make_telegram(bus::kBroadcast, master, kSdnHigh, {command, group}, 58, 62),
                 {.wants_answer = false});
  run_until(now() + requester.bit() * 20);
  settle();
}

bus::Exchange Bench::set_prm(const Bytes& user, std::uint8_t status, std::uint8_t wd1, std::uint8_t wd2,
                             std::uint8_t tsdr, std::uint8_t group, std::uint8_t master) {
  Bytes data = {status,
                wd1,
                wd2,
                tsdr,
                static_cast<std::uint8_t>(organisation.ident >> 8),
                static_cast<std::uint8_t>(organisation.ident & 0xFF),
                group};
  std::copy(user.begin(), user.end(), std::back_inserter(data));
  return ask(61, data, master);
}

Bytes Bench::diag(std::uint8_t master) {
  const bus::Exchange exchange = ask(60, {}, master);
  return exchange.answered() ? exchange.answer().data : Bytes{};
}

// --- short cuts ------------------------------------------------------------------------------------------------------

void Bench::to_wait_prm(const Organisation& given) {
  power_on();
  initialise(given);
  start();
  find_baud();
  ASSERT_EQ(state(), DpState::kWaitPrm);
}

void Bench::to_wait_cfg(const Organisation& given, const Bytes& user_prm) {
  to_wait_prm(given);
  ASSERT_EQ(kind_of(set_prm(user_prm)), "SC");
  if (!user_prm.empty()) ASSERT_EQ(load(regs::kPrmOk), 0);
  run_cycles(2);
  ASSERT_EQ(state(), DpState::kWaitCfg);
}

void Bench::to_data_ex(const Organisation& given, const Bytes& user_prm) {
  to_wait_cfg(given, user_prm);
  ASSERT_EQ(kind_of(check_cfg()), "SC");
  ASSERT_EQ(load(regs::kCfgOk), 0);
  if (given.inputs > 0) give_inputs(Bytes(given.inputs, 0xA5));
  run_cycles(2);
  ASSERT_EQ(state(), DpState::kDataExch);
}

int Bench::count(profibus::Reason reason) const {
  return static_cast<int>(std::count_if(
      twins.events.begin(), twins.events.end(), [&](const profibus::Event& each) { return each.reason == reason; }));
}

std::vector<PinChange> Bench::changes(Pin pin) const {
  std::vector<PinChange> of_pin;
  std::copy_if(twins.trace.begin(), twins.trace.end(), std::back_inserter(of_pin),
               [&](const PinChange& change) { return change.pin == pin; });
  return of_pin;
}

std::string kind_of(const bus::Exchange& exchange) {
  if (exchange.silent()) return "silent";
  if (exchange.short_acknowledge()) return "SC";
  if (!exchange.answered()) return testing::PrintToString(exchange.raw);
  const bus::Telegram& answer = exchange.answer();
  const bool status = answer.kind == bus::TelegramKind::kSd1;
  if (status && answer.fc == bus::fc::kRs) return "RS";
  if (status && answer.fc == bus::fc::kRr) return "RR";
  if (answer.fc == bus::fc::kDl) return "DL";
  if (answer.fc == bus::fc::kDh) return "DH";
  return testing::PrintToString(exchange.raw);
}

}  // namespace dsdpv1::spc3_test
