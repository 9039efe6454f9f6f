// The processor's address space: the chip on the memory bus, registers, and a debugger's view of them.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "kinds/board/board.hpp"
#include "kinds/user_cpu/fsmc_access.hpp"

namespace dsdpv1::arm {

struct Peripheral {
  enum Kind : std::uint8_t { kAfio, kExti, kGpio, kTerminal, kSerial, kRcc, kFlash, kTimer, kWatchdog, kFsmc };

  Kind kind = kAfio;
  std::uint32_t base = 0;
  const char* name = nullptr;
  const RegisterTable* registers = nullptr;
  unsigned number = 0;              ///< of a port, of a timer from TIM2 on; SerialSide::Block
  std::uint32_t clock_enables = 0;  ///< the register of RCC; 0: it always has its clock
  unsigned clock_bit = 0;
};

namespace {

// RM0008, memory map.
constexpr std::uint32_t kBank1 = 0x6000'0000, kBank1End = 0x7000'0000, kRegionSize = 0x0400'0000;
constexpr std::uint32_t kGpioA = 0x4001'0800, kRcc = 0x4002'1000, kFlash = 0x4002'2000, kBlock = 0x400;
constexpr std::uint32_t kPeripherals = 0x4000'0000, kPeripheralsSize = 0x2'4000;
constexpr std::uint32_t kChipMask = 0x7FF;  // A10..A0
constexpr std::uint32_t kGpioCrh = 0x04, kGpioIdr = 0x08;
constexpr std::uint32_t kAfioMapr = 0x04;
constexpr std::array<std::uint32_t, 3> kSerialDr = {Spi::kDr, Spi::kDr, Usart::kDr};  // by SerialSide::Block

// The board's wiring.
constexpr std::uint32_t kLookedAt = kGpioA + kC * kBlock + kGpioIdr + 1;  // the byte with PC8 and PC9, L_REQ and L_STA
static_assert(kLReq.pin / 8 == 1 && kLSta.pin / 8 == 1);
constexpr unsigned kLampPin = 12;  // the first

constexpr std::uint64_t kApbCycles = 2;
constexpr std::int64_t kGreatestHclk = 72'000'000, kGreatestPclk1 = 36'000'000, kSysclkWithoutWait = 24'000'000;

constexpr unsigned kNoRegister = 32;  // is_new: beside the bits of a register

constexpr Peripheral port(unsigned number, const char* name) {
  return {Peripheral::kGpio, kGpioA + number * kBlock, name, &Gpio::kRegisters, number, Rcc::kApb2enr, 2 + number};
}

constexpr Peripheral timer(unsigned number, const char* name) {
  return {Peripheral::kTimer, kPeripherals + number * kBlock, name, &Timer::kRegisters, number, Rcc::kApb1enr, number};
}

constexpr std::array<Peripheral, 21> kMap = {{
    {Peripheral::kAfio, 0x4001'0000, "AFIO", &Exti::kAfioRegisters, 0, Rcc::kApb2enr, 0},
    {Peripheral::kExti, 0x4001'0400, "EXTI", &Exti::kRegisters},
    port(0, "GPIOA"),
    port(1, "GPIOB"),
    port(2, "GPIOC"),
    port(3, "GPIOD"),
    port(4, "GPIOE"),
    port(5, "GPIOF"),
    port(6, "GPIOG"),
    {Peripheral::kSerial, 0x4001'3000, "SPI1", &Spi::kRegisters, SerialSide::kSpi1, Rcc::kApb2enr, 12},
    {Peripheral::kSerial, 0x4000'3800, "SPI2", &Spi::kRegisters, SerialSide::kSpi2, Rcc::kApb1enr, 14},
    {Peripheral::kSerial, 0x4000'4400, "USART2", &Usart::kRegisters, SerialSide::kUsart2, Rcc::kApb1enr, 17},
    {Peripheral::kTerminal, 0x4001'3800, "USART1", &Terminal::kRegisters, 0, Rcc::kApb2enr, 14},
    {Peripheral::kRcc, kRcc, "RCC", &Rcc::kRegisters},
    {Peripheral::kFlash, kFlash, "FLASH", &FlashInterface::kRegisters},
    timer(0, "TIM2"),
    timer(1, "TIM3"),
    timer(2, "TIM4"),
    timer(3, "TIM5"),
    {Peripheral::kWatchdog, 0x4000'3000, "IWDG", &Watchdog::kRegisters},
    {Peripheral::kFsmc, Fsmc::kBase, "FSMC", &Fsmc::kRegisters, 0, Rcc::kAhbenr, 8},
}};
constexpr const Peripheral& kFsmc = kMap.back();

/// Null: the board has no peripheral there.
const Peripheral* peripheral_at(std::uint32_t address) {
  static constexpr auto kPlaces = [] {  // from 1 on, by block
    std::array<std::uint8_t, kPeripheralsSize / kBlock> places{};
    for (std::uint8_t i = 0; i + 1U < kMap.size(); ++i) places[(kMap[i].base - kPeripherals) / kBlock] = i + 1;
    return places;
  }();
  if (address - Fsmc::kBase < Fsmc::kSize) return &kFsmc;
  const std::uint32_t block = (address - kPeripherals) / kBlock;
  const unsigned place = block < kPlaces.size() ? kPlaces[block] : 0;
  return place != 0 ? &kMap[place - 1] : nullptr;
}

}  // namespace

// ------------------------------------------------------------------------------------------------- loads and stores

std::uint32_t Board::load(std::uint32_t address, unsigned bytes) {
  touched_at_ = core_.cycles();
  polls_ = false;
  if (address >= kBank1 && address < kBank1End) return load_chip(address, bytes);
  quiet_ = 0;
  const std::uint32_t word = load_word(address & ~3U) >> (address % 4 * 8);
  if (kLookedAt - address < bytes) look_ = {core_.cycles(), core_.pc()};
  return bytes == 4 ? word : word & ((1U << bytes * 8) - 1);
}

void Board::store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  touched_at_ = core_.cycles();
  polls_ = false;
  if (address >= kBank1 && address < kBank1End) return store_chip(address, bytes, value);
  quiet_ = 0;
  if (bytes == 4) return store_word(address, value);
  // The bridge to APB writes whole words only, so the rest of the register is kept.
  const unsigned shift = address % 4 * 8;
  const std::uint32_t mask = ((1U << bytes * 8) - 1) << shift;
  store_word(address & ~3U, (load_word(address & ~3U) & ~mask) | (value << shift & mask));
}

/// For the chip's port, which asks the others itself.
void Board::come_up_for_access(bool write) {
  bus_.set_wait(write ? write_wait_ : read_wait_);
  if (std::exchange(quiet_, 0) > now()) return pins_->skip_to(now());
  come_up();
}

/// Wider accesses are made byte by byte, the lowest address first.
std::uint32_t Board::load_chip(std::uint32_t address, unsigned bytes) {
  if (!may_access(address, false)) return 0;
  come_up_for_access(false);
  acts_.access(pins_->now(), core_.pc(), address & kChipMask, bytes, false);
  if (!has_right_bus()) return load_by_wrong_bus(address, bytes);
  std::uint32_t value = 0;
  for (unsigned i = 0; i < bytes; ++i)
    value |= static_cast<std::uint32_t>(pins_->read(static_cast<std::uint16_t>((address + i) & kChipMask))) << i * 8;
  end_accesses(bytes);
  return value;
}

void Board::store_chip(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  if (!may_access(address, true)) return;
  come_up_for_access(true);
  acts_.access(pins_->now(), core_.pc(), address & kChipMask, bytes, true);
  if (!has_right_bus()) return store_by_wrong_bus(address, bytes, value);
  for (unsigned i = 0; i < bytes; ++i)
    pins_->write(static_cast<std::uint16_t>((address + i) & kChipMask), static_cast<std::uint8_t>(value >> i * 8));
  end_accesses(bytes);
}

/// Accesses are whole cycles, each rounded to ticks.
void Board::end_accesses(unsigned count) { core_.advance_to(cycle_of(pins_->now() - count)); }

void Board::set_access_timing() {
  const user_cpu::FsmcBank bank = fsmc_.bank(hclk_hz());
  read_wait_ = {waits(bank.read), fsmc_.waits_while_high(), bank.hclk_hz};
  write_wait_ = {waits(bank.write), fsmc_.waits_while_high(), bank.hclk_hz};
  const user_cpu::FsmcAccess made = user_cpu::access_timing(bank);
  pins_->set_access_timing(options_.access.value_or(made.read), options_.access.value_or(made.write));
}

/// NWAIT is seen if the data phase has four HCLK for it (21.5.4); a shorter one ends without it (p).
bool Board::waits(const user_cpu::FsmcTiming& timing) const {
  constexpr int kSeen = 4;
  return options_.wiring.wait && fsmc_.waits() && timing.datast >= kSeen;
}

/// RM0008 21.3.1: a bank that is not enabled answers with an error. One without its clock does not answer (p: the
/// same).
bool Board::may_access(std::uint32_t address, bool write) {
  in_service_ = true;
  if (answers(kFsmc) && !fsmc_.refuses(write) && address < kBank1 + kRegionSize) return true;
  core_.bus_error();
  return false;
}

/// Looked at when the chip is accessed: firmware sets up many pins before that.
bool Board::has_right_bus() {
  if (std::exchange(bus_changed_, false))
    memory_bus_ = memory_bus(ports_, fsmc_, has_handshake(), options_.wiring.wait && fsmc_.waits());
  return memory_bus_.is_right();
}

void Board::tell_wrong_bus() {
  if (memory_bus_.wide || memory_bus_.multiplexed)
    misused(tb::board_code::kFsmcMode,
            fmt::format("the chip is accessed with FSMC_BCR1.{}", memory_bus_.multiplexed ? "MUXEN = 1" : "MWID = 1"));
  if (!memory_bus_.wrong_pins.empty())
    misused(tb::board_code::kPinMode,
            fmt::format("the chip is accessed while pins are not set up for it: {}", memory_bus_.wrong_pins));
}

/// A bus of 16 bits makes one cycle of two bytes; that of the odd address is on lines that the chip does not have, and
/// read as 0 (p), as is a chip that is not selected.
std::uint32_t Board::load_by_wrong_bus(std::uint32_t address, unsigned bytes) {
  tell_wrong_bus();
  const unsigned width = memory_bus_.wide ? 2 : 1;
  std::uint32_t value = 0;
  unsigned cycles = 0;
  for (unsigned i = 0; memory_bus_.reads && i < bytes; i += width, ++cycles) {
    const std::uint32_t byte = pins_->read(memory_bus_.cell(address + i));
    if (width == 1 || (address + i) % 2 == 0) value |= byte << i * 8;
  }
  if (cycles != 0) end_accesses(cycles);
  return value;
}

/// A single byte is on both halves of a bus of 16 bits, whose byte enables the chip does not have (p).
void Board::store_by_wrong_bus(std::uint32_t address, unsigned bytes, std::uint32_t value) {
  tell_wrong_bus();
  const unsigned width = memory_bus_.wide ? 2 : 1;
  unsigned cycles = 0;
  for (unsigned i = 0; memory_bus_.writes && i < bytes; i += width, ++cycles)
    pins_->write(memory_bus_.cell(address + i), static_cast<std::uint8_t>(value >> i * 8 & memory_bus_.data));
  if (cycles != 0) end_accesses(cycles);
}

/// In the blocks of peripherals an address without one reads 0 (p); elsewhere nothing answers.
bool Board::is_outside(std::uint32_t address) {
  if (OtherRegisters::is_mapped(address)) return false;
  misused(tb::board_code::kNotMapped, fmt::format("0x{:08X} is accessed", address));
  if (address - kPeripherals >= kPeripheralsSize) core_.bus_error();
  return true;
}

std::uint32_t Board::load_word(std::uint32_t address) {
  core_.advance_to(core_.cycles() + kApbCycles);
  const Peripheral* const here = peripheral_at(address);
  if (here == nullptr) return is_outside(address) ? 0 : others_.read(address, core_.pc());
  if (!answers(*here)) return 0;
  look_at(*here, address - here->base, {});
  const std::uint32_t value = load_register(*here, address - here->base);
  if (stays(*here)) {
    polls_ = true;
    core_.stays(due_cycle(now(), stays_until()));
  }
  return value;
}

std::uint32_t Board::load_register(const Peripheral& of, std::uint32_t offset) {
  switch (of.kind) {
    case Peripheral::kGpio: return load_port(of.number, offset);
    case Peripheral::kExti: come_up(); return exti_.read(offset);
    case Peripheral::kSerial: {
      meet_devices();
      const auto block = static_cast<SerialSide::Block>(of.number);
      if (offset == kSerialDr.at(block) && has_lost(block)) tell_lost(block);
      const std::uint32_t value = serial_.read(block, offset);
      update_interrupts();
      return value;
    }
    case Peripheral::kTimer: {
      const std::uint32_t value = timers_.at(of.number).read(offset, core_.cycles());
      plan_timers();
      update_interrupts();
      return value;
    }
    default: return peek_register(of, offset);
  }
}

/// True if reading the register has no effect and gives the same value until another agent has a turn. That is false
/// for MISO and the lamps; for timers; for L_REQ and L_STA while an idle, unobserved chip simulates its accesses
/// afterwards; and for missing registers, whose accesses are counted.
bool Board::stays(const Peripheral& of) const {
  if (of.kind == Peripheral::kTimer || of.kind == Peripheral::kWatchdog) return false;
  if (of.kind != Peripheral::kGpio) return true;
  if (of.number == kC) return r_req_ || r_sta_;
  return of.number != kG && !serial_.has_miso(of.number);
}

std::uint32_t Board::load_port(unsigned port, std::uint32_t offset) {
  const Levels there = offset == kGpioIdr ? outside(port) : Levels{0, 0};
  return ports_.at(port).read(offset, there.driven, there.levels);
}

/// Levels from the chip, the board's pull-up, the switches and the serial peripherals.
Board::Levels Board::outside(unsigned port) {
  Outputs chip;
  if (port == kC || port == kG || port == options_.wiring.interrupt.port || serial_.concerns(port)) come_up();
  if (port == kG) chip.lamps = pins_->lamps();
  if (port == kC && !options_.wiring.handshake.empty()) {
    chip.handshake = static_cast<unsigned>(pins_->l_req());
    chip.handshake |= static_cast<unsigned>(pins_->l_sta()) << 1U;
  }
  if (serial_.has_miso(port)) on_bus([&](Tick at) { chip.miso = bus_.miso(at); });
  return wired(port, chip);
}

Board::Levels Board::wired(unsigned port, const Outputs& chip) const {
  const SerialSide::Seen serial = serial_.seen(port, chip.miso);
  unsigned driven = options_.switches.held.at(port) | serial.driven;
  unsigned levels = options_.switches.levels.at(port) | serial.levels;
  const auto add = [&](unsigned pin, unsigned level) {
    driven |= 1U << pin;
    levels |= (level & 1U) << pin;
  };
  const Wiring& wiring = options_.wiring;
  if (port == wiring.reset.port) add(wiring.reset.pin, wiring.reset_high ? 0 : 1);
  if (port == wiring.interrupt.port) add(wiring.interrupt.pin, static_cast<unsigned>(interrupt_));
  if (port == kC && !wiring.handshake.empty()) add(kLReq.pin, chip.handshake), add(kLSta.pin, chip.handshake >> 1U);
  if (port == kG)
    for (unsigned i = 0; i < wiring.lamps.size(); ++i) add(kLampPin + i, chip.lamps >> i);
  return {static_cast<std::uint16_t>(driven), static_cast<std::uint16_t>(levels)};
}

// ------------------------------------------------------------------------------------------------- a debugger's looks

std::vector<MemoryRegion> Board::regions() const {
  std::vector<MemoryRegion> all = {{kPeripherals, kPeripheralsSize, false}, {Fsmc::kBase, Fsmc::kSize, false}};
  if (options_.chip) all.push_back({kBank1, kRegionSize, false});
  return all;
}

std::optional<std::uint32_t> Board::peek(std::uint32_t address) const {
  if (options_.chip && address - kBank1 < kRegionSize) {
    const tb::ChipView& chip = options_.chip(pins_->now());
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i)
      word |= std::uint32_t{chip.peek(static_cast<std::uint16_t>((address + i) & kChipMask))} << i * 8;
    return word;
  }
  if (const Peripheral* here = peripheral_at(address)) return peek_register(*here, address - here->base);
  if (address - kPeripherals >= kPeripheralsSize) return std::nullopt;
  return others_.peek(address);
}

std::uint32_t Board::peek_register(const Peripheral& of, std::uint32_t offset) const {
  switch (of.kind) {
    case Peripheral::kAfio: return exti_.read_afio(offset);
    case Peripheral::kExti: return exti_.read(offset);
    case Peripheral::kGpio: return peek_port(of.number, offset);
    case Peripheral::kTerminal: return terminal_.read(offset);
    case Peripheral::kSerial: return serial_.peek(static_cast<SerialSide::Block>(of.number), offset);
    case Peripheral::kRcc: return rcc_.read(offset);
    case Peripheral::kFlash: return flash_.read(offset);
    case Peripheral::kTimer: return timers_.at(of.number).peek(offset, core_.cycles());
    case Peripheral::kWatchdog: return watchdog_.read(offset, now());
    case Peripheral::kFsmc: return fsmc_.read(offset);
  }
  return 0;
}

std::uint32_t Board::peek_port(unsigned port, std::uint32_t offset) const {
  const tb::ChipView* const chip = options_.chip ? &options_.chip(pins_->now()) : nullptr;
  const auto levels = [chip](const std::vector<tb::PinNumber>& pins) {
    unsigned all = 0;
    for (std::size_t i = 0; i < pins.size(); ++i)
      all |= static_cast<unsigned>(chip != nullptr && chip->level(pins[i]) == 1) << i;
    return all;
  };
  const Wiring& wiring = options_.wiring;
  const Outputs outputs = {levels(wiring.handshake), levels(wiring.lamps),
                           chip == nullptr || !wiring.miso || chip->level(*wiring.miso) != 0};
  const Levels there = wired(port, outputs);
  return ports_.at(port).read(offset, there.driven, there.levels);
}

// ------------------------------------------------------------------------------------------------- stores

void Board::store_word(std::uint32_t address, std::uint32_t value) {
  core_.advance_to(core_.cycles() + kApbCycles);
  const Peripheral* const here = peripheral_at(address);
  if (here == nullptr) {
    if (!is_outside(address)) others_.write(address, value, core_.pc());
    return;
  }
  if (!answers(*here)) return;
  look_at(*here, address - here->base, value);
  store_register(*here, address - here->base, value);
}

void Board::store_register(const Peripheral& of, std::uint32_t offset, std::uint32_t value) {
  switch (of.kind) {
    case Peripheral::kGpio: store_gpio(of.number, offset, value); break;
    case Peripheral::kAfio:
      exti_.write_afio(offset, value);
      serial_.remap(exti_.read_afio(kAfioMapr));
      update_serial_pins();
      break;
    case Peripheral::kExti:
      come_up();
      exti_.write(offset, value);
      update_interrupts();
      break;
    case Peripheral::kTerminal: terminal_.write(offset, value); break;
    case Peripheral::kSerial: store_serial(static_cast<SerialSide::Block>(of.number), offset, value); break;
    case Peripheral::kRcc: store_rcc(offset, value); break;
    case Peripheral::kFlash:
      flash_.write(offset, value);
      follow_flash();
      check_clock();
      break;
    case Peripheral::kTimer:
      timers_.at(of.number).write(offset, value, core_.cycles());
      plan_timers();
      update_interrupts();
      break;
    case Peripheral::kWatchdog: watchdog_.write(offset, value, now()); break;
    case Peripheral::kFsmc:
      fsmc_.write(offset, value);
      bus_changed_ = true;
      set_access_timing();
      break;
  }
}

/// EXTI also sees pins that are outputs.
void Board::store_gpio(unsigned port, std::uint32_t offset, std::uint32_t value) {
  come_up();
  Gpio& gpio = ports_.at(port);
  const Gpio before = gpio;
  gpio.write(offset, value);
  bus_changed_ = bus_changed_ || offset <= kGpioCrh;
  look_at_pins(port, before, before.addressed(offset, value));
  update_pins();
  update_serial_pins();
  if (!exti_.listens(port)) return;
  for (unsigned pin = 0; pin < 16; ++pin) {
    const bool level = gpio.level(pin, false);
    if (before.drives(pin) && gpio.drives(pin) && before.level(pin, false) != level) exti_.edge(port, pin, level);
  }
  update_interrupts();
}

void Board::store_rcc(std::uint32_t offset, std::uint32_t value) {
  meet_devices();
  rcc_.write(offset, value);
  if (!options_.fsmc.hclk_mhz) follow_clock();
  serial_.follow(rcc_);
  follow_timers();
  update_serial_pins();
  update_interrupts();
  check_clock();
}

/// Their clock is PCLK1, doubled where APB1 divides (7.2).
void Board::follow_timers() {
  const unsigned divider = std::max(rcc_.apb1_divider() / 2, 1U);
  for (unsigned i = 0; i < timers_.size(); ++i) {
    timers_.at(i).follow(divider, rcc_.is_clocked(Rcc::kApb1enr, i), core_.cycles());
    if ((rcc_.apb1_resets() >> i & 1U) != 0) timers_.at(i).reset();
  }
  plan_timers();
}

void Board::follow_flash() { core_.set_flash(flash_.wait_states(), flash_.prefetch()); }

/// RM0008, FLASH_ACR: one wait state for each 24 MHz of SYSCLK after the first.
void Board::check_clock() {
  const std::int64_t hz = rcc_.sysclk_hz(), wanted = (hz - 1) / kSysclkWithoutWait;
  const bool slow = hz <= kGreatestHclk && wanted > flash_.wait_states();
  if (const bool told = std::exchange(slow_flash_, slow); slow && !told)
    misused(tb::board_code::kFlashLatency,
            fmt::format("SYSCLK is {} MHz with {} wait states of flash (FLASH_ACR.LATENCY), which needs {}",
                        hz / 1'000'000, flash_.wait_states(), wanted));
  const std::int64_t hclk = rcc_.hclk_hz(), pclk1 = hclk / rcc_.apb1_divider();
  const bool fast = hclk > kGreatestHclk || pclk1 > kGreatestPclk1;
  if (const bool told = std::exchange(fast_, fast); fast && !told)
    misused(tb::board_code::kClockFast,
            hclk > kGreatestHclk ? fmt::format("HCLK is {} MHz, expected at most 72 MHz", hclk / 1'000'000)
                                 : fmt::format("PCLK1 is {} MHz, expected at most 36 MHz", pclk1 / 1'000'000));
}

void Board::store_serial(SerialSide::Block block, std::uint32_t offset, std::uint32_t value) {
  meet_devices();
  if (offset == kSerialDr.at(block)) look_at_serial_pins(block);
  serial_.write(block, offset, value, core_.cycles(), core_.pc());
  update_serial_pins();
  update_interrupts();
}

// ------------------------------------------------------------------------------------------------- registers' tags

/// The FSMC waits for a chip that is wired to NWAIT.
bool Board::is_followed(const Peripheral& of, const Tag& tag) const {
  return options_.wiring.wait && of.kind == Peripheral::kFsmc && Fsmc::is_wait(tag);
}

void Board::look_at(const Peripheral& of, std::uint32_t offset, std::optional<std::uint32_t> written) {
  if (of.registers->is_plain(offset)) return;
  const RegisterEntry* const to = of.registers->find(offset);
  const std::uint32_t address = of.base + offset;
  if (to == nullptr && is_new(address, kNoRegister))
    note(fmt::format("{} has no register at 0x{:08X} on the board", of.name, address));
  if (to == nullptr || !written) return;
  for (const Tag* tag : of.registers->asked(offset, *written))
    if (!is_followed(of, *tag) && is_new(address, tag->bit))
      note(fmt::format("{}_{}.{} is set to {}{:X}, which the board does not have", of.name, to->name, tag->name,
                       tag->value_in(*written) > 9 ? "0x" : "", tag->value_in(*written)));
}

// ------------------------------------------------------------------------- what a real board would not forgive

bool Board::answers(const Peripheral& of) {
  if (of.clock_enables == 0 || rcc_.is_clocked(of.clock_enables, of.clock_bit)) return true;
  misused(tb::board_code::kClockOff, fmt::format("{} is used while its clock is off in RCC_{}", of.name,
                                                 Rcc::kRegisters.find(of.clock_enables)->name));
  return false;
}

/// Lines that the chip drives, and those that firmware moves by a port.
std::vector<Board::Wire> Board::wires() const {
  std::vector<Wire> all = {{options_.wiring.interrupt, options_.wiring.interrupt_name, true},
                           {options_.wiring.reset, "RESET"}};
  const PortPin first_of_spi = options_.card == 2 ? PortPin{kB, 12} : PortPin{kA, 4};
  switch (options_.mode) {
    case HostMode::kParallel:
      if (!has_handshake()) break;
      all.insert(all.end(), {{kRReq, "R_REQ", false, true},
                             {kRSta, "R_STA", false, true},
                             {kLReq, "L_REQ", true},
                             {kLSta, "L_STA", true}});
      break;
    case HostMode::kSpi:
      all.insert(all.end(), {{first_of_spi, "XSS"}, {{first_of_spi.port, first_of_spi.pin + 2}, "MISO", true}});
      break;
    case HostMode::kUart: all.push_back({{kA, 3}, "TXD", true}); break;
  }
  return all;
}

void Board::look_at_pins(unsigned port, const Gpio& before, std::uint32_t addressed) {
  for (Wire& wire : wires_) {
    if (wire.at.port != port) continue;
    const unsigned pin = wire.at.pin;
    if (!wire.from_chip)
      look_at_output(wire, addressed);
    else if (ports_.at(port).drives(pin) && !before.drives(pin))
      misused(tb::board_code::kPinConflict,
              fmt::format("{} is an output, and the chip drives {}", pin_name(wire.at), wire.name));
  }
}

/// One store before the pin is an output gives it its first level.
void Board::look_at_output(Wire& wire, std::uint32_t addressed) {
  const auto [port, pin] = wire.at;
  if ((addressed >> pin & 1U) == 0) return;
  const Gpio& gpio = ports_.at(port);
  const bool is_output = gpio.is_output(pin);
  wire.unheard = is_output ? 0 : wire.unheard + 1;
  const bool stays_low = is_output && wire.pushed && !gpio.is_pushed(pin) && !gpio.drives(pin);
  if (!stays_low && wire.unheard < 2) return;
  misused(tb::board_code::kPinMode, fmt::format("{} ({}) is {}", pin_name(wire.at), wire.name,
                                                stays_low ? "set while it is open drain: it stays low"
                                                          : "set or cleared while it is not an output"));
}

bool Board::is_in_use(SerialSide::Block block) const {
  return block == SerialSide::kUsart2 ? options_.mode == HostMode::kUart
                                      : options_.mode == HostMode::kSpi && block + 1U == options_.card;
}

void Board::look_at_serial_pins(SerialSide::Block block) {
  if (!is_in_use(block)) return;
  in_service_ = true;
  const std::string wrong = serial_.wrong_pin(block);
  if (wrong.empty()) return;
  const char* const name = block == SerialSide::kUsart2 ? "USART2" : block == SerialSide::kSpi1 ? "SPI1" : "SPI2";
  misused(tb::board_code::kPinMode, fmt::format("{} sends while {} is not its pin", name, wrong));
}

/// All others come up first: the bench hears of it in order of time.
void Board::misused(const tb::BoardCode& code, const std::string& text) {
  come_up();
  tell(code, text);
}

void Board::tell(const tb::BoardCode& code, const std::string& text, std::optional<std::uint32_t> pc) {
  if (on_error) on_error({std::max(now(), turn_), code.code, text, place_of(pc.value_or(core_.place()))});
}

// ------------------------------------------------------------------------------------------------- notes

std::vector<std::string> Board::serial_notes() const {
  std::vector<std::string> lines;
  for (const Peripheral& each : kMap) {
    const auto block = static_cast<SerialSide::Block>(each.number);
    if (each.kind == Peripheral::kSerial && serial_.lost(block) != 0)
      lines.push_back(fmt::format("{}: {} bytes were lost, since those before them had not been fetched ({})",
                                  each.name, serial_.lost(block), block == SerialSide::kUsart2 ? "ORE" : "OVR"));
  }
  return lines;
}

void Board::note(const std::string& text) {
  notes_.push_back(fmt::format("{}, first in {}", text, options_.firmware->lines.at(core_.pc())));
}

}  // namespace dsdpv1::arm
