#pragma once
// The wires of the chip in a capture: table 1.
#include "lab/calibrate/wires.hpp"
#include "model/dsdpv1/pins.hpp"

namespace dsdpv1::calibrate {

constexpr std::size_t kAddressWires = dsdpv1::width(dsdpv1::Pin::kA), kDataWires = dsdpv1::width(dsdpv1::Pin::kDIn);

/// Single pins; A0 to A10 and D0 to D7 follow kA and kD.
namespace wire {

enum class Place : std::uint8_t {
#define DSDPV1_PIN(pin, ...) pin,
#define DSDPV1_BUS(...)
#define DSDPV1_RSU_PIN(...)
#include "model/dsdpv1/pins.inc"
  kA,
  kD = kA + kAddressWires,
};
#define DSDPV1_PIN(pin, ...) constexpr Wire pin{static_cast<std::uint8_t>(Place::pin)};
#define DSDPV1_BUS(...)
#define DSDPV1_RSU_PIN(...)
#include "model/dsdpv1/pins.inc"
constexpr Wire kA{static_cast<std::uint8_t>(Place::kA)}, kD{static_cast<std::uint8_t>(Place::kD)};

}  // namespace wire

const WireTable& wires();
inline const std::string& name_of(Wire wire) { return wires()[static_cast<std::size_t>(wire)].name; }
/// CSR, RD, WR, all of A and D.
const std::vector<Wire>& host_port();

inline std::uint32_t address_at(const Record& record, Tick at) { return record.number(wire::kA, kAddressWires, at); }
inline std::uint32_t data_at(const Record& record, Tick at) { return record.number(wire::kD, kDataWires, at); }

}  // namespace dsdpv1::calibrate
