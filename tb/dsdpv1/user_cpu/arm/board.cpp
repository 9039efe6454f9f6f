#include "tb/dsdpv1/user_cpu/arm/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "tb/dsdpv1/user_cpu/orders.hpp"

namespace dsdpv1::arm {
namespace {

// RM0008, memory map.
constexpr std::uint32_t kBank1 = 0x6000'0000, kBank1End = 0x7000'0000, kRegionSize = 0x0400'0000;
constexpr std::uint32_t kAfio = 0x4001'0000, kExti = 0x4001'0400, kGpioA = 0x4001'0800, kGpioEnd = 0x4001'2400;
constexpr std::uint32_t kUsart1 = 0x4001'3800, kRcc = 0x4002'1000, kBlock = 0x400;
constexpr std::uint32_t kPeripherals = 0x4000'0000, kPeripheralsSize = 0x2'4000, kFsmcBlock = 0x1000;
constexpr std::uint32_t kChipMask = 0x7FF;  // A10..A0
constexpr std::uint32_t kGpioIdr = 0x08;

// The board's wiring.
constexpr unsigned kRReqPin = 6, kRStaPin = 7, kLReqPin = 8, kLStaPin = 9, kResetPin = 4, kIntr0Pin = 6;
constexpr unsigned kLampPin = 12;  // PBF, then BR and READY

constexpr std::uint64_t kApbCycles = 2;
constexpr std::int64_t kGreatestHclk = 72'000'000;
constexpr std::int64_t kQuantaASecond = 4'000'000;  // interrupts are looked for every 250 ns

bool within(std::uint32_t address, std::uint32_t base) { return address - base < kBlock; }

/// Only edges, accesses and the processor take time: instructions are counted by the processor itself.
user_cpu::CpuTiming no_overhead() {
  user_cpu::CpuTiming timing;
  timing.overhead = timing.pin_sample = timing.pin_write = 0;
  return timing;
}

}  // namespace

Board::Board(user_cpu::HostBus& bus, BoardOptions options, std::function<void(Tick, bool)> set_chip_reset, Tick start)
    : options_(std::move(options)),
      set_chip_reset_(std::move(set_chip_reset)),
      since_(start),
      fsmc_(options_.fsmc),
      notes_(options_.notes),
      core_(*this, MemoryMap(), options_.timing),
      cpu_(
          bus, no_overhead(), [this](user_cpu::Cpu& cpu) { run_firmware(cpu); }, start) {
  cpu_.others = this;
  for (const Segment& segment : options_.firmware->image.segments)
    core_.load(segment.address, segment.bytes.data(), segment.bytes.size());
  if (options_.firmware->mailbox)
    mailbox_.emplace(core_.ram() + (*options_.firmware->mailbox - MemoryMap().ram_base), options_.program);
  if (options_.make_debugger) debugger_ = options_.make_debugger(core_);
  core_.attach(debugger_.get());
  follow_clock();
  core_.on_fault([this](const Fault& fault) { note_fault(fault); });
  usart_.on_line = [this](const std::string& line) {
    if (on_text) on_text(now(), line);
  };
}

// ------------------------------------------------------------------------------------------------- the bench's side

// The mailbox first: afterwards the processor has gone on to its next stop, which lies behind `now`.
void Board::run(Tick now) {
  if (mailbox_) look_at_mailbox(now);
  cpu_.run(now);
  if (std::exchange(chip_reset_due_, false)) set_chip_reset_(cpu_.now(), chip_reset_);
}

/// Firmware may sleep until an event comes (WFE): a command is one.
void Board::look_at_mailbox(Tick now) {
  const bool was_right = mailbox_->wrong().empty();
  const bool handed_over = mailbox_->look(now, [this](const user_cpu::DriverError& error) {
    if (on_error) on_error(user_cpu::program_error(error));
  });
  if (was_right && !mailbox_->wrong().empty() && on_failure)
    on_failure(now,
               fmt::format("the firmware has written nonsense into its mailbox ({}): {}", DSDPV1_MAILBOX_SYMBOL,
                           mailbox_->wrong()),
               table(core_.registers()));
  if (!handed_over) return;
  core_.signal_event();
  cpu_.wake(now);
}

void Board::interrupt_changed(Tick at, bool level) {
  intr0_edges_.push_back({at, level});
  cpu_.wake(at);
  announce();
}

void Board::command(Tick now, const user_cpu::Command& command) {
  if (!mailbox_) return;
  mailbox_->post(user_cpu::driver_command(command));
  look_at_mailbox(now);
  announce();
}

user_cpu::UserCounters Board::counters() const {
  user_cpu::UserCounters counters{handshake_.counters(), std::nullopt, cpu_.counters()};
  if (mailbox_) counters.program = mailbox_->counters();
  return counters;
}

std::optional<user_cpu::BoardReport> Board::board() const {
  user_cpu::BoardReport report{core_.instructions(), core_.cycles(), hclk_hz(),
                               options_.fsmc.hclk_mhz ? "fsmc.hclk of the scenario" : rcc_.hclk_source(), notes_};
  const auto place = [this](std::uint32_t pc) { return options_.firmware->lines.at(pc); };
  for (std::string& line : others_.notes(place)) report.notes.push_back(std::move(line));
  if (!usart_.unfinished().empty()) report.notes.push_back("USART1, a line without end: " + usart_.unfinished());
  return report;
}

// ------------------------------------------------------------------------------------------------- the firmware's side

void Board::run_firmware(user_cpu::Cpu& cpu) {
  pins_ = &cpu;
  set_access_timing();
  try {
    core_.run();
    fault_ ? failed(*fault_) : ended_by_debugger();
  } catch (const FaultError& error) {
    failed(error.fault());
  }
}

/// Also a fault that the firmware has a handler for ends the run: that handler is for products, here somebody wants to
/// see it.
void Board::note_fault(const Fault& fault) {
  if (fault.outcome != FaultOutcome::kHandled) return;  // comes as FaultError
  fault_ = fault;
  if (debugger_) debugger_->fault(fault.text);
  core_.stop();
}

void Board::ended_by_debugger() {
  if (on_killed) on_killed();
}

void Board::failed(const Fault& fault) {
  const SourceLines& lines = options_.firmware->lines;
  if (!on_failure) return;
  on_failure(now(), fmt::format("{}; in {}, LR in {}", fault.text, lines.at(fault.pc), lines.at(fault.registers.lr)),
             table(fault.registers));
}

Tick Board::tick_of(std::uint64_t cycle) const {
  return since_ + static_cast<Tick>(cycle - since_cycle_) * cycle_ticks_ / cycle_parts_;
}

/// The first cycle that does not begin before `tick`.
std::uint64_t Board::cycle_of(Tick tick) const {
  return since_cycle_ + static_cast<std::uint64_t>(((tick - since_) * cycle_parts_ + cycle_ticks_ - 1) / cycle_ticks_);
}

std::int64_t Board::hclk_hz() const {
  return options_.fsmc.hclk_mhz ? std::int64_t{1'000'000} * *options_.fsmc.hclk_mhz : rcc_.hclk_hz();
}

/// Cycles last what RCC says, from the present one on.
void Board::follow_clock() {
  since_ = now();
  since_cycle_ = core_.cycles();
  const std::int64_t hz = hclk_hz(), common = std::gcd(hz, bus::kTicksPerSecond);
  cycle_ticks_ = bus::kTicksPerSecond / common;
  cycle_parts_ = hz / common;
  core_.set_quantum(static_cast<std::uint32_t>(std::max<std::int64_t>(hz / kQuantaASecond, 1)));
  if (pins_ != nullptr) set_access_timing();
}

/// Everybody else has come to the processor's time.
void Board::come_up() {
  pins_->wait_until(now());
  take_intr0_edges();
}

/// The processor may stay ahead of the others as long as nobody has anything to do; the bench hears of news at the same
/// time in any case.
void Board::keep_up() {
  if (has_news() || !quiet(now())) come_up();
}

bool Board::quiet(Tick tick) { return others() != nullptr && others()->quiet(tick); }

/// What is looked at between two turns is looked at first.
bool Board::go_on(Tick tick) { return !has_news() && !chip_reset_due_ && others() != nullptr && others()->go_on(tick); }

void Board::sleep(std::uint64_t until) {
  const Tick end = until == kNever ? bus::kNever : tick_of(until);
  pins_->wait_until(now());
  bool woken = false;
  while (!take_intr0_edges() && !woken && pins_->now() < end) woken = pins_->wait_for_wake(end);
  core_.advance_to(std::max(core_.cycles(), cycle_of(pins_->now())));
}

void Board::reset() {
  come_up();
  ports_ = {};
  exti_ = {};
  rcc_ = {};
  fsmc_ = Fsmc(options_.fsmc);
  follow_clock();
  update_interrupts();
  update_pins();
}

/// Whether an interrupt is asked for that was not before.
bool Board::take_intr0_edges() {
  const unsigned before = requests_;
  for (; !intr0_edges_.empty() && intr0_edges_.front().at <= pins_->now(); intr0_edges_.pop_front()) {
    intr0_ = intr0_edges_.front().level;
    exti_.edge(kG, kIntr0Pin, intr0_);
  }
  update_interrupts();
  return (requests_ & ~before) != 0;
}

void Board::update_interrupts() {
  const unsigned now = exti_.requests(), changed = now ^ requests_;
  requests_ = now;
  for (std::size_t i = 0; changed >> i != 0; ++i)
    if ((changed >> i & 1U) != 0) core_.set_interrupt_level(kExtiIrq.at(i), (now >> i & 1U) != 0);
}

void Board::update_pins() {
  const Gpio& handshake = ports_[kC];
  if (const bool level = handshake.level(kRReqPin, false); std::exchange(r_req_, level) != level) {
    handshake_.r_req(pins_->now(), level);
    pins_->set_r_req(level);
  }
  if (const bool level = handshake.level(kRStaPin, false); std::exchange(r_sta_, level) != level) {
    handshake_.r_sta(pins_->now(), level);
    pins_->set_r_sta(level);
  }
  if (const bool level = ports_[kE].level(kResetPin, true); std::exchange(chip_reset_, level) != level) {
    chip_reset_due_ = true;
    pins_->wait(1);  // the bench moves the pin before the firmware goes on
  }
}

// ------------------------------------------------------------------------------------------------- loads and stores

std::uint32_t Board::load(std::uint32_t address, unsigned bytes) {
  if (address >= kBank1 && address < kBank1End) return load_chip(address, bytes);
  const std::uint32_t word = load_word(address & ~3U) >> (address % 4 * 8);
  return bytes == 4 ? word : word & ((1U << bytes * 8) - 1);
}

void Board::store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (address >= kBank1 && address < kBank1End) return store_chip(address, bytes, value);
  if (bytes == 4) return store_word(address, value);
  // The bridge to APB has whole words only: the rest of the register stays.
  const unsigned shift = address % 4 * 8;
  const std::uint32_t mask = ((1U << bytes * 8) - 1) << shift;
  store_word(address & ~3U, (load_word(address & ~3U) & ~mask) | (value << shift & mask));
}

