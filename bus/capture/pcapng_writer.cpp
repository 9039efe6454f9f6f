#include "bus/capture/pcapng_writer.hpp"

#include <fmt/format.h>

#include <utility>

#include "bus/capture/pcapng_format.hpp"

namespace dsdpv1::bus::capture {
namespace {

/// The body of a block, and its frame.
class Block {
 public:
  explicit Block(std::uint32_t type) : type_(type) {}

  Block& u8(std::uint8_t value) {
    body_ += static_cast<char>(value);
    return *this;
  }
  Block& u16(std::uint32_t value) {
    return u8(static_cast<std::uint8_t>(value)).u8(static_cast<std::uint8_t>(value >> 8U));
  }
  Block& u32(std::uint32_t value) { return u16(value).u16(value >> 16U); }
  Block& u64(std::uint64_t value) {
    return u32(static_cast<std::uint32_t>(value)).u32(static_cast<std::uint32_t>(value >> 32U));
  }
  Block& bytes(std::string_view bytes) {
    body_ += bytes;
    return pad();
  }
  Block& option(std::uint16_t code, std::string_view value) {
    return u16(code).u16(static_cast<std::uint32_t>(value.size())).bytes(value);
  }
  Block& option_u32(std::uint16_t code, std::uint32_t value) { return u16(code).u16(4).u32(value); }
  Block& end_options() { return u32(pcapng::option::kEnd); }

  std::string text() const {
    const auto length = static_cast<std::uint32_t>(body_.size()) + pcapng::kBlockFrame;
    Block front(0);
    front.u32(type_).u32(length);
    return front.body_ + body_ + Block(0).u32(length).body_;
  }

 private:
  Block& pad() {
    body_.resize((body_.size() + 3) / 4 * 4);
    return *this;
  }

  std::uint32_t type_;
  std::string body_;
};

std::uint64_t nanoseconds(Tick tick) { return static_cast<std::uint64_t>((tick + kTicksPerNs / 2) / kTicksPerNs); }

Tick end_of_characters(const CapturedTelegram& telegram) {
  const auto count = static_cast<Tick>(telegram.bytes.size());
  return telegram.start + count * kCharacterBits * bus::baud(telegram.baud.value_or(0)).bit;
}

}  // namespace

PcapngWriter::PcapngWriter(const PcapngHeader& header, WriteBytes write)
    : link_(header.link), write_(std::move(write)) {
  constexpr std::uint64_t kUnknownLength = ~0ULL;
  Block section(pcapng::kSection);
  section.u32(pcapng::kByteOrder).u16(1).u16(0).u64(kUnknownLength);
  write_(section.option(pcapng::option::kApplication, header.application).end_options().text());
  interface_of(header.baud);
}

std::uint32_t PcapngWriter::interface_of(int baud) {
  std::optional<std::uint32_t>& number = interfaces_.at(static_cast<std::size_t>(baud));
  if (number) return *number;
  const auto speed = static_cast<std::uint64_t>((kTicksPerSecond + bus::baud(baud).bit / 2) / bus::baud(baud).bit);
  Block block(pcapng::kInterface);
  block.u16(link_).u16(0).u32(0);  // no limit for packet lengths
  block.option(pcapng::option::kName, "profibus");
  block.option(pcapng::option::kDescription, fmt::format("PROFIBUS DP at {}, {} bit/s", bus::baud(baud).name, speed));
  block.u16(pcapng::option::kSpeed).u16(8).u64(speed);
  block.option(pcapng::option::kResolution, std::string(1, '\x09'));
  write_(block.end_options().text());
  number = interface_count_++;
  return *number;
}

void PcapngWriter::telegram(const CapturedTelegram& telegram) {
  const std::uint32_t interface = interface_of(telegram.baud.value_or(0));
  const std::uint64_t time = nanoseconds(telegram.start);
  const auto size = static_cast<std::uint32_t>(telegram.bytes.size());
  Block block(pcapng::kPacket);
  block.u32(interface).u32(static_cast<std::uint32_t>(time >> 32U)).u32(static_cast<std::uint32_t>(time));
  block.u32(size).u32(size).bytes({reinterpret_cast<const char*>(telegram.bytes.data()), telegram.bytes.size()});
  if (telegram.damage != 0) block.option_u32(pcapng::option::kFlags, telegram.damage);
  if (telegram.end != end_of_characters(telegram))
    block.option(pcapng::option::kComment, fmt::format("ends at {} ns", nanoseconds(telegram.end)));
  for (const std::string& remark : telegram.remarks) block.option(pcapng::option::kComment, remark);
  write_(block.end_options().text());
}

}  // namespace dsdpv1::bus::capture
