#include "tests/driver/fake_rsu.hpp"

#include <algorithm>
#include <utility>

namespace dsdpv1 {
namespace {

using Bytes = FakeRsu::Bytes;

constexpr std::uint8_t kAddress = 1;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value & 0xFF); }

Bytes sealed(Bytes bytes) {
  const std::uint16_t crc = dsdpv1_crc(DSDPV1_CRC_START, bytes.data(), bytes.size());
  bytes.push_back(low(crc >> 8));
  bytes.push_back(low(crc));
  return bytes;
}

bool crc_is_right(const Bytes& request) { return sealed({request.begin(), request.end() - 2}) == request; }

Bytes refused(std::uint8_t code) { return sealed({0xE0 | kAddress, code}); }

/// The length of the telegram, from its first bytes; 0 if they do not tell it, or do not begin a telegram.
std::size_t length_of(FakePort port, const std::uint8_t* bytes, std::size_t n) {
  const int command = n > 0 ? bytes[0] >> 5 : -1;
  if (command == 0) return 6;
  if (command == 1) return n > 3 ? 6U + bytes[3] : 0;
  if (command == 2 && port == FakePort::kSpi) return n > 1 ? 4U + bytes[1] : 0;
  if (command == 2) return n > 4 ? 7U + bytes[4] : 0;
  return 0;
}

FakeRsu& rsu_of(void* ctx) { return *static_cast<FakeRsu*>(ctx); }

bool take_one(int& count) { return count > 0 && count-- > 0; }

}  // namespace

dsdpv1_error FakeRsu::open(FakePort kind, dsdpv1_device& device, const dsdpv1_judge& judge) {
  chip_.looks_at_crcs = kind == FakePort::kParallel;
  if (kind == FakePort::kParallel) {
    const dsdpv1_port port = chip_.port();
    return dsdpv1_open(&device, &port, &judge);
  }
  spi.ctx = uart.ctx = this;
  spi.address = uart.address = kAddress;
  spi.exchange = [](void* ctx, const std::uint8_t* out, std::uint8_t* in, std::uint16_t n) {
    return rsu_of(ctx).frame(out, in, n);
  };
  uart.baud = 9600;
  uart.send = [](void* ctx, const std::uint8_t* out, std::uint16_t n) {
    FakeRsu& rsu = rsu_of(ctx);
    if (take_one(rsu.failing_calls)) return false;
    for (std::uint16_t i = 0; i < n; ++i) rsu.uart_character(out[i]);
    return true;
  };
  uart.receive = [](void* ctx, std::uint8_t* to, std::uint16_t n, std::uint32_t timeout_us) {
    return rsu_of(ctx).receive(to, n, timeout_us);
  };
  spi.pause = uart.pause = [](void* ctx, std::uint32_t) { ++rsu_of(ctx).chip_.pauses; };
  return kind == FakePort::kSpi ? dsdpv1_open_spi(&device, &spi, &judge) : dsdpv1_open_uart(&device, &uart, &judge);
}

// --------------------------------------------------------------------------------------------------------------- lines

bool FakeRsu::frame(const std::uint8_t* out, std::uint8_t* in, std::uint16_t n) {
  if (take_one(failing_calls)) return false;
  select();
  for (std::uint16_t i = 0; i < n; ++i) in[i] = spi_byte(out[i]);
  return true;
}

std::uint8_t FakeRsu::spi_byte(std::uint8_t out) {
  ++bytes;
  frame_.push_back(out);
  const std::size_t length = length_of(FakePort::kSpi, frame_.data(), frame_.size());
  if (length > 0 && frame_.size() == length) reply_ = answer(FakePort::kSpi, frame_);
  const std::size_t begin = length + static_cast<std::size_t>(reply_gap), slot = frame_.size() - 1;
  return length > 0 && slot >= begin && slot - begin < reply_.size() ? reply_[slot - begin] : 0xFF;
}

void FakeRsu::uart_character(std::uint8_t character) {
  ++bytes;
  if (!line_.empty()) chip_.violations.emplace_back("a character while the chip sends");
  telegram_.push_back(character);
  const std::size_t length = length_of(FakePort::kUart, telegram_.data(), telegram_.size());
  if (length == 0 || telegram_.size() < length) return;
  const Bytes reply = answer(FakePort::kUart, std::exchange(telegram_, {}));
  bytes += reply.size();
  line_.assign(reply.begin(), reply.end());
  chip_.let_in();
}

bool FakeRsu::next_character(std::uint8_t& character) {
  if (line_.empty()) return false;
  character = line_.front();
  line_.pop_front();
  return true;
}

std::uint16_t FakeRsu::receive(std::uint8_t* to, std::uint16_t n, std::uint32_t timeout_us) {
  longest_timeout_us = std::max(longest_timeout_us, timeout_us);
  std::uint16_t count = 0;
  while (count < n && next_character(to[count])) ++count;
  if (count == 0) ++silences;
  return count;
}

// ----------------------------------------------------------------------------------------------------------- telegrams

Bytes FakeRsu::answer(FakePort port, Bytes request) {
  if (before_telegram) before_telegram(request);
  if (!chip_.present || take_one(deaf)) return {};
  if (take_one(spoilt_requests)) request.back() = low(request.back() ^ 0x10U);
  requests.push_back(request);
  Bytes reply;
  if (crc_is_right(request))
    reply = carry_out(port, request);
  else
    reply = port == FakePort::kUart && request[0] >> 5 == 2 ? sealed({kAddress, 0x81, 0x01}) : refused(0x01);
  if (take_one(spoilt_replies)) reply[reply.size() / 2] = low(reply[reply.size() / 2] ^ 0x04U);
  replies.push_back(reply);
  return reply;
}

