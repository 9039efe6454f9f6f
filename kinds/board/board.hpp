#pragma once
// An evaluation board with an STM32F103 as a station's user CPU: it runs the firmware built for the real board.
//
//   PC6 R_REQ, PC7 R_STA  of a chip with a handshake: outputs, low until the firmware makes them so (pull-down)
//   PC8 L_REQ, PC9 L_STA  inputs
//   PE4 RESET             of the chip; inactive unless it is an output (pull-up or -down on the board)
//   PG6                   the chip's interrupt, through AFIO, EXTI line 6, IRQ 23
//   SPI1, SPI2, USART2    see serial_side.hpp
//   PG12, PG13, PG14      inputs: the chip's lamps (p)
//   PD6 NWAIT             the ready of a chip that has one
//                         a kind of chip may have other pins: wiring.hpp
//   other pins            inputs: held by BoardOptions::switches, else their own pull-up or pull-down
//   FSMC bank 1, NE1      0x60000000..0x63FFFFFF: A10..A0, D7..D0, two strobes, select; the 2 KB repeat
//   USART1                a terminal
//
// HCLK follows the firmware's RCC, starting at 8 MHz from the HSI. An instruction takes its own cycles, an access to a
// peripheral two more (p: the bridge to APB), and an access to the chip the time set in the FSMC's registers.
#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "board/cpu/cortex_m3.hpp"
#include "board/firmware/firmware.hpp"
#include "board/stm32/exti.hpp"
#include "board/stm32/flash_interface.hpp"
#include "board/stm32/fsmc.hpp"
#include "board/stm32/gpio.hpp"
#include "board/stm32/other_registers.hpp"
#include "board/stm32/rcc.hpp"
#include "board/stm32/terminal.hpp"
#include "board/stm32/timer.hpp"
#include "board/stm32/watchdog.hpp"
#include "kinds/board/board_codes.hpp"
#include "kinds/board/mailbox.hpp"
#include "kinds/board/memory_bus.hpp"
#include "kinds/board/serial_side.hpp"
#include "kinds/user_cpu/act_log.hpp"
#include "kinds/user_cpu/handshake_counters.hpp"
#include "kinds/user_cpu/native_cpu.hpp"
#include "model/dsdpv1/config.hpp"
#include "tb/chip/chip_view.hpp"
#include "tb/chip/user_cpu/station_cpu.hpp"

namespace dsdpv1::arm {

using bus::Tick;
struct Peripheral;

/// Switches that hold input pins.
struct Switches {
  std::array<std::uint16_t, 7> held{}, levels{};  ///< of ports A to G
};

struct BoardOptions {
  std::shared_ptr<const Firmware> firmware;
  Wiring wiring;
  /// At this place in the RAM, when the firmware has one.
  std::function<std::unique_ptr<Mailbox>(std::uint8_t* memory)> make_mailbox;
  /// Carries out what does not need the firmware; null: nothing. False: it is for the firmware.
  std::function<bool(const user_cpu::Command& command)> carry_out;
  user_cpu::FsmcOverride fsmc;
  std::optional<AccessTiming> access;  ///< edges that replace those of the FSMC
  Timing timing;
  Switches switches;
  unsigned card = 1;                                  ///< 1 or 2: selects the wiring of SPI
  bool serial = false;                                ///< the chip has the pins of SPI and UART
  HostMode mode = HostMode::kParallel;                ///< the port in use
  std::function<const tb::ChipView&(Tick now)> chip;  ///< the chip's state at `now`, for a debugger; null: not shown
  std::function<std::unique_ptr<Debugger>(DebugTarget&)> make_debugger;  ///< null: none
  std::vector<std::string> notes;                                        ///< first lines of BoardReport::notes
};

class Board final : public user_cpu::StationCpu, private user_cpu::Others, private System {
 public:
  /// The processor leaves reset at `start`. `set_chip_reset` puts the chip in its reset (false) or releases it; both
  /// must outlive the board.
  Board(user_cpu::HostBus& bus, BoardOptions options, std::function<void(Tick at, bool released)> set_chip_reset,
        Tick start);
  ~Board() override;

  Tick next() const override { return std::min(cpu_.next(), device_tick()); }
  void run(Tick now) override;
  void interrupt_changed(Tick at, bool level) override;
  void command(Tick now, const user_cpu::Command& command) override;
  user_cpu::UserCounters counters() const override;
  bool tells() const override { return mailbox_ != nullptr; }
  std::uint64_t outputs_received() const override { return mailbox_ ? mailbox_->outputs_received() : 0; }
  const std::vector<std::uint8_t>& outputs() const override { return mailbox_ ? mailbox_->outputs() : no_outputs_; }
  std::optional<user_cpu::BoardReport> board() const override;
  std::optional<user_cpu::Place> where(const user_cpu::Act& act) const override;

