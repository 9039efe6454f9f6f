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

}  // namespace

void simulate() {}

}  // namespace dsdpv1