/// Wider accesses are as many of a byte, the lowest address first.
std::uint32_t Board::load_chip(std::uint32_t address, unsigned bytes) {
  if (!may_access(address, false)) return 0;
  come_up();
  std::uint32_t value = 0;
  for (unsigned i = 0; i < bytes; ++i)
    value |= static_cast<std::uint32_t>(pins_->read(static_cast<std::uint16_t>((address + i) & kChipMask))) << i * 8;
  core_.advance_to(cycle_of(pins_->now()));
  return value;
}

void Board::store_chip(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (!may_access(address, true)) return;
  come_up();
  for (unsigned i = 0; i < bytes; ++i)
    pins_->write(static_cast<std::uint16_t>((address + i) & kChipMask), static_cast<std::uint8_t>(value >> i * 8));
  core_.advance_to(cycle_of(pins_->now()));
}

void Board::set_access_timing() {
  const user_cpu::FsmcAccess made = fsmc_.timing(hclk_hz());
  pins_->set_access_timing(options_.access.value_or(made.read), options_.access.value_or(made.write));
}

bool Board::may_access(std::uint32_t address, bool write) {
  if (fsmc_.refuses(write) || address >= kBank1 + kRegionSize) {
    core_.bus_error();
    return false;
  }
  if (fsmc_.is_wide()) note("FSMC_BCR1.MWID says 16 bits, the chip's bus has 8", Noted::kWideBus);
  if ((rcc_.ahb_clocks() & 1U << 8U) == 0) note_clock("FSMC", "RCC_AHBENR", Noted::kFsmcClock);
  return true;
}

