#pragma once
// A user program's answers to acyclic requests (DPV1), for any chip.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus/time.hpp"

namespace dsdpv1::user_cpu {

using bus::Tick;

// Bits of AcyclicObject::services and ::classes.
constexpr std::uint8_t kMayRead = 0x01, kMayWrite = 0x02, kMayTransport = 0x04;
constexpr std::uint8_t kClass1 = 0x01, kClass2 = 0x02, kBothClasses = 0x03;
/// Error_Code_1: "invalid parameter" of class "access".
constexpr std::uint8_t kInvalidParameter = 0xB8;

/// One object. A read returns its bytes, a write replaces its first bytes, a transport writes and returns the previous
/// bytes.
struct AcyclicObject {
  std::uint8_t slot = 0, index = 0;
  std::uint8_t services = kMayRead | kMayWrite;
  std::uint8_t classes = kBothClasses;  ///< of masters with access
  std::uint8_t min_length = 0;          ///< 0..240
  std::vector<std::uint8_t> data;       ///< 0..240 bytes, its size is the largest length
};

/// Identification data (I&M0) that a scenario may set.
struct Nameplate {
  std::uint16_t manufacturer_id = 0, hardware_revision = 1, profile_id = 0xF600;
  std::string order_id, serial_number;  ///< at most 20 and 16 characters
  std::vector<std::uint8_t> software_revision = {1, 0, 0};
};

enum class Answering : std::uint8_t { kNormal, kRefuse, kNever };

struct AcyclicOptions {
  std::vector<AcyclicObject> objects;
  std::optional<Nameplate> im0;
  Answering answering = Answering::kNormal;
  Tick delay = 0;  ///< from the poll that fetched a request to its answer
  std::uint8_t error_code_1 = kInvalidParameter, error_code_2 = 0;  ///< of Answering::kRefuse

  bool any() const { return !objects.empty() || im0.has_value(); }
};

}  // namespace dsdpv1::user_cpu
