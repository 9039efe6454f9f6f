#include "kinds/dsdpv1/claims/wires.hpp"

namespace dsdpv1::calibrate {
namespace {

constexpr const char* kHostPort = "pins of the host port";

WireTable make_wires() {
  WireTable all = {
#define DSDPV1_PIN(pin, name, ...) {name, "", 0, nullptr},
#define DSDPV1_BUS(...)
#define DSDPV1_RSU_PIN(...)
#include "model/dsdpv1/pins.inc"
  };
  for (const Wire strobe : {wire::kCsr, wire::kRd, wire::kWr}) all[static_cast<std::size_t>(strobe)].group = kHostPort;
  const auto add = [&all](const std::string& bus, std::size_t count) {
    for (std::size_t bit = 0; bit < count; ++bit) all.push_back({bus + std::to_string(bit), bus, bit, kHostPort});
  };
  add("A", kAddressWires);
  add("D", kDataWires);
  return all;
}

}  // namespace

const WireTable& wires() {
  static const WireTable all = make_wires();
  return all;
}

const std::vector<Wire>& host_port() {
  static const std::vector<Wire> all = wires_of(wires(), kHostPort);
  return all;
}

}  // namespace dsdpv1::calibrate
