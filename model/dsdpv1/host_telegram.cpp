#include "model/dsdpv1/host_telegram.hpp"

#include <algorithm>

#include "model/dsdpv1/reasons.hpp"

namespace dsdpv1 {
namespace {

constexpr int kCrcBytes = 2;

const ExchangeArea* area_at(std::uint16_t address) {
  const auto* found = std::find_if(kExchangeAreas.begin(), kExchangeAreas.end(),
                                   [address](const ExchangeArea& area) { return area.address == address; });
  return found == kExchangeAreas.end() ? nullptr : found;
}

}  // namespace

// --- bytes -----------------------------------------------------------------------------------------------------------

bool HostTelegram::add(std::uint8_t byte) {
  const int index = count_++;
  if (index == 0) begin(byte);
  if (bytes_ == 0 || index < bytes_ - kCrcBytes)
    crc_ = dpram::crc16_with(crc_, byte);
  else
    request_.crc = static_cast<std::uint16_t>(request_.crc << 8 | byte);
  if (index > 0 && index < header())
    take_header(index, byte);
  else if (const int place = index - header() + (rules_.names_area || request_.command != Command::kExchange ? 0 : 1);
           index > 0 && place < kMostData)
    data_.at(static_cast<std::size_t>(place)) = byte;
  if (count_ != bytes_) return false;
  request_.computed = crc_;
  return true;
}

void HostTelegram::begin(std::uint8_t byte) {
  start_ = byte;
  request_ = {};
  request_.command = static_cast<Command>(byte >> 5 & 3);
  bytes_ = request_.command == Command::kRead ? header() + kCrcBytes : 0;
  if (!rules_.names_area && request_.command == Command::kExchange) request_.address = regs::kInput;
}

/// Bytes up to the length byte.
int HostTelegram::header() const {
  if (request_.command != Command::kExchange) return 4;
  return rules_.names_area ? 5 : 2;
}

void HostTelegram::take_header(int index, std::uint8_t byte) {
  if (index == header() - 1) return take_length(byte);
  if (is_of_area(request_) && index == 1)
    request_.function = byte;
  else
    request_.address = static_cast<std::uint16_t>(request_.address << 8 | byte);
}

void HostTelegram::take_length(std::uint8_t length) {
  request_.length = length;
  request_.bytes = header() + kCrcBytes + (request_.command == Command::kRead ? 0 : length);
  bytes_ = request_.bytes;
  if (!rules_.names_area && request_.command == Command::kExchange) data_[0] = length;
}

// --- judgement -------------------------------------------------------------------------------------------------------

std::uint8_t HostTelegram::judge(const Request& request, profibus::Cycle now, profibus::EventLog& log) const {
  std::uint8_t code = judge_address(request, now, log);
  code |= judge_data(request, now, log);
  const int most = request.command == Command::kExchange ? rules_.most_exchange : rules_.most;
  if (request.bytes <= most) return code;
  log.at_cycle(now, Reason::kTelegramLength, static_cast<unsigned>(request.bytes), static_cast<unsigned>(most));
  return code | kLengthWrong;
}

std::uint8_t HostTelegram::judge_address(const Request& request, profibus::Cycle now, profibus::EventLog& log) const {
  unsigned why = 0;
  if (is_of_area(request)) {
    const bool none = area_at(request.address) == nullptr;
    if (!none && (request.address != regs::kDiag || (request.function & kWithDiagnosis) != 0)) return 0;
    why = none ? 1 : 2;
  } else if (request.address < 0x800) {
    return 0;
  }
  log.at_cycle(now, Reason::kTelegramAddress, request.address, why);
  return kAddressWrong;
}

std::uint8_t HostTelegram::judge_data(const Request& request, profibus::Cycle now, profibus::EventLog& log) const {
  const int most = most_data(request);
  if (request.length > 0 && request.length <= most) return 0;
  // SPI's read and write may be without inputs
  if (request.length == 0 && !rules_.names_area && request.command == Command::kExchange) return 0;
  log.at_cycle(now, Reason::kTelegramData, static_cast<unsigned>(request.length), static_cast<unsigned>(most),
               request.address);
  return kDataWrong;
}

int HostTelegram::most_data(const Request& request) const {
  if (is_of_area(request)) {
    const ExchangeArea* area = area_at(request.address);
    return area == nullptr ? rules_.most_write : area->most;
  }
  if (request.command == Command::kExchange) return kMostReadAndWrite;
  const int most = request.command == Command::kRead ? kMostRead : rules_.most_write;
  return std::min(most, regs::kDpramSize - request.base());
}

}  // namespace dsdpv1
