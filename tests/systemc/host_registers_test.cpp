// A CPU that has only a bus: the handshake by registers, accesses without the DPRAM, and direct memory access.
#include "model/systemc/host_registers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/systemc/host_pins.hpp"
#include "tests/systemc/foreign_cpu.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::HostRegisters;
using dsdpv1::systemc::Ownership;
using dsdpv1::systemc::TlmOptions;
using dsdpv1::systemc::to_time;
using sc_core::sc_time;
using testing::HasSubstr;

namespace {

constexpr sc_dt::uint64 kRegisters = ForeignBus<>::kRegisters, kRequest = kRegisters, kState = kRegisters + 4,
                        kInterrupt = kRegisters + 8, kReset = kRegisters + 12;
constexpr std::uint16_t kCell = 0x130;
constexpr int kHolds = 5, kWrites = 40;

template <unsigned int kWidth>
using Cpu = ForeignCpu<kWidth>;

void bind(ForeignBus<32>& bus, systemc::TlmModule& chip, HostRegisters& registers) {
  bus.chip.bind(chip.host_socket), bus.registers.bind(registers.socket);
}
void bind(ForeignBus<64>& bus, systemc::TlmModule& chip, HostRegisters& registers) {
  bus.chip.bind(chip.host_socket_64), bus.registers.bind(registers.socket_64);
}
void bind(ForeignBus<8>& bus, systemc::TlmModule& chip, HostRegisters& registers) {
  bus.chip.bind(chip.host_socket_8), bus.registers.bind(registers.socket_8);
}

template <unsigned int kWidth>
struct PlatformOf {
  systemc::TlmModule chip;
  HostRegisters registers{"registers", {kRegisters}};
  ForeignBus<kWidth> bus{"bus"};
  ForeignCpu<kWidth> cpu;
  Changes changes;

  PlatformOf(const TlmOptions& options, typename ForeignCpu<kWidth>::Program program)
      : chip("chip", options), cpu("cpu", std::move(program)) {
    cpu.socket.bind(bus.socket);
    bind(bus, chip, registers);
    registers.connect(chip);
    chip.on_pin = [this](Tick at, Pin pin, dsdpv1::Level level) { changes.push_back({at, pin, level}); };
  }
};

TlmOptions options(Ownership ownership = Ownership::kReport, bool dmi = false) {
  TlmOptions options;
  options.observed = mask(Pin::kLReq) | mask(Pin::kLSta);
  options.ownership = ownership;
  options.dmi = dmi;
  return options;
}

template <class AnyCpu>
void start(AnyCpu& cpu) {
  cpu.pass(kUs);
  cpu.write(kReset, 1);
  cpu.pass(200 * kUs);
}
template <class AnyCpu>
void take(AnyCpu& cpu) {
  cpu.write(kRequest, HostRegisters::kReq);
  cpu.pass(kUs / 8);
  while ((cpu.read(kState) & (HostRegisters::kLReq | HostRegisters::kLSta)) != 0) {
  }
  cpu.write(kRequest, HostRegisters::kReq | HostRegisters::kSta);
  cpu.pass(kUs / 8);
}

/// Without any synchronisation.
template <class AnyCpu>
void hold_and_write(AnyCpu& cpu) {
  start(cpu);
  for (int hold = 0; hold < kHolds; ++hold) {
    take(cpu);
    for (int i = 0; i < kWrites; ++i) {
      cpu.write(static_cast<sc_dt::uint64>(kCell + i), static_cast<std::uint8_t>(hold + i));
      EXPECT_EQ(cpu.response, tlm::TLM_OK_RESPONSE);
    }
    cpu.write(kRequest, 0);
  }
}

/// The pins' changes, the written cells and the reports.
template <unsigned int kWidth = 32>
std::string run(double quantum_us, const TlmOptions& with, typename ForeignCpu<kWidth>::Program program,
                double until_us = 400) {
  return in_a_process_of_its_own([&] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
    PlatformOf<kWidth> platform(with, program);
    sc_core::sc_start(until_us, sc_core::SC_US);
    platform.chip.sync();
    if (testing::Test::HasFailure()) throw std::runtime_error("failures in the simulation");
    std::string told;
    for (const auto& [at, pin, level] : platform.changes)
      told += std::to_string(at) + " " + dsdpv1::name(pin) + " " + std::to_string(level) + "\n";
    for (int i = 0; i < kWrites; ++i)
      told += std::to_string(platform.chip.peek(static_cast<std::uint16_t>(kCell + i))) + " ";
    told += "\n" + std::to_string(reports().size()) + " reports\n";
    for (const auto& [type, text] : reports()) told += type + ": " + text + "\n";
    return told + std::to_string(platform.cpu.ahead) + " ahead\n";
  });
}