 private:
  struct InterruptEdge {
    Tick at;
    bool level;
  };
  /// A line between the chip and a pin of a port.
  struct Wire {
    PortPin at;
    const char* name;
    bool from_chip = false;
    bool pushed = false;   ///< pulled low, so that an open drain cannot raise it
    unsigned unheard = 0;  ///< stores to the pin since it was an output last
  };
  /// Levels driven onto a port's pins from outside the processor.
  struct Levels {
    std::uint16_t driven, levels;
  };
  /// The last load of L_REQ and L_STA.
  struct Look {
    std::uint64_t cycle = 0;
    std::uint32_t pc = 0;
  };
  static constexpr Tick kLsi = bus::kTicksPerSecond / 40'000;  ///< (p)

  // Others, called by the CPU that moves the pins
  Tick quiet_until() override;
  bool go_on(Tick tick) override;

  // System
  std::uint32_t load(std::uint32_t address, unsigned bytes) override;
  void store(std::uint32_t address, unsigned bytes, std::uint32_t value) override;
  std::uint64_t keep_up() override;
  void left_out(std::uint64_t since, std::uint64_t cycles) override;
  Tick looked_at() const { return tick_of(std::max(look_.cycle, since_cycle_)); }
  std::uint64_t due_cycle(Tick now, Tick next) const;
  Tick stays_until();
  std::optional<std::uint32_t> peek(std::uint32_t address) const override;
  std::vector<MemoryRegion> regions() const override;
  void sleep(std::uint64_t until) override;
  void reset() override;
  Tick now() const override { return tick_of(core_.cycles()); }

  bool has_news() const { return mailbox_ && mailbox_->has_news(); }
  void look_at_mailbox(Tick now);
  void run_firmware(user_cpu::Cpu& cpu);
  user_cpu::Place place_of(std::uint32_t pc) const;
  Tick serial_tick() const { return serial_.next() == SerialSide::kNever ? bus::kNever : tick_of(serial_.next()); }
  bool turn_goes_on(Tick tick);
  Tick timer_tick() const { return timers_at_ == Timer::kNever ? bus::kNever : tick_of(timers_at_); }
  Tick device_tick() const { return std::min(std::min(serial_tick(), timer_tick()), watchdog_.next()); }
  void run_devices(Tick now);
  void catch_up_timers();
  void plan_timers();
  void follow_timers();
  /// Bits for kDeviceIrq.
  unsigned device_requests() const { return serial_.requests() | timer_requests_ << kSerialIrq.size(); }
  void bite();
  void look_for_overruns();
  bool has_lost(SerialSide::Block block) const { return is_in_use(block) && serial_.lost(block) != lost_.at(block); }
  void tell_lost(SerialSide::Block block);
  void look_if_stuck();
  bool is_in_use(SerialSide::Block block) const;
  void storm(unsigned irq, std::uint32_t pc) override;
  void txd_changed(Tick at, bool level);
  void note_fault(const Fault& fault);
  void failed(const Fault& fault);
  void fail(Tick at, std::uint32_t pc, const std::string& why, const Registers& registers);
  void ended_by_debugger();
  Tick tick_of(std::uint64_t cycle) const;
  std::uint64_t cycle_of(Tick tick) const;
  void come_up();
  void come_up_for_access(bool write);
  void meet_devices();
  bool take_interrupt_edges();
  bool update_interrupts();
  void update_pins();
  void update_handshake();
  void update_serial_pins();
  void on_bus(const std::function<void(Tick)>& action);
  void store_gpio(unsigned port, std::uint32_t offset, std::uint32_t value);
  void store_rcc(std::uint32_t offset, std::uint32_t value);
  void store_serial(SerialSide::Block block, std::uint32_t offset, std::uint32_t value);
  std::vector<std::string> serial_notes() const;
  void follow_clock();
  void follow_flash();
  void check_clock();
  std::vector<Wire> wires() const;
  std::int64_t hclk_hz() const;

