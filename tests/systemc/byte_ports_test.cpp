// The serial ports of a DSDPV1-RSU, byte by byte, as SPI and UART controllers of other platforms move them: no payload
// of more than one byte, no extension, slave select as a signal or as a call, errors as flags. All pins move as with
// the sockets of whole frames and telegrams.
#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <deque>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "model/systemc/rsu_pins.hpp"
#include "model/systemc/rsu_tlm.hpp"
#include "model/systemc/spi_pins.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {
namespace {

using systemc::BusCharacter;
using systemc::RsuTlmModule;
using systemc::to_time;
using Bytes = std::vector<std::uint8_t>;

const Bytes kReadB014 = {0x01, 0x00, 0x14, 0x01, 0x18, 0xCF}, kReply = {0x81, 0x00, 0x00, 0xE8, 0x21};  // R15
constexpr Tick kAt = 200 * kUs, kUartBit = 26 * 250;

Bytes with_room(Bytes request) {
  request.resize(request.size() + kReply.size(), 0xFF);
  return request;
}

// --- components of another platform ----------------------------------------------------------------------------------

/// An SPI controller: one byte in, one byte out, and a pin of its port as slave select.
struct ForeignSpi : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<ForeignSpi> bus{"bus"};
  sc_core::sc_out<bool> cs{"cs"};
  std::function<void(bool)> gpio;  ///< instead of cs, if it is set
  tlm_utils::tlm_quantumkeeper keeper;

  explicit ForeignSpi(const sc_core::sc_module_name& name) : sc_module(name) { cs.initialize(true); }

  void select(bool level) {
    keeper.sync();
    gpio ? gpio(level) : cs.write(level);
  }
  std::uint8_t transfer(std::uint8_t out) {
    tlm::tlm_generic_payload payload;
    payload.set_read();
    payload.set_data_ptr(&out);
    payload.set_data_length(1);
    payload.set_streaming_width(1);
    sc_core::sc_time local = keeper.get_local_time();
    bus->b_transport(payload, local);
    keeper.reset();
    keeper.set(local);
    return payload.is_response_ok() ? out : 0xEE;
  }
  /// A frame as firmware does it, without a thought for times.
  Bytes frame(const Bytes& out) {
    Bytes in;
    select(false);
    for (const std::uint8_t byte : out) in.push_back(transfer(byte));
    select(true);
    return in;
  }
};

/// A UART: a byte goes out as soon as it is written, what comes in waits with its flags.
struct ForeignUart : sc_core::sc_module, tlm::tlm_analysis_if<BusCharacter> {
  tlm::tlm_analysis_port<BusCharacter> tx{"tx"};
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> rx{"rx"};
  std::deque<BusCharacter> fifo;
  bool throws = false;

  explicit ForeignUart(const sc_core::sc_module_name& name) : sc_module(name) { rx.bind(*this); }
  void put(std::uint8_t byte, bool parity_ok = true, bool stop_ok = true) {
    BusCharacter character;
    character.data = byte;
    character.parity_ok = parity_ok;
    character.stop_ok = stop_ok;
    tx.write(character);
  }
  void write(const BusCharacter& character) override {
    if (throws) throw std::runtime_error("from the UART");
    fifo.push_back(character);
  }
};

// --- a chip and what is seen -----------------------------------------------------------------------------------------

struct Card {
  RsuTlmModule chip;
  sc_core::sc_signal<bool, sc_core::SC_MANY_WRITERS> reset;
  sc_core::sc_signal<bool> low;
  Changes changes;
  bool throws = false;

  Card(const char* name, HostMode mode) : chip(name, options(mode)) {
    chip.RESET(reset), chip.R_REQ(low), chip.R_STA(low);
    chip.on_pin = [this](Tick at, Pin pin, Level level) {
      changes.push_back({at, pin, level});
      if (throws && pin == Pin::kSck) throw std::runtime_error("from on_pin");
    };
    thread([this] {
      wait_until(kUs);
      reset.write(true);
    });
  }
  static systemc::RsuTlmOptions options(HostMode mode) {
    systemc::RsuTlmOptions options;
    options.straps.mode = mode;
    options.report_violations = false;
    return options;
  }
  std::string told(std::initializer_list<Pin> pins) const {
    std::ostringstream out;
    for (const Pin pin : pins)
      for (const Change& change : only(changes, pin)) out << change << "\n";
    return out.str();
  }
};

