#pragma once
// The errors of an answer (tables 4.10 to 4.14): class and code. Table 4.10 refers to table 4.11 twice; class 2
// is 4.12.
#include <cstdint>

namespace dsdpv1::xgate {

struct Error {
  std::uint8_t type = 0, code = 0;

  explicit operator bool() const { return type != 0; }
  friend bool operator==(const Error& a, const Error& b) { return a.type == b.type && a.code == b.code; }
  template <class Archive>
  void store(Archive& archive) {
    auto& [is, number] = *this;
    archive(is, number);
  }
};

namespace error {
constexpr Error kNone{};
constexpr Error kInitXor{1, 1}, kAddress{1, 2}, kIoLength{1, 3}, kConfiguration{1, 4};
constexpr Error kOverflow{2, 1}, kTooFew{2, 2}, kXor{2, 4};
constexpr Error kParametersDiffer{3, 1}, kConfigurationDiffers{3, 2}, kExchange{3, 3}, kNotConnected{3, 4};
constexpr Error kCommand{4, 1}, kParameter{4, 2}, kResource{4, 3}, kTime{4, 5}, kRate{4, 6};
}  // namespace error

}  // namespace dsdpv1::xgate