Bytes FakeRsu::carry_out(FakePort port, const Bytes& request) {
  if ((request[0] & 0x1F) != kAddress) return {};
  const int command = request[0] >> 5;
  if (command == 2 && port == FakePort::kSpi) return read_and_write({request.begin() + 1, request.end() - 2});
  if (command == 2) return exchange(request);
  const auto address = static_cast<std::uint16_t>(request[1] << 8 | request[2]);
  const std::size_t length = request[3];
  const std::size_t most = command == 0 || port == FakePort::kSpi ? 245 : 250;
  const int code = (address > 0x7FF ? 2 : 0) | (length == 0 || length > most || address + length > 0x800 ? 4 : 0);
  if (code != 0) return refused(low(static_cast<std::size_t>(code)));
  if (port == FakePort::kSpi && address != 0x014) claim(command == 0 ? "read" : "write");
  return command == 0 ? read(address, length) : write(port, address, {request.begin() + 4, request.end() - 2});
}

void FakeRsu::claim(const char* what) {
  ++chip_.accesses;
  if (ownership_ == 0) chip_.violations.push_back(std::string(what) + " without a claim");
}

Bytes FakeRsu::read(std::uint16_t address, std::size_t length) {
  Bytes reply{0x80 | kAddress, 0};
  for (std::size_t i = 0; i < length; ++i) {
    const auto cell = static_cast<std::uint16_t>(address + i);
    int& bad = chip_.bad_reads[cell];
    reply.push_back(low(take_one(bad) ? chip_.at(cell) ^ 0xFFU : chip_.at(cell)));
  }
  return sealed(reply);
}

Bytes FakeRsu::write(FakePort port, std::uint16_t address, const Bytes& data) {
  if (port == FakePort::kSpi && address == 0x014) {
    const bool claims = (data[0] & 2) != 0;
    if (claims && take_one(busy_claims)) return refused(0);
    if (claims && ownership_ == 0) ++chip_.holds;
    if (!claims && ownership_ != 0) chip_.let_in();
    ownership_ = data[0] & 2;
  } else {
    for (std::size_t i = 0; i < data.size(); ++i) chip_.user_writes(static_cast<std::uint16_t>(address + i), data[i]);
  }
  return sealed({0xA0 | kAddress, 0});
}

Bytes FakeRsu::read_and_write(const Bytes& data) {
  claim("read and write");
  std::copy(data.begin(), data.end(), chip_.memory.begin() + 0x130);
  chip_.at(0x010) |= 1;
  chip_.at(0x00E) &= 0xFE;
  Bytes reply{0xC0 | kAddress, 0};
  const Bytes outputs = chip_.bytes(0x319, std::min<std::size_t>(chip_.at(0x319), 244) + 1U);
  reply.insert(reply.end(), outputs.begin(), outputs.end());
  return sealed(reply);
}

Bytes FakeRsu::exchange(const Bytes& request) {
  const auto address = static_cast<std::uint16_t>(request[2] << 8 | request[3]);
  const std::map<std::uint16_t, std::array<int, 3>> areas = {
      {0x130, {0x010, 1, 245}}, {0x227, {0x010, 2, 240}}, {0x5D0, {0x011, 1, 244}}, {0x6D0, {0x011, 2, 244}}};
  const auto area = areas.find(address);
  const bool known = area != areas.end() && (address != 0x227 || (request[1] & 2) != 0);
  if (!known) return sealed({kAddress, 0x81, 0x02});
  if (request[4] == 0 || request[4] > area->second[2]) return sealed({kAddress, 0x81, 0x04});
  std::copy(request.begin() + 5, request.end() - 2, chip_.memory.begin() + address);
  chip_.at(static_cast<std::uint16_t>(area->second[0])) |= low(static_cast<std::size_t>(area->second[1]));
  return news(address == 0x130);
}

/// One area (UA10), its flag cleared with it (UA11).
Bytes FakeRsu::news(bool inputs) {
  struct Area {
    std::uint16_t command, address;
    std::uint8_t bit, function;
  };
  const std::array<Area, 5> areas{{{0x00E, 0x410, 2, 0x10},
                                   {0x00E, 0x500, 4, 0x20},
                                   {0x00F, 0x5D0, 1, 0x04},
                                   {0x00F, 0x6D0, 2, 0x08},
                                   {0x00E, 0x319, 1, 0}}};
  std::size_t i = inputs ? 0 : 4;
  while (i < 4 && (chip_.at(areas[i].command) & areas[i].bit) == 0) ++i;
  const Area& area = areas[i];
  if (inputs) chip_.at(area.command) = low(static_cast<std::size_t>(chip_.at(area.command) & ~area.bit));
  const auto length_at = [&](int offset) {
    return static_cast<std::size_t>(chip_.at(static_cast<std::uint16_t>(area.address + offset)));
  };
  const bool carries = chip_.at(area.address) == 0x5F || chip_.at(area.address) == 0x51;
  std::size_t count = length_at(0) + 1;
  if (area.address == 0x500) count = length_at(2) + 3;
  if (area.address == 0x5D0 || area.address == 0x6D0) count = carries ? length_at(3) + 4 : 4;
  Bytes reply{kAddress, low(area.function | (data_exchange ? 1U : 0U)), low(area.address >> 8), low(area.address),
              low(count)};
  const Bytes data = chip_.bytes(area.address, count);
  reply.insert(reply.end(), data.begin(), data.end());
  return sealed(reply);
}

}  // namespace dsdpv1