/// As run(), without what depends on the quantum.
std::string but_for_ahead(const std::string& told) { return told.substr(0, told.rfind('\n', told.size() - 2)); }

TEST(HostRegisters, AnInitiatorThatNeverSynchronisesIsAheadInEachHoldAndTheSameWithAnyQuantum) {
  const std::string coupled = run(0, options(), hold_and_write<Cpu<32>>);
  EXPECT_THAT(coupled, HasSubstr(" 42 43 \n0 reports\n0 ahead"));
  EXPECT_THAT(coupled, HasSubstr(" R_STA 1\n"));
  for (const double quantum : {1., 10., 100.}) {
    const std::string decoupled = run(quantum, options(), hold_and_write<Cpu<32>>);
    EXPECT_EQ(first_difference(but_for_ahead(decoupled), but_for_ahead(coupled)), "") << quantum;
    EXPECT_THAT(decoupled, HasSubstr("\n200 ahead\n")) << quantum;
  }
}

TEST(HostRegisters, InitiatorsOfOtherWidthsBindWithoutAnAdapter) {
  const std::string normal = run(10, options(), hold_and_write<Cpu<32>>);
  EXPECT_EQ(run<64>(10, options(), hold_and_write<Cpu<64>>), normal);
  EXPECT_EQ(run<8>(10, options(), hold_and_write<Cpu<8>>), normal);
}

TEST(HostRegisters, ReadsWritesAndResponses) {
  run(
      10, options(),
      [](Cpu<32>& cpu) {
        const auto word = [&](sc_dt::uint64 address) {
          std::uint8_t bytes[4] = {9, 9, 9, 9};
          cpu.transport(tlm::TLM_READ_COMMAND, address, bytes, 4);
          return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | bytes[3] << 24;
        };
        cpu.pass(kUs);
        EXPECT_EQ(word(kRequest), 0);
        EXPECT_EQ(word(kState), HostRegisters::kIntr0);
        std::uint8_t all[16] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
        cpu.transport(tlm::TLM_WRITE_COMMAND, kRegisters, all, 16);
        EXPECT_EQ(cpu.response, tlm::TLM_OK_RESPONSE);
        EXPECT_EQ(word(kRequest), 3);
        EXPECT_EQ(word(kInterrupt), 0);
        EXPECT_EQ(word(kReset), 1);
        cpu.read(kRegisters + 16);
        EXPECT_EQ(cpu.response, tlm::TLM_ADDRESS_ERROR_RESPONSE);
        cpu.transport(tlm::TLM_WRITE_COMMAND, kReset, all, 0);
        EXPECT_EQ(cpu.response, tlm::TLM_BURST_ERROR_RESPONSE);
        const sc_time before = cpu.now();
        cpu.read(kState);
        EXPECT_EQ(cpu.now() - before, to_time(168));
      });
}

