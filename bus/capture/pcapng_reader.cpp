// pcapng: blocks, which include sections with their interfaces and packets.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bus/baud.hpp"
#include "bus/capture/byte_reader.hpp"
#include "bus/capture/link_type.hpp"
#include "bus/capture/packet_time.hpp"
#include "bus/capture/pcap_reader.hpp"
#include "bus/capture/pcapng_format.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr std::uint64_t kLongestBlock = 16U << 20U;
constexpr std::size_t kMostInterfaces = 1024, kMostRemarks = 64;

struct Interface {
  std::uint32_t link = 0;
  std::uint64_t per_second = 1'000'000;
  std::int64_t offset_s = 0;
  std::optional<int> baud;
};

/// The rate in the table for this many bit/s, allowing for rounding.
std::optional<int> baud_of(std::uint64_t speed) {
  for (int i = 0; i < kBaudCount; ++i) {
    const double exact = static_cast<double>(kTicksPerSecond) / static_cast<double>(bus::baud(i).bit);
    if (std::abs(static_cast<double>(speed) - exact) < exact / 1000) return i;
  }
  return std::nullopt;
}

/// if_tsresol: a negative power of 10, or of 2 with bit 7.
std::uint64_t units_per_second(std::uint8_t resolution) {
  const unsigned power = resolution & 0x7FU;
  const bool binary = (resolution & 0x80U) != 0;
  if (power > (binary ? 40U : 12U))
    throw CaptureError(fmt::format("time resolution 0x{:02X}, expected up to 10^-12 and 2^-40 seconds", resolution));
  std::uint64_t units = 1;
  for (unsigned i = 0; i < power; ++i) units *= binary ? 2 : 10;
  return units;
}

class Reader {
 public:
  Reader(std::istream& in, const TakeTelegram& take) : in_(in), take_(take) {}

  void read() {
    std::string front;
    while (in_.read(8, front)) {
      const std::string_view type = std::string_view(front).substr(0, 4);
      if (number_in(type, false) == pcapng::kSection)  // reads the same in both byte orders
        section(front);
      else
        block(static_cast<std::uint32_t>(number(type)), length_of(front));
    }
  }

 private:
  std::uint64_t number(std::string_view bytes) const { return number_in(bytes, big_endian_); }
  std::uint64_t field(std::size_t at, std::size_t size = 4) const {
    return number(std::string_view(body_).substr(at, size));
  }

  void section(const std::string& front) {
    std::string order;
    in_.need(4, order);
    big_endian_ = number_in(order, true) == pcapng::kByteOrder;
    if (!big_endian_ && number_in(order, false) != pcapng::kByteOrder)
      throw CaptureError("a section without its byte-order magic, expected a pcapng file");
    interfaces_.clear();
    const std::uint64_t length = length_of(front);
    if (length < pcapng::kBlockFrame + 16)
      throw CaptureError("a section header that is too short, expected a pcapng file");
    in_.need(length - pcapng::kBlockFrame, body_);  // the byte order is already read; the length follows again
  }

  std::uint64_t length_of(const std::string& front) const {
    const std::uint64_t length = number(std::string_view(front).substr(4, 4));
    if (length >= pcapng::kBlockFrame && length % 4 == 0 && length <= kLongestBlock) return length;
    throw CaptureError(fmt::format("a block of {} bytes before byte {}, expected multiples of 4 from {} to {}", length,
                                   in_.at(), pcapng::kBlockFrame, kLongestBlock));
  }

  void block(std::uint32_t type, std::uint64_t length) {
    in_.need(length - 8, body_);
    body_.resize(body_.size() - 4);  // without the repeated length
    switch (type) {
      case pcapng::kInterface: return interface();
      case pcapng::kPacket: return packet(static_cast<std::size_t>(least(20).field(0)));
      case pcapng::kOldPacket: return packet(static_cast<std::size_t>(least(20).field(0, 2)));
      case pcapng::kSimplePacket: return simple_packet();
      default: return;
    }
  }