std::string hex(const Bytes& bytes) {
  std::ostringstream out;
  for (const std::uint8_t byte : bytes) out << std::hex << unsigned{byte} << " ";
  return out.str();
}

/// The whole frame or telegram as one transaction.
struct Whole : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Whole> socket{"socket"};
  explicit Whole(const sc_core::sc_module_name& name) : sc_module(name) {}
  Bytes send(tlm::tlm_command command, Bytes data) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_data_ptr(data.data());
    payload.set_data_length(static_cast<unsigned>(data.size()));
    payload.set_streaming_width(static_cast<unsigned>(data.size()));
    sc_core::sc_time delay;
    socket->b_transport(payload, delay);
    return data;
  }
};

constexpr std::initializer_list<Pin> kSpiPins = {Pin::kXss, Pin::kSck, Pin::kMiso};

struct SpiBoard {
  Card card{"card", HostMode::kSpi}, second{"second", HostMode::kSpi};
  ForeignSpi spi{"spi"}, spi_of_second{"spi_of_second"};
  sc_core::sc_signal<bool> cs{"cs", true}, cs_of_second{"cs_of_second", true};

  explicit SpiBoard(bool by_call = false) {
    spi.bus.bind(card.chip.spi_socket), spi.cs(cs);
    spi_of_second.bus.bind(second.chip.spi_socket), spi_of_second.cs(cs_of_second);
    second.chip.XSS(cs_of_second);
    if (by_call)
      spi.gpio = [this](bool level) { card.chip.set_xss(level); };
    else
      card.chip.XSS(cs);
  }
};

std::string spi_told(double quantum_us, bool by_call) {
  return in_a_process_of_its_own([=] {
    tlm::tlm_global_quantum::instance().set({quantum_us, sc_core::SC_US});
    SpiBoard board(by_call);
    Bytes first, after, of_second;
    thread([&] {
      wait_until(kAt);
      board.spi.keeper.inc(to_time(777));
      first = board.spi.frame(with_room(kReadB014));
      board.spi.keeper.sync();
      wait_until(2 * kAt);
      after = board.spi.frame(with_room(kReadB014));
    });
    thread([&] {
      wait_until(kAt + 5 * kUs);
      of_second = board.spi_of_second.frame(with_room(kReadB014));
    });
    sc_core::sc_start(600, sc_core::SC_US);
    return hex(first) + "\n" + hex(after) + "\n" + hex(of_second) + "\n" + board.card.told(kSpiPins) +
           board.second.told(kSpiPins);
  });
}

std::string frames_told() {
  return in_a_process_of_its_own([] {
    Card card("card", HostMode::kSpi), second("second", HostMode::kSpi);
    Whole whole("whole"), whole_of_second("whole_of_second");
    whole.socket.bind(card.chip.spi_socket), whole_of_second.socket.bind(second.chip.spi_socket);
    Bytes first, after, of_second;
    thread([&] {
      wait_until(kAt + 777);
      first = whole.send(tlm::TLM_READ_COMMAND, with_room(kReadB014));
      wait_until(2 * kAt);
      after = whole.send(tlm::TLM_READ_COMMAND, with_room(kReadB014));
    });
    thread([&] {
      wait_until(kAt + 5 * kUs);
      of_second = whole_of_second.send(tlm::TLM_READ_COMMAND, with_room(kReadB014));
    });
    sc_core::sc_start(600, sc_core::SC_US);
    return hex(first) + "\n" + hex(after) + "\n" + hex(of_second) + "\n" + card.told(kSpiPins) + second.told(kSpiPins);
  });
}

TEST(SpiBytes, MoveThePinsAsAWholeFrameWithAnyQuantum) {
  const std::string whole = frames_told();
  EXPECT_NE(whole.find(hex(kReply)), std::string::npos);
  for (const double quantum_us : {0., 1., 10., 100.}) {
    EXPECT_EQ(first_difference(spi_told(quantum_us, false), whole), "") << "by signal, " << quantum_us << " us";
    EXPECT_EQ(first_difference(spi_told(quantum_us, true), whole), "") << "by call, " << quantum_us << " us";
  }
}