std::uint32_t Board::load_word(std::uint32_t address) {
  core_.advance_to(core_.cycles() + kApbCycles);
  look_at_clock(address);
  if (address >= kGpioA && address < kGpioEnd) return load_port((address - kGpioA) / kBlock, address % kBlock);
  if (within(address, kAfio)) return exti_.read_afio(address - kAfio);
  if (within(address, kExti)) {
    come_up();
    return exti_.read(address - kExti);
  }
  if (within(address, kUsart1)) return usart_.read(address - kUsart1);
  if (within(address, kRcc)) return rcc_.read(address - kRcc);
  if (address - Fsmc::kBase < Fsmc::kSize) return fsmc_.read(address - Fsmc::kBase);
  return others_.read(address, core_.pc());
}

std::uint32_t Board::load_port(unsigned port, std::uint32_t offset) {
  const Levels there = offset == kGpioIdr ? outside(port) : Levels{0, 0};
  return ports_.at(port).read(offset, there.driven, there.levels);
}

/// The chip, the board's pull-up and the switches.
Board::Levels Board::outside(unsigned port) {
  if (port != kC && port != kG) return wired(port, 0, 0);
  come_up();
  if (port == kG) return wired(port, 0, pins_->lamps());
  const auto l_req = static_cast<unsigned>(pins_->l_req());
  return wired(port, l_req | static_cast<unsigned>(pins_->l_sta()) << 1U, 0);
}