  std::uint32_t load_chip(std::uint32_t address, unsigned bytes);
  void store_chip(std::uint32_t address, unsigned bytes, std::uint32_t value);
  void end_accesses(unsigned count);
  void set_access_timing();
  bool waits(const user_cpu::FsmcTiming& timing) const;
  bool may_access(std::uint32_t address, bool write);
  bool has_right_bus();
  bool has_handshake() const { return !options_.wiring.handshake.empty() && options_.mode == HostMode::kParallel; }
  void tell_wrong_bus();
  std::uint32_t load_by_wrong_bus(std::uint32_t address, unsigned bytes);
  void store_by_wrong_bus(std::uint32_t address, unsigned bytes, std::uint32_t value);
  bool is_outside(std::uint32_t address);
  std::uint32_t load_word(std::uint32_t address);
  std::uint32_t load_register(const Peripheral& of, std::uint32_t offset);
  std::uint32_t peek_register(const Peripheral& of, std::uint32_t offset) const;
  void store_word(std::uint32_t address, std::uint32_t value);
  void store_register(const Peripheral& of, std::uint32_t offset, std::uint32_t value);
  bool stays(const Peripheral& of) const;
  std::uint32_t load_port(unsigned port, std::uint32_t offset);
  Levels outside(unsigned port);
  /// Inputs from the chip's outputs: L_REQ, L_STA; lamps as in user_cpu::HostBus; MISO.
  struct Outputs {
    unsigned handshake = 0, lamps = 0;
    bool miso = true;
  };
  Levels wired(unsigned port, const Outputs& chip) const;
  std::uint32_t peek_port(unsigned port, std::uint32_t offset) const;
  /// Notes uses of a register that a real one would not support or the board does not model.
  void look_at(const Peripheral& of, std::uint32_t offset, std::optional<std::uint32_t> written);
  bool is_followed(const Peripheral& of, const Tag& tag) const;
  /// False: it has no clock.
  bool answers(const Peripheral& of);
  void look_at_pins(unsigned port, const Gpio& before, std::uint32_t addressed);
  void look_at_output(Wire& wire, std::uint32_t addressed);
  void look_at_serial_pins(SerialSide::Block block);
  void misused(const tb::BoardCode& code, const std::string& text);
  /// In the line at work, or that of `pc`.
  void tell(const tb::BoardCode& code, const std::string& text, std::optional<std::uint32_t> pc = {});
  /// True once for each; `what`: a bit of the register, or more.
  bool is_new(std::uint32_t address, unsigned what) { return noted_.emplace(address, what).second; }
  void note(const std::string& text);

  BoardOptions options_;
  user_cpu::HostBus& bus_;
  std::function<void(Tick at, bool released)> set_chip_reset_;
  // `since_` is the tick of cycle `since_cycle_`; from there a cycle takes `cycle_ticks_` / `cycle_parts_` ticks.
  Tick since_, cycle_ticks_ = 1, cycle_parts_ = 1;
  std::uint64_t since_cycle_ = 0;
  user_cpu::ActLog acts_;
  SerialSide::Ports ports_;
  SerialSide serial_;
  Exti exti_;
  Rcc rcc_;
  FlashInterface flash_;
  Terminal terminal_;
  std::array<Timer, 4> timers_;              ///< TIM2 to TIM5
  std::uint64_t timers_at_ = Timer::kNever;  ///< the next one's next()
  unsigned timer_requests_ = 0;              ///< bit 0: TIM2
  Watchdog watchdog_{kLsi};
  std::array<std::uint64_t, 3> lost_{};                                    ///< SerialSide::lost, as told
  std::array<Tick, 3> lost_since_{bus::kNever, bus::kNever, bus::kNever};  ///< the first of those not told
  Tick turn_ = 0;        ///< of run(): the time of a processor that sleeps stands still
  bool bitten_ = false;  ///< the next reset is the watchdog's
  Fsmc fsmc_;
  user_cpu::WaitTiming read_wait_, write_wait_;
  MemoryBus memory_bus_;
  bool bus_changed_ = true;  ///< since memory_bus_ was looked at
  std::vector<Wire> wires_;
  std::uint64_t touched_at_ = 0;  ///< the cycle of the last access or wake-up
  Tick quiet_ = 0;      ///< before it no other agent acts, as long as the firmware touches nothing outside of RAM
  bool polls_ = false;  ///< that was a read of a register that stays
  std::uint64_t look_at_ = 0;               ///< the cycle at which it is looked whether the firmware is stuck
  bool in_service_ = false;                 ///< the chip has been accessed
  bool slow_flash_ = false, fast_ = false;  ///< the clocks are wrong, and that has been told
  OtherRegisters others_;
  std::deque<InterruptEdge> interrupt_edges_;  ///< not yet reached by the processor
  bool interrupt_ = true;                      ///< the level of the chip's interrupt
  bool r_req_ = false, r_sta_ = false, released_ = true, chip_reset_due_ = false;
  Look look_;
  user_cpu::HandshakeCounters handshake_;
  bool devices_acted_ = false;  ///< since the last update of requests_
  unsigned requests_ = 0;       ///< of exti_ and, above them, device_requests(), as last passed to the processor
  std::set<std::pair<std::uint32_t, unsigned>> noted_;  ///< by is_new
  std::vector<std::string> notes_;
  std::optional<Fault> fault_;  ///< that the firmware would have handled
  CortexM3 core_;
  std::unique_ptr<Debugger> debugger_;
  std::unique_ptr<Mailbox> mailbox_;
  std::vector<std::uint8_t> no_outputs_;  ///< of firmware without a mailbox
  user_cpu::Cpu* pins_ = nullptr;         ///< of cpu_, while the processor runs
  user_cpu::NativeCpu cpu_;               // destroyed before everything that its fiber uses
};

}  // namespace dsdpv1::arm