/// A chip by its pins, with the adapter between them and the controller.
struct PinBoard {
  systemc::RsuPinModule chip{"chip", options()};
  systemc::SpiPins adapter{"adapter"};
  ForeignSpi spi{"spi"};
  std::map<std::string, sc_core::sc_signal<bool>> wires;
  sc_core::sc_signal<sc_dt::sc_uint<11>> a;
  sc_core::sc_signal<sc_dt::sc_uint<2>> mode, adr;
  sc_core::sc_signal<sc_dt::sc_uint<3>> ubr, uiv;
  sc_core::sc_signal_rv<8> d;
  sc_core::sc_signal_resolved miso;
  sc_core::sc_signal<bool, sc_core::SC_MANY_WRITERS> reset;
  Changes changes;

  PinBoard() {
    chip.R_REQ(wires["low"]), chip.R_STA(wires["low"]), chip.CSR(wires["csr"]), chip.RD(wires["rd"]);
    chip.WR(wires["wr"]), chip.A(a), chip.D(d), chip.L_REQ(wires["l_req"]), chip.L_STA(wires["l_sta"]);
    chip.INTR0(wires["intr0"]), chip.PBRXD(wires["pbrxd"]), chip.PBTXD(wires["pbtxd"]), chip.PBRTS(wires["pbrts"]);
    chip.PBF(wires["pbf"]), chip.BR(wires["br"]), chip.READY(wires["ready"]), chip.RXD(wires["rxd"]);
    chip.TXD(wires["txd"]), chip.MODE(mode), chip.ADR(adr), chip.UBR(ubr), chip.UIV(uiv), chip.RESET(reset);
    for (const char* high : {"csr", "rd", "wr", "pbrxd", "rxd"}) wires[high].write(true);
    mode.write(static_cast<unsigned>(HostMode::kSpi)), adr.write(1);
    chip.XSS(wires["xss"]), chip.SCK(wires["sck"]), chip.MOSI(wires["mosi"]), chip.MISO(miso);
    adapter.XSS(wires["xss"]), adapter.SCK(wires["sck"]), adapter.MOSI(wires["mosi"]), adapter.MISO(miso);
    spi.bus.bind(adapter.socket), spi.cs(wires["cs"]);
    chip.on_pin = [this](Tick at, Pin pin, Level level) { changes.push_back({at, pin, level}); };
    thread([this] {
      wait_until(kUs);
      reset.write(true);
    });
  }
  static systemc::PinOptions options() {
    systemc::PinOptions options;
    options.report_violations = false;
    return options;
  }
};

std::string pins_told(bool by_bytes) {
  return in_a_process_of_its_own([=] {
    PinBoard board;
    if (by_bytes) board.adapter.CS(board.wires["cs"]);
    std::ostringstream out;
    thread([&] {
      for (const Tick at : {kAt + 777, 2 * kAt}) {
        wait_until(at);
        if (by_bytes) {
          out << hex(board.spi.frame(with_room(kReadB014))) << "\n";
        } else {
          Bytes data = with_room(kReadB014);
          tlm::tlm_generic_payload payload;
          payload.set_read();
          payload.set_data_ptr(data.data());
          payload.set_data_length(static_cast<unsigned>(data.size()));
          payload.set_streaming_width(static_cast<unsigned>(data.size()));
          sc_core::sc_time delay;
          board.spi.bus->b_transport(payload, delay);
          out << hex(data) << "\n";
        }
      }
    });
    sc_core::sc_start(600, sc_core::SC_US);
    for (const Pin pin : kSpiPins)
      for (const Change& change : only(board.changes, pin)) out << change << "\n";
    return out.str();
  });
}