/// INTR0 by a test that is the chip.
TEST(HostRegisters, AFallOfIntr0IsKeptUntilItIsCleared) {
  const std::string told = in_a_process_of_its_own([] {
    HostRegisters registers("registers", {kRegisters});
    std::string seen;
    ForeignCpu<> cpu("cpu", [&](ForeignCpu<>& self) {
      const auto note = [&] {
        seen += std::to_string(self.read(kInterrupt)) + std::to_string(registers.IRQ.read()) + " ";
      };
      note();
      self.pass(3 * kUs);
      note();
      self.write(kInterrupt, 0);
      note();
      self.write(kInterrupt, 1);
      note();
    });
    cpu.socket.bind(registers.socket);
    thread([&] {
      wait_until(kUs);
      registers.INTR0.write(false);
      wait_until(2 * kUs);
      registers.INTR0.write(true);
    });
    sc_core::sc_start(10, sc_core::SC_US);
    return seen;
  });
  EXPECT_EQ(told, "00 11 11 00 ");
}

TEST(HostRegisters, AreSavedAndRestored) {
  const std::string told = in_a_process_of_its_own([] {
    HostRegisters one("one"), other("other");
    std::string seen;
    ForeignCpu<> cpu("cpu", [&](ForeignCpu<>& self) {
      self.pass(3 * kUs);
      self.write(HostRegisters::kRequest, 2);
      self.write(HostRegisters::kReset, 1);
      other.restore(one.save());
      self.pass(kUs);
      for (const auto* wire : {&other.R_REQ, &other.R_STA, &other.RESET, &other.IRQ})
        seen += std::to_string(wire->read());
    });
    cpu.socket.bind(one.socket);
    thread([&] {
      wait_until(kUs);
      one.INTR0.write(false);
    });
    sc_core::sc_start(10, sc_core::SC_US);
    return seen;
  });
  EXPECT_EQ(told, "0111");
}

TEST(HostRegisters, ADebuggerReadsAndWritesWithoutTime) {
  run(
      0, options(),
      [](Cpu<32>& cpu) {
        const auto debug = [&](tlm::tlm_command command, sc_dt::uint64 address, std::uint8_t& byte) {
          tlm::tlm_generic_payload payload;
          payload.set_command(command);
          payload.set_address(address);
          payload.set_data_ptr(&byte);
          payload.set_data_length(1);
          return cpu.socket->transport_dbg(payload);
        };
        std::uint8_t one = 1, read = 0;
        EXPECT_EQ(debug(tlm::TLM_WRITE_COMMAND, kRequest, one), 1U);
        EXPECT_EQ(debug(tlm::TLM_READ_COMMAND, kRequest, read), 1U);
        EXPECT_EQ(read, 1);
        EXPECT_EQ(debug(tlm::TLM_READ_COMMAND, kRegisters + 16, read), 0U);
        EXPECT_EQ(cpu.now(), sc_core::SC_ZERO_TIME);
      });
}

// --- without the DPRAM -----------------------------------------------------------------------------------------------

class WithoutTheDpram : public testing::TestWithParam<double> {};

TEST_P(WithoutTheDpram, AnAccessIsReported) {
  const std::string told = run(GetParam(), options(), [](Cpu<32>& cpu) {
    start(cpu);
    cpu.write(kCell, 7);
    EXPECT_EQ(cpu.response, tlm::TLM_OK_RESPONSE);
  });
  EXPECT_THAT(told, HasSubstr("\n7 0 0 "));
  EXPECT_THAT(told, HasSubstr("1 reports\n/dsdpv1/violation: chip: HOST_NOT_OWNER"));
}

