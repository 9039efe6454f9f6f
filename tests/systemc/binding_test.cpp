// Missing and impossible bindings are reported by name, each in a separate process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/systemc/host_pins.hpp"
#include "model/systemc/rsu_pins.hpp"
#include "model/systemc/rsu_tlm.hpp"
#include "model/systemc/spc3_pins.hpp"
#include "model/systemc/spc3_tlm.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

using dsdpv1::systemc::RsuStraps;
using dsdpv1::systemc::RsuTlmModule;
using testing::HasSubstr;

namespace {

/// The outcome of a platform that `build` makes.
template <class Build>
std::string start(Build build) {
  return in_a_process_of_its_own([=]() -> std::string {
    collect_reports();
    try {
      const auto platform = build();
      sc_core::sc_start(1, sc_core::SC_US);
    } catch (const sc_core::sc_report& report) {
      return std::string(report.get_msg_type()) + ": " + report.get_msg();
    }
    return "started";
  });
}

template <class Module>
struct Platform {
  sc_core::sc_signal<bool> reset, r_req, r_sta;
  Module chip;
  template <class... Options>
  explicit Platform(const Options&... options) : chip("chip", options...) {
    chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
  }
};

struct Spc3Alone {
  sc_core::sc_signal<bool> reset;
  systemc::Spc3TlmModule chip{"chip"};
  Spc3Alone() { chip.RESET(reset); }
};

std::string rsu_with(const RsuStraps& straps) {
  return start([=] {
    systemc::RsuTlmOptions options;
    options.straps = straps;
    return std::make_unique<Platform<RsuTlmModule>>(options);
  });
}

TEST(Binding, TheSocketOfTheLivePortMustBeBound) {
  EXPECT_EQ(start([] { return std::make_unique<Platform<systemc::TlmModule>>(); }),
            "/dsdpv1/binding: chip.host_socket is not bound, and it is the host port");
  EXPECT_EQ(start([] { return std::make_unique<Spc3Alone>(); }),
            "/dsdpv1/binding: chip.host_socket is not bound, and it is the user CPU's");
  EXPECT_EQ(rsu_with({HostMode::kParallel}),
            "/dsdpv1/binding: chip.host_socket is not bound, and the straps choose the parallel port");
  EXPECT_EQ(rsu_with({HostMode::kSpi}), "/dsdpv1/binding: chip.spi_socket is not bound, and the straps choose SPI");
  EXPECT_EQ(rsu_with({HostMode::kUart}),
            "/dsdpv1/binding: chip.uart_socket is not bound, and the straps choose the UART");
}

TEST(Binding, AStrapThatThereIsNotIsNamed) {
  EXPECT_EQ(rsu_with({HostMode::kSpi, 4}), "/dsdpv1/straps: chip: the strap ADR is 4, expected 0 to 3");
  EXPECT_EQ(rsu_with({HostMode::kUart, 1, 7, -1}), "/dsdpv1/straps: chip: the strap UIV is -1, expected 0 to 7");
}

TEST(Binding, APinOfTheRsuThatIsNotBoundIsNamed) {
  EXPECT_THAT(start([] { return std::make_unique<systemc::RsuPinModule>("chip"); }),
              HasSubstr("port not bound: port 'chip.UIV'"));  // SystemC checks the last port first
}

/// Names that SystemC has made up, as it does for an object without a name: its kind and a number.
void add_made_up(const sc_core::sc_object& parent, std::string& names) {
  for (const sc_core::sc_object* child : parent.get_child_objects()) {
    const std::string kind = std::string(child->kind()).substr(3) + "_";  // "sc_mutex"
    if (std::string(child->basename()).rfind(kind, 0) == 0) names += child->name() + std::string("\n");
    add_made_up(*child, names);
  }
}

TEST(Binding, EachObjectOfAModuleHasItsName) {
  EXPECT_EQ(in_a_process_of_its_own([] {
              const RsuTlmModule rsu("rsu");
              const systemc::RsuPinModule pins("pins");
              const systemc::HostPins host("host");
              const systemc::Spc3TlmModule spc3("spc3");
              const systemc::Spc3PinModule spc3_pins("spc3_pins");
              std::string names;
              for (const sc_core::sc_object* top : sc_core::sc_get_top_level_objects()) add_made_up(*top, names);
              return names;
            }),
            "");
}

/// The attributes of a module, with their values.
std::string attributes(const sc_core::sc_object& module) {
  std::string all;
  for (const sc_core::sc_attr_base* each : module.attr_cltn())
    all += each->name() + " " + std::to_string(dynamic_cast<const sc_core::sc_attribute<std::uint32_t>&>(*each).value) +
           "\n";
  return all;
}

TEST(ModuleParameters, AreListedByTheModules) {
  const std::string told = in_a_process_of_its_own([] {
    systemc::PinOptions slow;
    slow.chip.search_window_ms = 77;
    const systemc::PinModule plain("plain", slow);
    const RsuTlmModule rsu("rsu");
    const systemc::Spc3TlmModule spc3("spc3");
    return attributes(plain) + "\n" + attributes(rsu) + "\n" + attributes(spc3);
  });
  const std::size_t rsu = told.find("\n\n"), spc3 = told.rfind("\n\n");
  EXPECT_EQ(told.substr(0, rsu + 1),
            "access_interval 48\nready_cycles 4096\nrts_lead 4\nrts_trail 4\nintr_low 64\nintr_gap 64\n"
            "search_window_ms 77\nsearch_window_bits 4000\nbaud_control_ms 600\nfcb_rule 0\n");
  EXPECT_THAT(told.substr(rsu, spc3 - rsu), HasSubstr("spi_miso_delay 120\n"));
  EXPECT_THAT(told.substr(rsu, spc3 - rsu), HasSubstr("uart_gaps_0 7\nuart_gaps_1 2\n"));
  EXPECT_THAT(told.substr(spc3), HasSubstr("\nint_delay 1\n"));
}

TEST(ModuleParameters, AreSetByAnAdapterWithinTheirRanges) {
  Config config;
  int rows = 0;
  systemc::each_parameter(config, [&](const systemc::ParameterRow& row, std::uint32_t& value) {
    EXPECT_GE(value, row.least) << row.name;
    EXPECT_LE(value, row.most) << row.name;
    value = row.most;
    ++rows;
  });
  EXPECT_EQ(rows, 10);
  EXPECT_EQ(config.rts_lead, 32U);
  EXPECT_EQ(config.spi_strobe, 600U);  // another part's
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