TEST(SpiPins, MoveThePinsOfAChipAsItsSocketDoes) {
  const std::string socket = in_a_process_of_its_own([] {
    Card card("card", HostMode::kSpi);
    Whole whole("whole");
    whole.socket.bind(card.chip.spi_socket);
    std::ostringstream out;
    thread([&] {
      for (const Tick at : {kAt + 777, 2 * kAt}) {
        wait_until(at);
        out << hex(whole.send(tlm::TLM_READ_COMMAND, with_room(kReadB014))) << "\n";
      }
    });
    sc_core::sc_start(600, sc_core::SC_US);
    return out.str() + card.told(kSpiPins);
  });
  EXPECT_NE(socket.find(hex(kReply)), std::string::npos);
  EXPECT_EQ(first_difference(pins_told(false), socket), "") << "a frame";
  EXPECT_EQ(first_difference(pins_told(true), socket), "") << "byte by byte";
}

/// The reply to a request in its own frame.
bool is_answered(ForeignSpi& spi) {
  const Bytes in = spi.frame(with_room(kReadB014));
  return in.size() > kReadB014.size() && in[kReadB014.size()] == 0x81;
}

TEST(SpiBytes, AfterAKilledTransferAResetAndAnExceptionTheNextFrameIsAsUsual) {
  const std::string said = in_a_process_of_its_own([] {
    SpiBoard board;
    std::ostringstream out;
    thread([&] {
      wait_until(kAt);
      board.spi.select(false);
      auto killed = sc_core::sc_spawn([&] { board.spi.transfer(0x55); });
      wait_until(kAt + kUs);
      killed.kill();
      out << "killed: SCK " << board.card.chip.chip().level(Pin::kSck) << ", XSS "
          << board.card.chip.chip().level(Pin::kXss);
      board.spi.select(true);
      wait_until(kAt + 10 * kUs);
      out << ", " << is_answered(board.spi) << "\n";
      wait_until(kAt + 50 * kUs);
      board.spi.select(false);
      auto reset = sc_core::sc_spawn([&] { board.spi.transfer(0x01); });
      wait_until(kAt + 50 * kUs + kUs / 2);
      board.card.reset.write(false);
      wait(reset.terminated_event());
      board.spi.select(true);
      board.card.reset.write(true);
      wait_until(2 * kAt);
      out << "reset: " << is_answered(board.spi) << "\n";
      board.card.throws = true;
      try {
        is_answered(board.spi);
      } catch (const std::runtime_error& error) {
        out << error.what();
      }
      board.card.throws = false;
      board.spi.select(true);
      wait_until(2 * kAt + 50 * kUs);
      out << ", " << is_answered(board.spi) << "\n";
    });
    sc_core::sc_start(600, sc_core::SC_US);
    return out.str();
  });
  EXPECT_EQ(said, "killed: SCK 0, XSS 0, 1\nreset: 1\nfrom on_pin, 1\n");
}

TEST(SpiBytes, TwoFramesAtOneTimeAreTwoWithACall) {
  const std::string said = in_a_process_of_its_own([] {
    SpiBoard board(true);
    std::ostringstream out;
    thread([&] {
      wait_until(kAt);
      for (int i = 0; i < 2; ++i) out << is_answered(board.spi);
    });
    sc_core::sc_start(600, sc_core::SC_US);
    const Changes xss = only(board.card.changes, Pin::kXss);
    return out.str() + " " + std::to_string(xss.size()) + " " + std::to_string(xss.at(2).at - xss.at(1).at);
  });
  EXPECT_EQ(said, "11 4 " + std::to_string(SpiTiming().gap));
}

// --- UART ------------------------------------------------------------------------------------------------------------

struct UartBoard {
  Card card{"card", HostMode::kUart};
  Whole unused{"unused"};
  ForeignUart uart{"uart"};

  UartBoard() {
    unused.socket.bind(card.chip.uart_socket);
    uart.tx.bind(card.chip.uart_in);
    card.chip.uart_characters.bind(uart.rx);
  }
};

