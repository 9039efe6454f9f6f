// A foreign initiator at the TLM module: its accesses ahead of simulation time, and its warnings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/systemc/bench.hpp"
#include "tests/systemc/foreign_initiator.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

using sc_core::sc_time;

namespace {

struct Platform : sc_core::sc_module {
  dsdpv1::systemc::TlmModule chip;
  ForeignInitiator initiator{"initiator"};
  sc_core::sc_signal<bool> reset{"reset"}, r_req{"r_req"}, r_sta{"r_sta"};
  Changes changes;

  explicit Platform(const sc_core::sc_module_name& name, const systemc::TlmOptions& own = options())
      : sc_module(name), chip("chip", own) {
    initiator.socket.bind(chip.host_socket);
    initiator.R_REQ(r_req), initiator.R_STA(r_sta);
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
    chip.on_pin = [this](Tick at, Pin pin, dsdpv1::Level level) { changes.push_back({at, pin, level}); };
    reset.write(true);
  }
  static dsdpv1::systemc::TlmOptions options() {
    dsdpv1::systemc::TlmOptions options;
    options.observed = mask(Pin::kLReq) | mask(Pin::kLSta);
    return options;
  }
  std::string memory() const {
    std::string text;
    for (int i = 0; i < ForeignInitiator::kWrites; ++i)
      text += std::to_string(chip.peek(static_cast<std::uint16_t>(0x130 + i))) + " ";
    return text;
  }
};

/// The chip's neighbour.
enum class Beside { kNothing, kAClock, kAnotherChip };

struct Told {
  double share = 0;
  std::string result;
};

Told run(double quantum_us, Beside beside) {
  const std::string text = in_a_process_of_its_own([=] {
    set_resolution();
    collect_reports();
    tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
    Platform platform("platform");
    std::unique_ptr<Platform> other;
    std::unique_ptr<sc_core::sc_clock> clock;
    if (beside == Beside::kAnotherChip) other = std::make_unique<Platform>("other");
    if (beside == Beside::kAClock) clock = std::make_unique<sc_core::sc_clock>("clock", sc_time(10, sc_core::SC_NS));
    sc_core::sc_start(400, sc_core::SC_US);
    std::string told = std::to_string(1.0 * platform.initiator.ahead / platform.initiator.accesses) + "\n";
    for (const auto& [at, pin, level] : platform.changes)
      told += std::to_string(at) + " " + dsdpv1::name(pin) + " " + std::to_string(level) + "\n";
    return told + platform.memory() + std::to_string(reports().size());
  });
  return {std::stod(text), text.substr(text.find('\n'))};
}

}  // namespace

void simulate() {}

TEST(ForeignInitiator, IsAheadWithEveryAccessOfAHoldHoweverLargeTheQuantumAndWhateverElseRuns) {
  const Told coupled = run(0, Beside::kNothing);
  EXPECT_EQ(coupled.share, 0);
  EXPECT_NE(coupled.result.find(" 48 0"), std::string::npos) << coupled.result;  // the last byte; no report
  for (const Beside beside : {Beside::kNothing, Beside::kAClock, Beside::kAnotherChip})
    for (const double quantum_us : {1., 10., 100.}) {
      const Told decoupled = run(quantum_us, beside);
      EXPECT_EQ(decoupled.share, 1) << quantum_us << " us, beside " << static_cast<int>(beside);
      EXPECT_EQ(first_difference(decoupled.result, coupled.result), "");
    }
}

TEST(ForeignInitiator, IsToldOnceThatItForgotToSynchronise) {
  const auto told = [](double quantum_us) {
    return in_a_process_of_its_own([=] {
      set_resolution();
      collect_reports();
      tlm::tlm_global_quantum::instance().set(sc_time(quantum_us, sc_core::SC_US));
      Platform platform("platform");
      platform.initiator.forgets_to_synchronise = true;
      sc_core::sc_start(400, sc_core::SC_US);
      std::string text;
      for (const std::string& each : reports_of("/dsdpv1/ahead", "platform.chip")) text += each + "\n";
      return text;
    });
  };
  EXPECT_EQ(told(0), "");
  EXPECT_EQ(told(100),
            "platform.chip: R_REQ changes at 104 us, but the chip's user is at 109553333333 fs already; an initiator "
            "has to wait for its local time first\n");
}

TEST(ForeignInitiator, AReportThatThrowsLeavesTheTransactionAndTheNextIsAsUsual) {
  const std::string told = in_a_process_of_its_own([] {
    set_resolution();
    sc_core::sc_report_handler::set_actions("/dsdpv1/violation", sc_core::SC_THROW);
    Platform platform("platform");
    platform.initiator.begins_without_a_hold = true;
    sc_core::sc_start(400, sc_core::SC_US);
    return std::to_string(platform.initiator.thrown) + " thrown, " + std::to_string(platform.initiator.accesses) +
           " accesses, " + platform.memory();
  });
  EXPECT_THAT(told, testing::StartsWith("1 thrown, 400 accesses, 9 10 11 "));
}

TEST(ForeignInitiator, AKilledOneReleasesItsPinsWhateverAnObserverThrows) {
  const std::string told = in_a_process_of_its_own([] {
    set_resolution();
    collect_reports();
    Platform platform("platform", systemc::TlmOptions());
    bool throws = false;
    platform.chip.on_pin = [&](Tick, Pin, dsdpv1::Level) {
      if (throws) throw std::runtime_error("from on_pin");
    };
    std::string levels;
    thread([&] {
      while (platform.chip.chip().level(Pin::kWr) != 0) wait_until(systemc::current_tick() + 100);
      throws = true;
      platform.initiator.kill();
      throws = false;
      for (const Pin pin : {Pin::kRd, Pin::kWr, Pin::kCsr, Pin::kDIn, Pin::kA})
        levels += std::to_string(platform.chip.chip().level(pin)) + " ";
    });
    sc_core::sc_start(400, sc_core::SC_US);
    return levels;
  });
  EXPECT_EQ(told, "1 1 1 -1 2047 ");
}

}  // namespace dsdpv1
