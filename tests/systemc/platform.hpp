#pragma once
// A platform as users build it: the TLM module, a user CPU with the C driver that judges parameters and configuration
// and exchanges data, and a station that brings it from power-on to data exchange.
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "bus/telegram/telegram.hpp"
#include "driver/systemc/driver_cpu.hpp"
#include "driver/systemc/serial_cpu.hpp"
#include "model/systemc/rsu_tlm.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1::platform {

using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::DriverCpu;
using dsdpv1::systemc::SpiDriverCpu;
using dsdpv1::systemc::to_tick;
using dsdpv1::systemc::to_time;
using dsdpv1::systemc::UartDriverCpu;

constexpr std::uint8_t kSlave = 9, kMaster = 2;
constexpr int kExchanges = 12;
constexpr Tick kBit = 1000, kBusBegins = 400 * kUs, kBetween = 150 * kUs;  // 12 Mbit/s
constexpr Tick kEnd = kBusBegins + (kExchanges + 8) * kBetween;
constexpr int kSerialSlower = 10;  ///< approximate factor for a user CPU at a serial port

/// The requests with which a master starts its slave.
inline std::vector<bus::Bytes> requests() {
  using namespace bus;  // NOLINT(google-build-using-namespace)
  constexpr std::uint8_t kFirst = fc::kRequest | fc::kFcb | fc::kSrdHigh;
  constexpr std::uint8_t kSame = fc::kRequest | fc::kFcv | fc::kSrdHigh, kOther = kSame | fc::kFcb;
  const auto encoded = [](std::uint8_t code, const Bytes& data, std::optional<std::uint8_t> dsap) {
    return encode(make_telegram(kSlave, kMaster, code, data, dsap, dsap ? std::optional(sap::kMaster) : std::nullopt));
  };
  std::vector<Bytes> all(2, encode(make_telegram(kSlave, kMaster, fc::kRequest | fc::kFdlStatus)));
  all.push_back(encoded(kFirst, {}, sap::kSlaveDiag));
  all.push_back(encoded(kSame, {0x80, 1, 1, 11, 0x0C, 0x0D, 0, 0x00, 0x42}, sap::kSetPrm));
  all.push_back(encoded(kOther, {0x13, 0x23}, sap::kChkCfg));
  all.push_back(encoded(kSame, {}, sap::kSlaveDiag));
  for (int i = 0; i < kExchanges; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    all.push_back(encoded(i % 2 == 0 ? kOther : kSame, {byte, 0xA5, 0x5A, byte}, std::nullopt));
  }
  return all;
}

/// The user's program; it logs its observations with its local time.
class User {
 public:
  std::ostringstream log;

  template <class Cpu>
  void run(Cpu& cpu) {
    cpu_ = &cpu;
    dsdpv1_judge judge{};
    judge.ctx = this;
    judge.prm = [](void* ctx, const std::uint8_t*, std::uint8_t length) {
      static_cast<User*>(ctx)->say() << "parameters, " << unsigned{length} << " bytes of the user's\n";
      return DSDPV1_ACCEPT;
    };
    judge.cfg = [](void* ctx, const dsdpv1_cfg_block* block) {
      static_cast<User*>(ctx)->say() << "configuration, " << unsigned{block->length} << " bytes\n";
      return DSDPV1_ACCEPT;
    };
    open(cpu, judge);
    cpu.spend(sc_core::sc_time(1, sc_core::SC_US));
    cpu.set_reset(true);
    say() << "ready: " << dsdpv1_error_text(dsdpv1_wait_ready(&cpu.device())) << "\n";
    say() << "initialised: " << dsdpv1_error_text(dsdpv1_initialise(&cpu.device(), &config())) << "\n";
    for (;;) cycle();
  }

 private:
  static void open(DriverCpu& cpu, const dsdpv1_judge& judge) { dsdpv1_open(&cpu.device(), &cpu.port(), &judge); }
  static void open(SpiDriverCpu& cpu, const dsdpv1_judge& judge) {
    dsdpv1_open_spi(&cpu.device(), &cpu.port(), &judge);
  }
  static void open(UartDriverCpu& cpu, const dsdpv1_judge& judge) {
    dsdpv1_open_uart(&cpu.device(), &cpu.port(), &judge);
  }
  static const dsdpv1_config& config() {
    static const std::uint8_t cfg[] = {0x13, 0x23};
    static dsdpv1_config c{};
    c.address = kSlave;
    c.ident = 0x0C0D;
    c.max_input = c.max_output = 4;
    c.max_prm = 8;
    c.max_cfg = c.cfg_length = sizeof cfg;
    c.prm_mode = c.cfg_mode = 2;
    c.cfg = cfg;
    return c;
  }
  std::ostream& say() { return log << "tick " << to_tick(cpu_->now()) << " "; }

  void cycle() {
    if (cpu_->wait_for_intr0(sc_core::sc_time(40, sc_core::SC_US)))
      say() << "INTR0: " << dsdpv1_error_text(dsdpv1_service(&cpu_->device())) << "\n";
    const std::uint8_t inputs[] = {++count_, 1, 2, 3};
    std::uint8_t outputs[DSDPV1_MAX_IO];
    dsdpv1_exchange_result result{};
    result.outputs = outputs;
    result.capacity = sizeof outputs;
    const dsdpv1_error error = dsdpv1_exchange(&cpu_->device(), DSDPV1_INPUT_NEWEST, inputs, sizeof inputs, &result);
    if (error != DSDPV1_OK) say() << "exchange: " << dsdpv1_error_text(error) << "\n";
    if (result.outputs_new) say() << "outputs " << unsigned{outputs[0]} << "\n";
  }

