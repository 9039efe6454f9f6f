#include "kinds/board/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "board/firmware/mailbox.h"

namespace dsdpv1::arm {
namespace {

constexpr std::uint32_t kWfiBytes = 2;  // also of WFE

/// Of SerialSide, then TIM2 to TIM5.
constexpr std::array<unsigned, 7> kDeviceIrq = {35, 36, 38, 28, 29, 30, 50};

std::string milliseconds(Tick ticks) {
  return fmt::format("{:.1f} ms", static_cast<double>(ticks) / static_cast<double>(bus::kTicksPerMs));
}

/// An action executed at once on the bench's stack.
class AtOnce : public user_cpu::Transfer {
 public:
  AtOnce(Tick at, const std::function<void(Tick)>& action) : at_(at), action_(action) {}
  Tick next() const override { return done_ ? bus::kNever : at_; }
  void run(Tick now) override {
    done_ = true;
    action_(now);
  }
  bool done() const override { return done_; }

 private:
  Tick at_;
  const std::function<void(Tick)>& action_;
  bool done_ = false;
};

/// Only edges, accesses and the processor take time: the processor counts its instructions.
user_cpu::CpuTiming no_overhead() {
  user_cpu::CpuTiming timing;
  timing.overhead = timing.pin_sample = timing.pin_write = 0;
  return timing;
}

}  // namespace

Board::Board(user_cpu::HostBus& bus, BoardOptions options, std::function<void(Tick, bool)> set_chip_reset, Tick start)
    : options_(std::move(options)),
      bus_(bus),
      set_chip_reset_(std::move(set_chip_reset)),
      since_(start),
      acts_(start),
      serial_(ports_, options_.serial ? options_.card : 0, acts_),
      fsmc_(options_.fsmc),
      wires_(wires()),
      notes_(options_.notes),
      core_(*this, MemoryMap(), options_.timing),
      cpu_(
          bus, no_overhead(), [this](user_cpu::Cpu& cpu) { run_firmware(cpu); }, start) {
  cpu_.others = this;
  for (const Segment& segment : options_.firmware->image.segments)
    core_.load(segment.address, segment.bytes.data(), segment.bytes.size());
  if (const auto mailbox = options_.firmware->mailbox; mailbox && options_.make_mailbox) {
    mailbox_ = options_.make_mailbox(core_.ram() + (*mailbox - MemoryMap().ram_base));
    core_.watch(*mailbox, sizeof(dsdpv1_mailbox));
  }
  if (options_.make_debugger) debugger_ = options_.make_debugger(core_);
  core_.attach(debugger_.get());
  follow_clock();
  follow_flash();
  core_.on_fault([this](const Fault& fault) { note_fault(fault); });
  terminal_.on_line = [this](const std::string& line) {
    if (on_text) on_text(now(), line);
  };
}

Board::~Board() {
  if (pins_ != nullptr && options_.serial) bus_.on_txd = nullptr;
}

// ------------------------------------------------------------------------------------------------- the bench's side

// The mailbox first: after it the processor has run to its next stop, which is later than `now`.
void Board::run(Tick now) {
  if (has_news()) look_at_mailbox(now);
  for (Tick at = now;;) {
    turn_ = at;
    if (device_tick() <= at) run_devices(at);
    if (cpu_.next() <= at) cpu_.run(at);
    at = device_tick();
    if (at == bus::kNever || cpu_.next() < at || !turn_goes_on(at)) break;
  }
  if (std::exchange(chip_reset_due_, false)) set_chip_reset_(cpu_.now(), released_);
}

/// Peripherals run before the processor; their interrupts end its sleep.
void Board::run_devices(Tick now) {
  while (device_tick() <= now) {
    if (watchdog_.next() <= now) bite();
    if (serial_tick() <= now) serial_.run(now, bus_), look_for_overruns();
    if (timer_tick() <= now) catch_up_timers();
  }
  devices_acted_ = true;
  if ((device_requests() << kExtiIrq.size() & ~requests_) != 0) cpu_.wake(now);
}

void Board::catch_up_timers() {
  const std::uint64_t due = timers_at_;
  for (Timer& each : timers_) each.catch_up(due);
  plan_timers();
}

/// After each call of a timer.
void Board::plan_timers() {
  timers_at_ = Timer::kNever;
  timer_requests_ = 0;
  for (std::size_t i = 0; i < timers_.size(); ++i) {
    timers_at_ = std::min(timers_at_, timers_.at(i).next());
    timer_requests_ |= static_cast<unsigned>(timers_.at(i).asks()) << i;
  }
}

/// The watchdog resets the processor before its next instruction.
void Board::bite() {
  tell(tb::board_code::kWatchdog, fmt::format("the watchdog (IWDG) resets the processor {} after its last reload",
                                              milliseconds(watchdog_.length())));
  watchdog_ = Watchdog(kLsi);
  bitten_ = true;
  core_.reset();
  cpu_.wake(pins_->now());
}

/// A byte that was lost is told at the read of DR that comes too late, or without one after a while.
void Board::look_for_overruns() {
  constexpr Tick kWhile = 10 * bus::kTicksPerMs;
  for (const auto block : {SerialSide::kSpi1, SerialSide::kSpi2, SerialSide::kUsart2}) {
    if (!has_lost(block)) continue;
    Tick& since = lost_since_.at(block);
    if (since == bus::kNever) since = turn_;
    if (turn_ - since >= kWhile) tell_lost(block);
  }
}

void Board::tell_lost(SerialSide::Block block) {
  const std::uint64_t before = std::exchange(lost_.at(block), serial_.lost(block));
  lost_since_.at(block) = bus::kNever;
  const bool is_uart = block == SerialSide::kUsart2;
  tell(tb::board_code::kOverrun,
       fmt::format("{} {} lost before DR is read ({})", lost_.at(block) - before,
                   is_uart ? "characters for USART2 are" : "bytes for SPI are", is_uart ? "ORE" : "OVR"));
}

/// Delays before the first access to the chip, and with the chip in reset, do no harm. Of a loop that polls, passes are
/// left out.
void Board::look_if_stuck() {
  constexpr Tick kMost = 100 * bus::kTicksPerMs;
  if (std::exchange(polls_, false) || !in_service_ || !released_) touched_at_ = core_.cycles();
  if (tick_of(touched_at_) + kMost <= now()) {
    come_up();
    std::optional<user_cpu::Place> place =
        where(user_cpu::Act::omitted(now() - kMost, now()));  // with `stayed`, or from before that
    if (!place || !place->stayed) place = place_of(core_.place());
    if (on_error) on_error({now(), tb::board_code::kStuck.code, "100 ms without an access or sleep", place});
    touched_at_ = core_.cycles();
  }
  look_at_ = cycle_of(tick_of(touched_at_) + kMost);
}

void Board::storm(unsigned irq, std::uint32_t pc) {
  come_up();
  tell(tb::board_code::kIrqStorm,
       fmt::format("the handler of IRQ {} has returned {} times, and its source still asks", irq, kStorm), pc);
}

/// Called while the chip acts, possibly before this agent's turn; the processor may be ahead.
void Board::txd_changed(Tick at, bool level) {
  serial_.txd_changed(cycle_of(std::max(at, since_)), level);
  devices_acted_ = true;
  announce();
  if (on_plan) on_plan();
}

/// Firmware may sleep until an event (WFE): a command is one.
void Board::look_at_mailbox(Tick now) {
  const bool was_right = mailbox_->wrong().empty();
  const bool handed_over = mailbox_->look(now, [this](const user_cpu::ProgramError& error) {
    if (on_error) on_error(error);
  });
  if (was_right && !mailbox_->wrong().empty())
    fail(now, core_.place(),
         fmt::format("the firmware has written nonsense into its mailbox ({}): {}", DSDPV1_MAILBOX_SYMBOL,
                     mailbox_->wrong()),
         core_.registers());
  if (!handed_over) return;
  core_.signal_event();
  cpu_.wake(now);
}

void Board::interrupt_changed(Tick at, bool level) {
  interrupt_edges_.push_back({at, level});
  cpu_.wake(at);
  announce();
}

void Board::command(Tick now, const user_cpu::Command& command) {
  if ((options_.carry_out && options_.carry_out(command)) || !mailbox_) return;
  mailbox_->post(command);
  look_at_mailbox(now);
  announce();
}

user_cpu::UserCounters Board::counters() const {
  user_cpu::UserCounters counters{handshake_.counters(), std::nullopt, cpu_.counters()};
  counters.port += serial_.holds();
  if (mailbox_) counters.program = mailbox_->counters();
  return counters;
}

std::optional<user_cpu::BoardReport> Board::board() const {
  user_cpu::BoardReport report{core_.instructions(), core_.cycles(), hclk_hz(),
                               options_.fsmc.hclk_mhz ? "fsmc.hclk of the scenario" : rcc_.hclk_source(), notes_};
  const auto place = [this](std::uint32_t pc) { return options_.firmware->lines.at(pc); };
  for (std::string& line : others_.notes(place)) report.notes.push_back(std::move(line));
  for (std::string& line : serial_notes()) report.notes.push_back(std::move(line));
  if (!terminal_.unfinished().empty()) report.notes.push_back("USART1, a line without end: " + terminal_.unfinished());
  return report;
}

std::optional<user_cpu::Place> Board::where(const user_cpu::Act& act) const {
  if (act.look && act.at == looked_at()) return place_of(look_.pc);
  return acts_.where(act, [this](std::uint32_t pc) { return place_of(pc); });
}

user_cpu::Place Board::place_of(std::uint32_t pc) const {
  const SourceLine line = options_.firmware->lines.line_of(pc);
  return {line.file, line.line, line.function, pc};
}

// ------------------------------------------------------------------------------------------------- the firmware's side

void Board::run_firmware(user_cpu::Cpu& cpu) {
  pins_ = &cpu;
  if (options_.serial) bus_.on_txd = [this](Tick at, bool level) { txd_changed(at, level); };
  set_access_timing();
  try {
    core_.run();
    fault_ ? failed(*fault_) : ended_by_debugger();
  } catch (const FaultError& error) {
    failed(error.fault());
  }
}

/// Ends the run even if the firmware has a handler for the fault: that handler is for products, while users of the
/// bench want to see the fault.
void Board::note_fault(const Fault& fault) {
  if (fault.outcome != FaultOutcome::kHandled) return;  // otherwise it arrives as FaultError
  fault_ = fault;
  if (debugger_) debugger_->fault(fault.text);
  core_.stop();
}

void Board::ended_by_debugger() {
  if (on_killed) on_killed();
}

void Board::failed(const Fault& fault) {
  const SourceLines& lines = options_.firmware->lines;
  const bool is_in_function = !lines.line_of(fault.pc).function.empty();  // else a jump has led there
  fail(now(), is_in_function ? fault.pc : fault.registers.lr - user_cpu::ActLog::kCallBytes,
       fmt::format("{}; LR in {}", fault.text, lines.at(fault.registers.lr)), fault.registers);
}

/// The instruction at `pc` is the last act: where() names it.
void Board::fail(Tick at, std::uint32_t pc, const std::string& why, const Registers& registers) {
  acts_.pins(at, pc, false);
  if (on_failure) on_failure(at, why, table(registers));
}

Tick Board::tick_of(std::uint64_t cycle) const {
  return since_ + static_cast<Tick>(cycle - since_cycle_) * cycle_ticks_ / cycle_parts_;
}

/// The first cycle that begins at or after `tick`.
std::uint64_t Board::cycle_of(Tick tick) const {
  return since_cycle_ + static_cast<std::uint64_t>(((tick - since_) * cycle_parts_ + cycle_ticks_ - 1) / cycle_ticks_);
}

std::int64_t Board::hclk_hz() const {
  return options_.fsmc.hclk_mhz ? std::int64_t{1'000'000} * *options_.fsmc.hclk_mhz : rcc_.hclk_hz();
}

/// The cycle length follows RCC from the present cycle on.
void Board::follow_clock() {
  since_ = now();
  since_cycle_ = core_.cycles();
  const std::int64_t hz = hclk_hz(), common = std::gcd(hz, bus::kTicksPerSecond);
  cycle_ticks_ = bus::kTicksPerSecond / common;
  cycle_parts_ = hz / common;
  if (pins_ != nullptr) set_access_timing();
}

/// Waits until all other agents have reached the processor's time.
void Board::come_up() {
  quiet_ = 0;
  pins_->wait_until(now());
  take_interrupt_edges();
}

/// Runs the peripherals up to the processor's time.
void Board::meet_devices() {
  if (device_tick() <= now()) come_up();
}

/// The processor may stay ahead of the other agents as long as none of them is due.
std::uint64_t Board::keep_up() {
  const Tick now = this->now();
  if (acts_.sample_at() <= now) acts_.sample(now, core_.place(), core_.read_register(Register::kLr));
  const Tick next = stays_until();
  const bool ahead = !has_news() && next > now;
  quiet_ = ahead ? next : 0;
  if (ahead && core_.cycles() < look_at_) return due_cycle(now, next);
  if (!ahead) come_up();
  if (core_.cycles() >= look_at_) look_if_stuck();
  return due_cycle(now, stays_until());
}

void Board::left_out(std::uint64_t since, std::uint64_t cycles) {
  if (look_.cycle > since) look_.cycle += cycles;  // else before the loop
}

std::uint64_t Board::due_cycle(Tick now, Tick next) const {
  return std::min(look_at_, cycle_of(std::max(std::min(next, acts_.sample_at()), now)));
}

/// Up to when the processor may stay ahead. A chip that runs ahead reports its edges before their time.
Tick Board::stays_until() {
  const Tick quiet = quiet_until();
  return interrupt_edges_.empty() ? quiet : std::min(quiet, interrupt_edges_.front().at);
}

/// The peripherals count as other agents.
Tick Board::quiet_until() { return others() != nullptr ? std::min(device_tick(), others()->quiet_until()) : 0; }

bool Board::go_on(Tick tick) { return device_tick() > tick && turn_goes_on(tick); }

/// Checks first what is checked between two turns.
bool Board::turn_goes_on(Tick tick) {
  return !has_news() && !chip_reset_due_ && others() != nullptr && others()->go_on(tick);
}

void Board::sleep(std::uint64_t until) {
  const Tick end = until == kNever ? bus::kNever : tick_of(until);
  pins_->wait_until(now());
  bool woken = false;
  while (!take_interrupt_edges() && !woken && pins_->now() < end) woken = pins_->wait_for_wake(end);
  core_.advance_to(std::max(core_.cycles(), cycle_of(pins_->now())));
  touched_at_ = core_.cycles();
  acts_.sample(now(), core_.pc() - kWfiBytes, core_.read_register(Register::kLr));
}

void Board::reset() {
  come_up();
  ports_ = {};
  exti_ = {};
  rcc_.reset(std::exchange(bitten_, false));
  flash_ = {};
  timers_ = {};
  plan_timers();
  watchdog_ = Watchdog(kLsi);
  follow_flash();
  terminal_.reset();
  serial_.reset();
  serial_.follow(rcc_);
  fsmc_ = Fsmc(options_.fsmc);
  bus_changed_ = true;
  wires_ = wires();
  slow_flash_ = fast_ = in_service_ = false;
  follow_clock();
  update_interrupts();
  update_pins();
}

/// Returns true for a new interrupt request or an event.
bool Board::take_interrupt_edges() {
  const unsigned before = requests_;
  if (!devices_acted_ && interrupt_edges_.empty()) return false;
  for (; !interrupt_edges_.empty() && interrupt_edges_.front().at <= pins_->now(); interrupt_edges_.pop_front()) {
    interrupt_ = interrupt_edges_.front().level;
    exti_.edge(options_.wiring.interrupt.port, options_.wiring.interrupt.pin, interrupt_);
  }
  return update_interrupts() || (requests_ & ~before) != 0;
}

/// Returns true if there was an event, which ends a WFE.
bool Board::update_interrupts() {
  const unsigned now = exti_.requests() | device_requests() << kExtiIrq.size(), changed = now ^ requests_;
  const auto irq = [](std::size_t i) {
    return i < kExtiIrq.size() ? kExtiIrq.at(i) : kDeviceIrq.at(i - kExtiIrq.size());
  };
  requests_ = now;
  devices_acted_ = false;
  for (std::size_t i = 0; changed >> i != 0; ++i)
    if ((changed >> i & 1U) != 0) core_.set_interrupt_level(irq(i), (now >> i & 1U) != 0);
  const bool event = exti_.take_event();
  if (event) core_.signal_event();
  return event;
}

void Board::update_pins() {
  if (!options_.wiring.handshake.empty()) update_handshake();
  const PortPin& reset = options_.wiring.reset;
  const bool inactive = !options_.wiring.reset_high;
  if (const bool released = ports_.at(reset.port).level(reset.pin, inactive) == inactive;
      std::exchange(released_, released) != released) {
    acts_.pins(pins_->now(), core_.pc(), false);
    chip_reset_due_ = true;
    pins_->wait(1);  // the bench moves the pin before the firmware continues
  }
}

void Board::update_handshake() {
  const Gpio& handshake = ports_[kRReq.port];
  if (const bool level = handshake.level(kRReq.pin, false); std::exchange(r_req_, level) != level) {
    handshake_.r_req(pins_->now(), level);
    acts_.pins(pins_->now(), core_.pc(), !level);
    pins_->set_r_req(level);
  }
  if (const bool level = handshake.level(kRSta.pin, false); std::exchange(r_sta_, level) != level) {
    handshake_.r_sta(pins_->now(), level);
    acts_.pins(pins_->now(), core_.pc(), !level);
    pins_->looked({looked_at(), looked_at()});
    pins_->set_r_sta(level);
  }
}

void Board::update_serial_pins() {
  if (!serial_.moved()) return;
  come_up();
  acts_.pins(pins_->now(), core_.pc(), false);
  on_bus([this](Tick at) { serial_.move(at, bus_); });
}

/// Pins are moved on the bench's stack.
void Board::on_bus(const std::function<void(Tick)>& action) {
  AtOnce transfer(pins_->now(), action);
  pins_->transfer(transfer);
}

}  // namespace dsdpv1::arm