  const Reader& least(std::size_t size) const {
    if (body_.size() >= size) return *this;
    throw CaptureError(fmt::format("a block that is too short before byte {}, expected a pcapng file", in_.at()));
  }

  void interface() {
    if (interfaces_.size() >= kMostInterfaces)
      throw CaptureError(fmt::format("more than {} interfaces, expected up to that", kMostInterfaces));
    Interface added;
    added.link = static_cast<std::uint32_t>(least(8).field(0, 2));
    for_options(8, [&](std::uint64_t code, std::string_view value) {
      if (code == pcapng::option::kResolution && value.size() == 1)
        added.per_second = units_per_second(static_cast<std::uint8_t>(value[0]));
      if (code == pcapng::option::kTimeOffset && value.size() == 8)
        added.offset_s = static_cast<std::int64_t>(number(value));
      if (code == pcapng::option::kSpeed && value.size() == 8) added.baud = baud_of(number(value));
    });
    interfaces_.push_back(added);
  }

  const Interface& interface_of(std::size_t number) const {
    if (number >= interfaces_.size())
      throw CaptureError(
          fmt::format("a packet of interface {} before byte {}, there are {}", number, in_.at(), interfaces_.size()));
    check_link(interfaces_[number].link);
    return interfaces_[number];
  }

  void packet(std::size_t number) {
    const Interface& interface = interface_of(number);
    const std::uint64_t size = field(12), padded = (size + 3) / 4 * 4;
    least(20 + padded);
    CapturedTelegram telegram;
    telegram.start = telegram.end = clock_.at(field(4) << 32U | field(8), interface.per_second, interface.offset_s);
    set_bytes(telegram, interface, 20, size);
    for_options(20 + padded, [&](std::uint64_t code, std::string_view value) {
      if (code == pcapng::option::kFlags && value.size() == 4)
        telegram.damage = static_cast<std::uint32_t>(this->number(value)) & damage::kAll;
      if (code == pcapng::option::kComment && telegram.remarks.size() < kMostRemarks)
        telegram.remarks.emplace_back(value);
    });
    take_(telegram);
  }

  /// Has no time.
  void simple_packet() {
    const Interface& interface = interface_of(0);
    CapturedTelegram telegram;
    set_bytes(telegram, interface, 4, std::min<std::uint64_t>(least(4).field(0), body_.size() - 4));
    take_(telegram);
  }

  void set_bytes(CapturedTelegram& telegram, const Interface& interface, std::size_t at, std::uint64_t size) const {
    const auto first = body_.begin() + static_cast<std::ptrdiff_t>(at);
    telegram.bytes.assign(first, first + static_cast<std::ptrdiff_t>(size));
    telegram.baud = interface.baud;
    if (interface.baud) telegram.end += static_cast<Tick>(size) * kCharacterBits * bus::baud(*interface.baud).bit;
  }

  template <class Take>
  void for_options(std::size_t at, const Take& take) const {
    while (at + 4 <= body_.size()) {
      const std::uint64_t code = field(at, 2), size = field(at + 2, 2);
      if (code == pcapng::option::kEnd || at + 4 + size > body_.size()) return;
      take(code, std::string_view(body_).substr(at + 4, size));
      at += 4 + (size + 3) / 4 * 4;
    }
  }

  ByteReader in_;
  const TakeTelegram& take_;
  PacketClock clock_;
  bool big_endian_ = false;
  std::vector<Interface> interfaces_;
  std::string body_;
};

}  // namespace

bool begins_as_pcapng(std::string_view beginning) {
  return beginning.size() >= 4 && number_in(beginning.substr(0, 4), false) == pcapng::kSection;
}

void read_pcapng(std::istream& in, const TakeTelegram& take) { Reader(in, take).read(); }

}  // namespace dsdpv1::bus::capture