/// `handshake`: L_REQ, L_STA; `lamps` as user_cpu::HostBus has them.
Board::Levels Board::wired(unsigned port, unsigned handshake, unsigned lamps) const {
  unsigned driven = options_.switches.held.at(port), levels = options_.switches.levels.at(port);
  const auto add = [&](unsigned pin, unsigned level) {
    driven |= 1U << pin;
    levels |= (level & 1U) << pin;
  };
  if (port == kE) add(kResetPin, 1);
  if (port == kC) add(kLReqPin, handshake), add(kLStaPin, handshake >> 1U);
  if (port == kG) {
    add(kIntr0Pin, static_cast<unsigned>(intr0_));
    for (unsigned i = 0; i < 3; ++i) add(kLampPin + i, lamps >> i);
  }
  return {static_cast<std::uint16_t>(driven), static_cast<std::uint16_t>(levels)};
}

// ------------------------------------------------------------------------------------------------- a debugger's looks

std::vector<MemoryRegion> Board::regions() const {
  std::vector<MemoryRegion> all = {{kPeripherals, kPeripheralsSize, false}, {Fsmc::kBase, kFsmcBlock, false}};
  if (options_.chip) all.push_back({kBank1, kRegionSize, false});
  return all;
}

std::optional<std::uint32_t> Board::peek(std::uint32_t address) const {
  if (options_.chip && address - kBank1 < kRegionSize) {
    const dsdpv1::Chip& chip = options_.chip(pins_->now());
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i)
      word |= std::uint32_t{chip.peek(static_cast<std::uint16_t>((address + i) & kChipMask))} << i * 8;
    return word;
  }
  if (address - Fsmc::kBase < kFsmcBlock) return fsmc_.read(address - Fsmc::kBase);
  if (address - kPeripherals >= kPeripheralsSize) return std::nullopt;
  if (address >= kGpioA && address < kGpioEnd) return peek_port((address - kGpioA) / kBlock, address % kBlock);
  if (within(address, kAfio)) return exti_.read_afio(address - kAfio);
  if (within(address, kExti)) return exti_.read(address - kExti);
  if (within(address, kUsart1)) return usart_.read(address - kUsart1);
  if (within(address, kRcc)) return rcc_.read(address - kRcc);
  return others_.peek(address);
}

