#pragma once
// A request to this station, and the answer to it, as FDL and the DP services exchange them.
#include <array>
#include <cstdint>

namespace dsdpv1::profibus {

namespace fc {
constexpr std::uint8_t kRequest = 0x40, kFcb = 0x20, kFcv = 0x10, kCode = 0x0F;
// function codes of requests
constexpr std::uint8_t kSdaLow = 3, kSdnLow = 4, kSdaHigh = 5, kSdnHigh = 6, kMsrd = 7, kFdlStatus = 9, kSrdLow = 0xC,
                       kSrdHigh = 0xD, kIdentify = 0xE, kLsapStatus = 0xF;
// function codes of responses
constexpr std::uint8_t kOk = 0, kRr = 2, kRs = 3, kDl = 8, kDh = 0xA;
}  // namespace fc

constexpr int kNoSap = -1;
constexpr std::uint8_t kSapBit = 0x80, kAddressMask = 0x7F;  ///< of DA and SA
constexpr std::uint8_t kBroadcast = 127;

struct Request {
  std::uint8_t da = 0, sa = 0;  ///< without the SAP bit
  std::uint8_t code = 0;        ///< function code, 4 bits
  int dsap = kNoSap, ssap = kNoSap;
  const std::uint8_t* data = nullptr;  ///< after the SAP bytes
  int size = 0;

  bool srd() const { return code == fc::kSrdLow || code == fc::kSrdHigh; }
  bool sdn() const { return code == fc::kSdnLow || code == fc::kSdnHigh; }
};

/// A service's reply to a request; `kNothing` for SDN.
struct Reply {
  enum class Kind : std::uint8_t { kNothing, kShort, kSd1, kData } kind = Kind::kNothing;
  std::uint8_t code = 0;  ///< response function code
  const std::uint8_t* data = nullptr;
  int size = 0;

  static Reply nothing() { return {}; }
  static Reply sc() { return {Kind::kShort, 0, nullptr, 0}; }
  static Reply status(std::uint8_t code) { return {Kind::kSd1, code, nullptr, 0}; }
  static Reply with_data(std::uint8_t code, const std::uint8_t* data, int size) {
    return {Kind::kData, code, data, size};
  }
};

/// A telegram ready to be sent.
struct Frame {
  static constexpr int kMost = 256;
  std::array<std::uint8_t, kMost> bytes{};
  int size = 0;

  template <class Archive>
  void store(Archive& archive) {
    auto& [all, used] = *this;
    archive(all);
    archive.within(0, kMost, used);
  }
};

/// Puts a reply into a frame for the sender of `request` (rulings S20, S21). `address`: this station.
void build_frame(const Request& request, const Reply& reply, std::uint8_t address, Frame& frame);

}  // namespace dsdpv1::profibus