TEST_P(WithoutTheDpram, AnAccessIsRefused) {
  const std::string told = run(GetParam(), options(Ownership::kRefuse), [](Cpu<32>& cpu) {
    cpu.pass(kUs);
    cpu.write(kReset, 1);
    cpu.write(kRequest, 3);
    cpu.write(kCell, 6);  // the start-up is not over
    EXPECT_EQ(cpu.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
    cpu.write(kRequest, 0);
    cpu.pass(200 * kUs);
    const sc_time before = cpu.now();
    cpu.write(kCell, 7);
    EXPECT_EQ(cpu.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
    EXPECT_EQ(cpu.now(), before);
    take(cpu);
    std::uint8_t two[2] = {8, 9};
    cpu.transport(tlm::TLM_WRITE_COMMAND, kCell + 1, two, 2);
    EXPECT_EQ(cpu.response, tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(cpu.read(kCell + 2), 9);
  });
  EXPECT_THAT(told, HasSubstr("\n0 8 9 0 "));
  EXPECT_THAT(told, HasSubstr("0 reports\n"));
}

TEST_P(WithoutTheDpram, AnAccessWaitsForTheHold) {
  const std::string told = run(GetParam(), options(Ownership::kWait), [](Cpu<32>& cpu) {
    start(cpu);
    for (int i = 0; i < 20; ++i) {
      cpu.write(kRequest, 3);  // at once, also while the chip has an access
      cpu.write(kCell, static_cast<std::uint8_t>(i));
      EXPECT_EQ(cpu.response, tlm::TLM_OK_RESPONSE);
      EXPECT_EQ(cpu.read(kCell), i);
      cpu.write(kRequest, 0);
      cpu.pass(kUs + 77 * i);
    }
  });
  EXPECT_THAT(told, HasSubstr("\n19 0 0 "));
  EXPECT_EQ(told.find("HOST_NOT_OWNER"), std::string::npos) << told;
}

TEST_P(WithoutTheDpram, AnAccessThatNobodyAskedForEndsWithAnError) {
  const std::string told = run(
      GetParam(), options(Ownership::kWait),
      [](Cpu<32>& cpu) {
        start(cpu);
        const sc_time before = cpu.now();
        cpu.write(kCell, 7);
        EXPECT_EQ(cpu.response, tlm::TLM_GENERIC_ERROR_RESPONSE);
        EXPECT_EQ(cpu.now() - before, to_time(1000 * kUs));
        cpu.write(kRequest, 1);
        cpu.write(kCell, 7);
        cpu.write(kRequest, 3);
        cpu.write(kReset, 0);
        cpu.read(kCell);
      },
      4000);
  EXPECT_THAT(told,
              HasSubstr("/dsdpv1/ownership: chip: the access of B130 has waited 1 ms for the DPRAM: R_REQ is low, "
                        "nobody asks for it\n"));
  EXPECT_THAT(told, HasSubstr("for the DPRAM: R_STA is low\n"));
  EXPECT_THAT(told, HasSubstr("for the DPRAM: RESET is low\n"));
  EXPECT_THAT(told, HasSubstr("3 reports\n"));
}

INSTANTIATE_TEST_SUITE_P(Quantum, WithoutTheDpram, testing::Values(0., 10.),
                         [](const auto& row) { return row.param == 0 ? "Of0" : "Of10us"; });

// --- direct memory access --------------------------------------------------------------------------------------------

TEST(DirectMemoryAccess, IsForAHoldAndEndsWithIt) {
  const std::string told = run(10, options(Ownership::kReport, true), [](Cpu<32>& cpu) {
    start(cpu);
    tlm::tlm_dmi dmi;
    EXPECT_FALSE(cpu.ask_dmi(dmi));
    take(cpu);
    cpu.write(kCell, 1);
    EXPECT_TRUE(cpu.dmi_hint);
    ASSERT_TRUE(cpu.ask_dmi(dmi));
    EXPECT_TRUE(dmi.is_read_write_allowed());
    EXPECT_EQ(dmi.get_start_address(), 0U);
    EXPECT_EQ(dmi.get_end_address(), 0x7FFU);
    EXPECT_EQ(dmi.get_read_latency(), to_time(HostAccess::read(0, {}).duration()));
    EXPECT_EQ(dmi.get_write_latency(), to_time(HostAccess::write(0, 0, {}).duration()));
    std::uint8_t* cells = dmi.get_dmi_ptr();
    EXPECT_EQ(cells[kCell], 1);
    EXPECT_EQ(cells[0x004], 0xC5);
    cpu.write(kCell + 1, 2);
    cells[kCell + 1] = 3;  // the later of the two
    EXPECT_EQ(cpu.read(kCell + 1), 3);
    EXPECT_EQ(cpu.withdrawn, 0);
    cpu.write(kRequest, HostRegisters::kSta);
    EXPECT_EQ(cpu.withdrawn, 1);
    EXPECT_FALSE(cpu.ask_dmi(dmi));
    EXPECT_EQ(dmi.get_dmi_ptr(), nullptr);
    cpu.write(kRequest, 0);
    take(cpu);
    ASSERT_TRUE(cpu.ask_dmi(dmi));
    cpu.write(kReset, 0);
    EXPECT_EQ(cpu.withdrawn, 2);
    EXPECT_FALSE(cpu.ask_dmi(dmi));
  });
  EXPECT_THAT(told, HasSubstr("\n1 3 0 "));
}

TEST(DirectMemoryAccess, IsDeniedUnlessTheOptionIsSetAndNobodyObservesThePins) {
  const auto given = [](const TlmOptions& with) {
    return run(10, with, [](Cpu<32>& cpu) {
      start(cpu);
      take(cpu);
      tlm::tlm_dmi dmi;
      cpu.write(kCell, 1);
      cpu.write(kCell, cpu.dmi_hint || cpu.ask_dmi(dmi) ? 2 : 3);
    });
  };
  EXPECT_THAT(given(options()), HasSubstr("\n3 0 0 "));
  EXPECT_THAT(given(options(Ownership::kReport, true)), HasSubstr("\n2 0 0 "));
  TlmOptions observed = options(Ownership::kReport, true);
  observed.observed |= mask(Pin::kCsr);
  EXPECT_THAT(given(observed), HasSubstr("\n3 0 0 "));
}

// --- how far ---------------------------------------------------------------------------------------------------------

TEST(HowFar, AHolderMayRunWithoutALimitOthersNotAtAll) {
  in_a_process_of_its_own([] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(10, sc_core::SC_US));
    systemc::TlmModule* chip = nullptr;
    PlatformOf<32> platform(
        options(),
        [&](Cpu<32>& cpu) {
          start(cpu);
          EXPECT_FALSE(chip->user_holds());
          EXPECT_EQ(chip->ahead_until(), sc_core::sc_time_stamp());
          const sc_time next = chip->next_action();
          EXPECT_GT(next, sc_core::sc_time_stamp());
          EXPECT_LE(next,
                    sc_core::sc_time_stamp() + sc_time(1, sc_core::SC_US));  // its next access, or the end of this
          const auto changes = platform.changes.size();
          const sc_time last = sc_time::from_value(1);
          sc_core::wait(next - last - sc_core::sc_time_stamp());
          EXPECT_EQ(platform.changes.size(), changes);
          sc_core::wait(last);
          sc_core::wait(sc_core::SC_ZERO_TIME);
          EXPECT_EQ(platform.changes.size(), changes + 2);
          take(cpu);
          EXPECT_TRUE(chip->user_holds());
          EXPECT_EQ(chip->ahead_until(), sc_core::sc_max_time());
          EXPECT_GT(chip->next_action(), sc_core::sc_time_stamp() + sc_time(10, sc_core::SC_US));
          cpu.write(kRequest, 0);
          EXPECT_EQ(chip->ahead_until(), sc_core::sc_time_stamp());
        });
    chip = &platform.chip;
    sc_core::sc_start(400, sc_core::SC_US);
    if (testing::Test::HasFailure()) throw std::runtime_error("failures in the simulation");
    return std::string();
  });
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