std::uint32_t Board::peek_port(unsigned port, std::uint32_t offset) const {
  const dsdpv1::Chip* const chip = options_.chip ? &options_.chip(pins_->now()) : nullptr;
  const auto level = [chip](dsdpv1::Pin pin) {
    return static_cast<unsigned>(chip != nullptr && chip->level(pin) == 1);
  };
  const Levels there = wired(port, level(Pin::kLReq) | level(Pin::kLSta) << 1U,
                             level(Pin::kPbf) | level(Pin::kBr) << 1U | level(Pin::kReady) << 2U);
  return ports_.at(port).read(offset, there.driven, there.levels);
}

// ------------------------------------------------------------------------------------------------- stores

void Board::store_word(std::uint32_t address, std::uint32_t value) {
  core_.advance_to(core_.cycles() + kApbCycles);
  look_at_clock(address);
  if (address >= kGpioA && address < kGpioEnd) {
    come_up();
    ports_.at((address - kGpioA) / kBlock).write(address % kBlock, value);
    update_pins();
  } else if (within(address, kAfio)) {
    exti_.write_afio(address - kAfio, value);
  } else if (within(address, kExti)) {
    come_up();
    exti_.write(address - kExti, value);
    update_interrupts();
  } else if (within(address, kUsart1)) {
    usart_.write(address - kUsart1, value);
  } else if (within(address, kRcc)) {
    rcc_.write(address - kRcc, value);
    if (!options_.fsmc.hclk_mhz) follow_clock();
    if (hclk_hz() > kGreatestHclk)
      note(fmt::format("HCLK is {} MHz, allowed is 72 MHz", hclk_hz() / 1'000'000), Noted::kClockTooFast);
  } else if (address - Fsmc::kBase < Fsmc::kSize) {
    fsmc_.write(address - Fsmc::kBase, value);
    set_access_timing();
  } else {
    others_.write(address, value, core_.pc());
  }
}

// ------------------------------------------------------------------------------------------------- notes

void Board::look_at_clock(std::uint32_t address) {
  const auto is_on = [this](unsigned bit) { return (rcc_.apb2_clocks() >> bit & 1U) != 0; };
  if (address >= kGpioA && address < kGpioEnd) {
    static constexpr std::array<const char*, kPorts> kNames = {"GPIOA", "GPIOB", "GPIOC", "GPIOD",
                                                               "GPIOE", "GPIOF", "GPIOG"};
    const unsigned port = (address - kGpioA) / kBlock;
    if (!is_on(2 + port)) note_clock(kNames.at(port), "RCC_APB2ENR", static_cast<Noted>(port));
  } else if (within(address, kAfio) && !is_on(0)) {
    note_clock("AFIO", "RCC_APB2ENR", Noted::kAfioClock);
  } else if (within(address, kUsart1) && !is_on(14)) {
    note_clock("USART1", "RCC_APB2ENR", Noted::kUsartClock);
  }
}

void Board::note_clock(const char* peripheral, const char* reg, Noted which) {
  if (noted_.test(static_cast<std::size_t>(which))) return;
  note(fmt::format("{} is used while its clock is off in {}, where a real one does not answer", peripheral, reg),
       which);
}

void Board::note(const std::string& text, Noted which) {
  if (noted_.test(static_cast<std::size_t>(which))) return;
  noted_.set(static_cast<std::size_t>(which));
  notes_.push_back(fmt::format("{}, first in {}", text, options_.firmware->lines.at(core_.pc())));
}

}  // namespace dsdpv1::arm