  dsdpv1::systemc::ProgramCpu* cpu_ = nullptr;
  std::uint8_t count_ = 0;
};

/// A station on the chip's line that starts the chip, and the complete report of the run.
class Station : tlm::tlm_analysis_if<BusCharacter> {
 public:
  /// `adds_up`: the station's times are sums of rounded times, as of a station without ticks.
  /// `slower`: so much later, and with longer pauses.
  Station(dsdpv1::systemc::TlmModule& chip, const User& user, bool adds_up, int slower = 1)
      : chip_(chip), user_(user), adds_up_(adds_up), slower_(slower) {
    chip.bus_out.bind(*this);
    chip.on_pin = [this](Tick at, Pin pin, dsdpv1::Level level) { pins_ << Change{at, pin, level} << "\n"; };
    chip.on_event = [this](const profibus::Event& event) {
      events_ << "tick " << event.at << " " << profibus::code(event.reason) << "\n";
    };
    thread([this] { ask(); });
  }

  int answered() const { return answered_; }
  /// With the DPRAM at the end.
  std::string told() {
    chip_.sync();
    std::ostringstream out;
    out << "the user:\n" << user_.log.str() << "characters:\n" << answers_.str() << "events:\n" << events_.str();
    out << "pins:\n" << pins_.str() << "DPRAM:\n" << std::hex << std::setfill('0');
    for (std::uint16_t cell = 0; cell < 0x800; ++cell)
      out << std::setw(2) << unsigned{chip_.peek(cell)} << (cell % 32 == 31 ? "\n" : " ");
    return out.str();
  }

 private:
  void ask() {
    Tick at = slower_ * kBusBegins;
    for (const bus::Bytes& request : requests()) {
      wait_until(at);
      sc_core::sc_time sum = to_time(at);
      for (std::size_t i = 0; i < request.size(); ++i) {
        const sc_core::sc_time start = adds_up_ ? sum : to_time(at + static_cast<Tick>(i) * 11 * kBit);
        chip_.bus_in->write({start, to_time(kBit), request[i], true, true});
        sum += 11 * to_time(kBit);
      }
      at += slower_ * kBetween;
    }
  }
  void write(const BusCharacter& character) override {
    answers_ << "tick " << to_tick(character.start) << " " << std::hex << unsigned{character.data} << std::dec
             << (character.parity_ok && character.stop_ok ? "\n" : " wrong\n");
    ++answered_;
  }

  dsdpv1::systemc::TlmModule& chip_;
  const User& user_;
  bool adds_up_;
  int slower_;
  std::ostringstream pins_, events_, answers_;
  int answered_ = 0;
};

struct Platform {
  static constexpr std::uint32_t kUnobservedAccesses = dsdpv1::kOutputPins & ~dsdpv1::mask(Pin::kDOut);

  User user;
  dsdpv1::systemc::TlmModule chip;
  DriverCpu cpu{"cpu", [this](DriverCpu& itself) { user.run(itself); }};
  sc_core::sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"}, l_req{"l_req"}, l_sta{"l_sta"},
      intr0{"intr0"};
  Station station;

  explicit Platform(bool adds_up = false, std::uint32_t observed = kUnobservedAccesses)
      : chip("chip", options(observed)), station(chip, user, adds_up) {
    cpu.socket.bind(chip.host_socket);
    cpu.RESET(reset), cpu.R_REQ(r_req), cpu.R_STA(r_sta), cpu.L_REQ(l_req), cpu.L_STA(l_sta), cpu.INTR0(intr0);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta), chip.L_REQ(l_req), chip.L_STA(l_sta), chip.INTR0(intr0);
  }
  static dsdpv1::systemc::TlmOptions options(std::uint32_t observed) {
    dsdpv1::systemc::TlmOptions options;
    options.observed = observed;
    return options;
  }
  std::string told() { return station.told(); }
};

/// The same with a DSDPV1-RSU, on one of its serial ports.
template <class Cpu>
struct SerialPlatform {
  User user;
  dsdpv1::systemc::RsuTlmModule chip{"chip", options()};
  Cpu cpu{"cpu", [this](Cpu& itself) { user.run(itself); }, kCard};
  sc_core::sc_signal<bool> reset{"reset"}, low{"low"}, intr0{"intr0"};
  Station station{chip, user, false, kSerialSlower};

  SerialPlatform() {
    bind(cpu);
    cpu.RESET(reset), cpu.INTR0(intr0);
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low), chip.INTR0(intr0);
  }
  std::string told() { return station.told(); }

 private:
  static constexpr std::uint8_t kCard = 2;  ///< ADR

  void bind(SpiDriverCpu& spi) { spi.socket.bind(chip.spi_socket); }
  void bind(UartDriverCpu& uart) {
    uart.socket.bind(chip.uart_socket);
    chip.uart_out.bind(uart.uart_in);
  }
  static dsdpv1::systemc::RsuTlmOptions options() {
    dsdpv1::systemc::RsuTlmOptions options;
    options.straps = {std::is_same_v<Cpu, SpiDriverCpu> ? HostMode::kSpi : HostMode::kUart, kCard};
    return options;
  }
};

}  // namespace dsdpv1::platform
