#include "kinds/dsdpv1/port/uart_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dsdpv1::tb {
namespace {

using dsdpv1::mask;
using dsdpv1::Pin;

constexpr unsigned kIntervalCell = 0x019;  // UA3
constexpr const char* kNotHeard = "not heard: the chip replies";

}  // namespace

UartReader::UartReader(const SerialSettings& settings) : settings_(settings) {
  from_user_.set_bit(settings.bit() * bus::kTicksPerCycle);
  from_chip_.set_bit(settings.bit() * bus::kTicksPerCycle);
  from_user_.on_character = [this](const bus::ReceivedCharacter& each) { heard_from_user(each); };
  from_chip_.on_character = [this](const bus::ReceivedCharacter& each) { heard_from_chip(each); };
}

PinMask UartReader::pins() const { return mask(Pin::kReset) | mask(Pin::kRxd) | mask(Pin::kTxd); }

void UartReader::pin(Tick at, PinNumber pin, Level level) {
  now_ = at;
  switch (static_cast<Pin>(pin)) {
    case Pin::kReset:
      if (level == 0) reset();
      break;
    case Pin::kRxd:
      silence(at - 1);
      from_user_.line_changed(at, level != 0);
      rxd_ = level != 0;
      if (rxd_ && !from_user_.receiving()) idle_since_ = std::max(idle_since_, at);
      break;
    case Pin::kTxd: from_chip_.line_changed(at, level != 0); break;
    default: return;
  }
  announce();
}

void UartReader::reset() {
  from_user_.reset(rxd_);
  from_chip_.reset(true);
  request_.clear();
  reply_.clear();
  spoilt_.clear();
  replying_ = false;
  reply_end_ = 0;
  b019_ = 0;
}

Tick UartReader::next() const { return std::min({from_user_.next(), from_chip_.next(), silence_at()}); }

void UartReader::run(Tick now) {
  now_ = now;
  from_user_.run(now);
  from_chip_.run(now);
  silence(now);
}

// --- requests --------------------------------------------------------------------------------------------------------

void UartReader::heard_from_user(const bus::ReceivedCharacter& character) {
  idle_since_ = character.end;
  if (spoilt_ == kNotHeard && heard(character)) end_request(request_end_, spoilt_);
  request_end_ = character.end;
  if (request_.empty()) begin_request(character);
  request_.add(character.byte);
  if (spoilt_.empty() && !character.ok())
    spoilt_ =
        fmt::format("{} in byte {}", character.stop_ok ? "wrong parity" : "no stop bit", request_.bytes().size() - 1);
  if (spoilt_.empty() && !request_.begins()) spoilt_ = "no telegram";
  if (spoilt_.empty() && request_.complete()) end_request(character.end, request_.wrong());
}

void UartReader::begin_request(const bus::ReceivedCharacter& character) {
  request_start_ = character.start;
  longest_silence_ = settings_.silence(b019_) * bus::kCharacterBits * settings_.bit() * bus::kTicksPerCycle / 2;
  if (!heard(character)) spoilt_ = kNotHeard;
}

/// UA16.
bool UartReader::heard(const bus::ReceivedCharacter& character) const {
  return !replying_ && character.start > reply_end_;
}

/// A request is replied to if at most its CRC is wrong.
void UartReader::end_request(Tick end, const std::string& wrong) {
  if (spoilt_.empty() && request_.complete()) {
    if (request_.right()) b019_ = request_.written(kIntervalCell).value_or(b019_);
    replying_ = settings_.is_own(request_.card());
    if (replying_) asked_ = request_;
  }
  const HostTelegram telegram{request_start_, end, false, request_.words(), request_.bytes(), wrong};
  request_.clear();
  spoilt_.clear();
  tell(telegram);
}

/// UA3: a longer silence within a telegram drops it. In a break none is counted.
Tick UartReader::silence_at() const {
  if (request_.empty() || from_user_.receiving() || !rxd_) return bus::kNever;
  return idle_since_ + longest_silence_ + bus::kTicksPerCycle + 1;
}

void UartReader::silence(Tick now) {
  if (silence_at() > now) return;
  const std::string why = spoilt_.empty() ? fmt::format("cut after {} bytes", request_.bytes().size()) : spoilt_;
  end_request(idle_since_, why);
}

// --- replies ---------------------------------------------------------------------------------------------------------

void UartReader::heard_from_chip(const bus::ReceivedCharacter& character) {
  if (reply_.empty()) reply_start_ = character.start;
  reply_.add(character.byte);
  if (!replying_) return end_reply(character.end, "nobody has asked");
  if (!character.ok()) return end_reply(character.end, "wrong character");
  if (reply_.complete(asked_)) end_reply(character.end, reply_.wrong());
}

void UartReader::end_reply(Tick end, const std::string& wrong) {
  const HostTelegram telegram{reply_start_,   end,  true, replying_ ? reply_.words(asked_) : "reply",
                              reply_.bytes(), wrong};
  reply_.clear();
  replying_ = false;
  reply_end_ = end;
  tell(telegram);
}

}  // namespace dsdpv1::tb
