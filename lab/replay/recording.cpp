#include "lab/replay/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "bus/baud.hpp"
#include "io/input/input_error.hpp"
#include "io/input/suggest.hpp"

namespace dsdpv1::tb::replay {
namespace {

/// The unit of 1 ns, 10 ns ... 1 ms that divides all starts; a tick if none does.
Tick resolution_of(const std::vector<RecordedTelegram>& telegrams) {
  constexpr std::array<Tick, 7> kUnits = {bus::kTicksPerMs, bus::kTicksPerMs / 10, bus::kTicksPerMs / 100,
                                          bus::kTicksPerUs, bus::kTicksPerUs / 10, bus::kTicksPerUs / 100,
                                          bus::kTicksPerNs};
  for (const Tick unit : kUnits)
    if (std::all_of(telegrams.begin(), telegrams.end(),
                    [unit](const RecordedTelegram& telegram) { return telegram.start % unit == 0; }))
      return unit;
  return 1;
}

}  // namespace

std::vector<int> Recording::bauds() const {
  std::vector<int> rates;
  for (const RecordedTelegram& each : telegrams)
    if (std::find(rates.begin(), rates.end(), each.baud) == rates.end()) rates.push_back(each.baud);
  return rates;
}

Recorder::Recorder(std::string name, std::uint8_t slave, std::optional<int> baud) : baud_(baud), address_(slave) {
  recording_.name = std::move(name);
  recording_.slave = slave;
}

void Recorder::telegram(const bus::capture::CapturedTelegram& telegram) {
  if (telegram.bytes.empty()) return;
  if (!telegram.baud && !baud_ && recording_.telegrams.empty())
    throw InputError(recording_.name, 0, "does not say its baud rate, name it with --baud, expected 12M to 9.6k");
  const int before = recording_.telegrams.empty() ? 0 : recording_.telegrams.back().baud;
  const int baud = telegram.baud.value_or(baud_.value_or(before));
  if (!baud_ || baud == *baud_) return take(telegram, baud);
  ++recording_.left_out;
}

void Recorder::take(const bus::capture::CapturedTelegram& telegram, int baud) {
  RecordedTelegram recorded;
  recorded.start = telegram.start;
  const Tick nominal = static_cast<Tick>(telegram.bytes.size()) * bus::kCharacterBits * bus::baud(baud).bit;
  recorded.end = telegram.end > telegram.start ? telegram.end : telegram.start + nominal;
  recorded.damage = telegram.damage;
  recorded.baud = baud;
  recorded.bytes = telegram.bytes;
  recorded.decoded = bus::decode(telegram.bytes);
  auto& all = recording_.telegrams;
  if (!all.empty() && recorded.start < all.back().start)
    throw InputError(
        recording_.name, 0,
        fmt::format("telegram {} is before the one that it follows, expected the order of time", all.size() + 1));
  all.push_back(std::move(recorded));
}

Recording Recorder::finish() {
  if (!recording_.telegrams.empty()) recording_.baud = recording_.telegrams.front().baud;
  divide();
  check();
  follow_rate();
  // In a recording of levels a telegram begins with an edge, at an unknown sampling rate.
  if (recording_.levels.empty()) recording_.resolution = resolution_of(recording_.telegrams);
  return std::move(recording_);
}

// --- senders of telegrams
// ---------------------------------------------------------------------------------------------------

void Recorder::divide() {
  for (std::size_t i = 0; i < recording_.telegrams.size(); ++i) divide(i);
}

void Recorder::divide(std::size_t index) {
  if (recording_.telegrams[index].right())
    right(index);
  else
    wrong(index);
}

void Recorder::right(std::size_t index) {
  RecordedTelegram& recorded = recording_.telegrams[index];
  const bus::Telegram& telegram = recorded.decoded.telegram;
  if (telegram.is_response()) {
    const bool awaited = pending_ && pending_->of_slave;
    recorded.of_slave = telegram.kind == bus::TelegramKind::kSc ? awaited : telegram.sa == address_;
    if (recorded.of_slave && awaited) answered(index);
    return pending_.reset();
  }
  pending_.reset();
  if (!telegram.is_request() || !telegram.wants_answer()) return;
  pending_ = Pending{index, telegram.da, telegram.da == address_};
  if (pending_->of_slave) recording_.requests.push_back({index, {}});
}

/// A damaged telegram within the slot time after a request to the slave is the slave's.
void Recorder::wrong(std::size_t index) {
  if (!pending_) return;
  RecordedTelegram& recorded = recording_.telegrams[index];
  const RecordedTelegram& request = recording_.telegrams[pending_->request];
  const bus::Baud& rate = bus::baud(request.baud);
  const Tick waited = recorded.start - request.end;
  recorded.of_slave = pending_->of_slave && waited < rate.slot_bits * rate.bit;
  if (recorded.of_slave) answered(index);
  pending_.reset();
}

void Recorder::answered(std::size_t index) {
  recording_.requests.back().answer = index;
  follow_address(recording_.telegrams[index]);
}

void Recorder::follow_address(const RecordedTelegram& answer) {
  const bus::Telegram& request = recording_.telegrams[pending_->request].decoded.telegram;
  const bool accepted = answer.right() && answer.decoded.telegram.kind == bus::TelegramKind::kSc;
  if (accepted && request.dsap == bus::sap::kSetSlaveAddress && !request.data.empty())
    address_ = request.data[0] & 0x7FU;
}

void Recorder::follow_rate() {
  int known = recording_.baud;
  for (RecordedRequest& each : recording_.requests) {
    const int baud = recording_.request(each).baud;
    each.searching = baud != known && !each.answer;
    each.found = baud != known && each.answer;
    if (each.answer) known = baud;
  }
}

// --- whether it can be used
// -------------------------------------------------------------------------------------------

void Recorder::check() const {
  const auto fail = [this](const std::string& what) { throw InputError(recording_.name, 0, what); };
  if (recording_.telegrams.empty())
    fail(recording_.left_out != 0 ? "holds no telegram at the rate of --baud"
                                  : "holds no telegram, expected a capture of the line");
  if (recording_.requests.empty())
    fail(fmt::format("no request to station {} (--as), {}", recording_.slave, stations()));
  const bool answers = std::any_of(recording_.requests.begin(), recording_.requests.end(),
                                   [](const RecordedRequest& request) { return request.answer.has_value(); });
  if (!answers) fail(fmt::format("station {} (--as) never answers, {}", recording_.slave, stations()));
}

std::string Recorder::stations() const {
  std::set<std::uint8_t> answering;
  const RecordedTelegram* before = nullptr;
  for (const RecordedTelegram& each : recording_.telegrams) {
    if (each.right() && each.decoded.telegram.is_response() && before != nullptr)
      answering.insert(before->decoded.telegram.da);
    before = each.right() && each.decoded.telegram.is_request() ? &each : nullptr;
  }
  std::vector<std::string> words;
  words.reserve(answering.size());
  for (const std::uint8_t station : answering) words.push_back(std::to_string(station));
  if (words.empty()) return "and nobody else answers, expected a capture with a slave that does";
  return "expected the stations that answer: " + join(words);
}

}  // namespace dsdpv1::tb::replay
