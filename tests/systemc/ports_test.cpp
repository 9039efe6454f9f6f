// Ports that may stay unbound, are traced, or meet wires of sc_logic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "model/systemc/logic_wires.hpp"
#include "tests/systemc/bench.hpp"
#include "tests/systemc/own_process.hpp"

namespace dsdpv1 {

using sc_dt::sc_logic;
using testing::HasSubstr;

namespace {

/// A module with the pins of the DSDPV1 whose inputs are bound only.
struct Inputs {
  sc_core::sc_signal<bool> low{"low"}, high{"high", true};
  sc_core::sc_signal<sc_dt::sc_uint<11>> a{"a"};
  sc_core::sc_signal_rv<8> d{"d"};
  systemc::PinModule chip{"chip"};
  Changes changes;

  Inputs() {
    chip.RESET(high), chip.R_REQ(low), chip.R_STA(low), chip.CSR(high), chip.RD(high), chip.WR(high), chip.A(a);
    chip.D(d), chip.PBRXD(high);
    chip.on_pin = [this](Tick at, Pin pin, Level level) { changes.push_back({at, pin, level}); };
  }
};

TEST(OptionalPorts, OutputsOfThePinModulesMayStayUnbound) {
  const std::string told = in_a_process_of_its_own([] {
    Inputs inputs;
    sc_core::sc_start(150, sc_core::SC_US);
    return std::to_string(only(inputs.changes, Pin::kLReq).size()) + " " + inputs.chip.kind();
  });
  EXPECT_GT(std::stoi(told), 100);
}

std::string read(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(OptionalPorts, AreTracedBeforeTheyAreBoundAndNotIfTheyStayUnbound) {
  const std::string path = testing::TempDir() + "ports_test_trace";
  in_a_process_of_its_own([&] {
    Inputs inputs;
    sc_core::sc_signal<bool> l_req{"l_req"};
    sc_core::sc_trace_file* file = sc_core::sc_create_vcd_trace_file(path.c_str());
    sc_trace(file, inputs.chip.L_REQ, "L_REQ_by_port");
    sc_trace(file, inputs.chip.L_STA, "L_STA_unbound");
    sc_trace(file, inputs.chip.CLK, "CLK_unbound");
    sc_trace(file, inputs.chip.R_REQ, "R_REQ_by_port");
    sc_trace(file, inputs.chip.D, "D_by_port");
    inputs.chip.L_REQ(l_req);
    sc_core::sc_start(60, sc_core::SC_US);
    sc_core::sc_close_vcd_trace_file(file);
    return std::string();
  });
  const std::string trace = read(path + ".vcd");
  for (const char* name : {"L_REQ_by_port", "R_REQ_by_port", "D_by_port"}) EXPECT_THAT(trace, HasSubstr(name));
  EXPECT_EQ(trace.find("unbound"), std::string::npos);
  std::istringstream declaration(trace.substr(trace.find("$var")));  // $var wire 1 aaaaa L_REQ_by_port
  std::string word, id, name;
  declaration >> word >> word >> word >> id >> name;
  EXPECT_EQ(name, "L_REQ_by_port");
  EXPECT_THAT(trace, HasSubstr("\n1" + id + "\n"));
  std::remove((path + ".vcd").c_str());
}

TEST(LogicWires, CarryLevelsAndReadZAndXAsThePull) {
  const std::string told = in_a_process_of_its_own([] {
    collect_reports();
    sc_core::sc_signal<sc_logic> net{"net"}, back{"back"};
    sc_core::sc_signal<bool> up{"up"}, down{"down"};
    systemc::FromLogic from{"from", true}, other{"other", false};
    systemc::ToLogic to{"to"};
    from.in(net), from.out(up), other.in(net), other.out(down), to.in(up), to.out(back);
    std::string seen;
    thread([&] {
      for (const char level : {'X', '0', '1', 'Z', 'X', '0', 'X'}) {
        net.write(sc_logic(level));
        sc_core::wait(1, sc_core::SC_NS);
        seen += std::string{level} + " " + std::to_string(up.read()) + std::to_string(down.read()) +
                back.read().to_char() + "\n";
      }
    });
    sc_core::sc_start(1, sc_core::SC_US);
    for (const auto& [type, text] : reports()) seen += type + " " + text + "\n";
    return seen;
  });
  EXPECT_EQ(told,
            "X 101\n0 000\n1 111\nZ 101\nX 101\n0 000\nX 101\n"
            "/dsdpv1/logic from: X, read as 1\n/dsdpv1/logic other: X, read as 0\n");
}

}  // namespace

void simulate() {}

}  // namespace dsdpv1