TEST(UartBytes, MoveThePinsAsAWholeTelegramAndTheReplyComesWithTimes) {
  const auto told = [](const Card& card) { return card.told({Pin::kRxd, Pin::kTxd}); };
  const std::string whole = in_a_process_of_its_own([&] {
    Card card("card", HostMode::kUart);
    Whole host("host");
    host.socket.bind(card.chip.uart_socket);
    thread([&] {
      wait_until(kAt);
      host.send(tlm::TLM_WRITE_COMMAND, kReadB014);
    });
    sc_core::sc_start(500, sc_core::SC_US);
    return told(card);
  });
  for (const double quantum_us : {0., 100.}) {
    const std::string bytes = in_a_process_of_its_own([&] {
      tlm::tlm_global_quantum::instance().set({quantum_us, sc_core::SC_US});
      UartBoard board;
      std::ostringstream out;
      thread([&] {
        wait_until(kAt);
        for (const std::uint8_t byte : kReadB014) board.uart.put(byte);
        out << board.card.chip.uart_waiting();
        wait(board.card.chip.uart_idle_event());
        out << " " << systemc::current_tick() - kAt << " " << board.card.chip.uart_waiting() << " ";
      });
      sc_core::sc_start(500, sc_core::SC_US);
      Bytes got;
      for (const BusCharacter& character : board.uart.fifo) got.push_back(character.data);
      const Tick apart = systemc::to_tick(board.uart.fifo.at(1).start) - systemc::to_tick(board.uart.fifo.at(0).start);
      return out.str() + hex(got) + std::to_string(apart) + "\n" + told(board.card);
    });
    const Tick duration = UartTelegram(kReadB014, UartTiming()).duration();
    EXPECT_EQ(bytes.substr(0, bytes.find('\n')),
              "5 " + std::to_string(duration) + " 0 " + hex(kReply) + std::to_string(11 * kUartBit));
    EXPECT_EQ(first_difference(bytes.substr(bytes.find('\n') + 1), whole), "") << quantum_us << " us";
  }
}

TEST(UartBytes, ErrorsGoBothWays) {
  const std::string said = in_a_process_of_its_own([] {
    UartBoard board;
    std::ostringstream out;
    const auto answered = [&] {
      wait_until(systemc::current_tick() + 150 * kUs);
      out << board.uart.fifo.size() << " ";
      board.uart.fifo.clear();
    };
    const auto send = [&](std::size_t wrong, bool parity_ok, bool stop_ok) {
      for (std::size_t i = 0; i < kReadB014.size(); ++i)
        board.uart.put(kReadB014[i], parity_ok || i != wrong, stop_ok || i != wrong);
      answered();
    };
    thread([&] {
      wait_until(kAt);
      send(2, false, true);
      send(2, true, false);
      board.uart.put(0, true, false);  // a break
      answered();
      send(9, true, true);
      const auto falls = [&] { return only(board.card.changes, Pin::kTxd).size(); };
      const std::size_t before = falls();
      for (const std::uint8_t byte : kReadB014) board.uart.put(byte);
      while (falls() == before) wait_until(systemc::current_tick() + kUs / 10);
      board.card.reset.write(false);  // in the reply's first start bit: the rest of the character is high
      wait_until(systemc::current_tick() + 20 * kUs);
      const BusCharacter cut = board.uart.fifo.at(0);
      out << board.uart.fifo.size() << " " << unsigned{cut.data} << cut.parity_ok << cut.stop_ok;
    });
    sc_core::sc_start(1500, sc_core::SC_US);
    const Changes rxd = only(board.card.changes, Pin::kRxd);
    Tick longest = 0;
    for (std::size_t i = 1; i < rxd.size(); ++i)
      if (rxd[i].level == 1) longest = std::max(longest, rxd[i].at - rxd[i - 1].at);
    return out.str() + " " + std::to_string(longest);
  });
  EXPECT_EQ(said, "0 0 0 5 1 25501 " + std::to_string(systemc::to_tick(to_time(half_bits(UartTiming(), 22)))))
      << "only the right telegram is answered; RXD is low for a whole character in the break";
}

TEST(UartBytes, AnExceptionOfTheReceiverLeavesTheSimulationWithItsText) {
  const std::string said = in_a_process_of_its_own([] {
    UartBoard board;
    board.uart.throws = true;
    thread([&] {
      wait_until(kAt);
      for (const std::uint8_t byte : kReadB014) board.uart.put(byte);
    });
    try {
      sc_core::sc_start(500, sc_core::SC_US);
    } catch (const sc_core::sc_report& report) {
      return std::string(report.get_msg());
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  });
  EXPECT_NE(said.find("from the UART"), std::string::npos) << said;
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
