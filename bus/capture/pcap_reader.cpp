// pcap: a header, then packets.
#include "bus/capture/pcap_reader.hpp"

#include <fmt/format.h>

#include "bus/capture/byte_reader.hpp"
#include "bus/capture/link_type.hpp"
#include "bus/capture/packet_time.hpp"

namespace dsdpv1::bus::capture {
namespace {

constexpr std::uint64_t kMicroseconds = 0xA1B2C3D4, kNanoseconds = 0xA1B23C4D;
constexpr std::size_t kHeader = 24, kPacketHeader = 16;
constexpr std::uint64_t kLongestPacket = 262'144;  // as in libpcap

bool is_magic(std::uint64_t magic) { return magic == kMicroseconds || magic == kNanoseconds; }

struct Form {
  bool big_endian = false;
  std::uint64_t per_second = 1'000'000;
};

Form read_header(ByteReader& in) {
  std::string header;
  in.need(kHeader, header);
  const std::string_view view = header;
  Form form;
  form.big_endian = is_magic(number_in(view.substr(0, 4), true));
  if (number_in(view.substr(0, 4), form.big_endian) == kNanoseconds) form.per_second = 1'000'000'000;
  const auto link = static_cast<std::uint32_t>(number_in(view.substr(20, 4), form.big_endian) & 0x0FFFFFFFU);
  check_link(link);
  return form;
}

}  // namespace

bool begins_as_pcap(std::string_view beginning) {
  const std::string_view magic = beginning.substr(0, 4);
  return magic.size() == 4 && (is_magic(number_in(magic, true)) || is_magic(number_in(magic, false)));
}

void read_pcap(std::istream& in, const TakeTelegram& take) {
  ByteReader file(in);
  const Form form = read_header(file);
  PacketClock clock;
  std::string header, bytes;
  while (file.read(kPacketHeader, header)) {
    const auto field = [&](std::size_t at) {
      return number_in(std::string_view(header).substr(at, 4), form.big_endian);
    };
    const std::uint64_t size = field(8);
    if (size > kLongestPacket)
      throw CaptureError(
          fmt::format("a packet of {} bytes before byte {}, expected up to {}", size, file.at(), kLongestPacket));
    file.need(size, bytes);
    CapturedTelegram telegram;
    telegram.start = telegram.end = clock.at(field(0) * form.per_second + field(4), form.per_second);
    telegram.bytes.assign(bytes.begin(), bytes.end());
    take(telegram);
  }
}

}  // namespace dsdpv1::bus::capture
