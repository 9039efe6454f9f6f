#include "bus/master/requester.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dsdpv1::bus {

bool Exchange::answered() const {
  return decoded.error == DecodeError::kNone &&
         std::all_of(
             characters.begin(), characters.end(), [](const ReceivedCharacter& c) { return c.ok(); });
}

Requester::Requester(Segment& segment, const std::string& name)
    : segment_(segment), station_(segment.attach(name, this)), sender_(segment, station_) {
  receiver_.on_character = [this](const ReceivedCharacter& received) { character(received); };
  set_baud(0);
}

void Requester::set_baud(int index, std::int64_t ppm) {
  baud_ = index;
  bit_ = baud(index).bit;
  sender_.set_timing(bit_, ppm);
  receiver_.set_bit(bit_);
  receiver_.reset(segment_.level_at(station_));
  announce();
}

Exchange Requester::send(Timeline& timeline, const Bytes& bytes, const ExchangeOptions& options) {
  return send(timeline, bus::characters(bytes, options.faults), options);
}

Exchange Requester::send(Timeline& timeline, const Telegram& telegram, const ExchangeOptions& options) {
  return send(timeline, encode(telegram), options);
}

Exchange Requester::send(Timeline& timeline, const std::vector<Character>& characters, const ExchangeOptions& options) {
  exchange_ = {};
  exchange_.bit = bit_;
  exchange_.request_start = start_time(timeline, options);
  sender_.send(exchange_.request_start, characters);
  announce();
  send_all(timeline);
  if (options.wants_answer) await_answer(timeline, options);
  return std::move(exchange_);
}

Tick Requester::start_time(const Timeline& timeline, const ExchangeOptions& options) const {
  if (!options.at) return std::max(timeline.now(), last_activity_ + options.idle_bits * bit_);
  if (*options.at < timeline.now()) throw std::invalid_argument("a request cannot be sent in the past");
  return *options.at;
}

void Requester::send_all(Timeline& timeline) {
  exchange_.request_end = sender_.end();
  timeline.run_until(sender_.end());
  last_activity_ = sender_.end();
  receiver_.reset(segment_.level_at(station_));
  announce();
}

void Requester::await_answer(Timeline& timeline, const ExchangeOptions& options) {
  listening_ = true;
  decided_ = false;
  decoder_ = {};
  const Tick slot = options.slot_bits.value_or(baud(baud_).slot_bits) * bit_;
  receive_until(timeline, exchange_.request_end + slot, 1);
  while (!exchange_.silent() && !(decided_ && exchange_.decoded.error == DecodeError::kNone)) {
    const std::size_t before = exchange_.characters.size();
    receive_until(timeline, last_activity_ + kSynBits * bit_, before + 1);
    if (exchange_.characters.size() == before) break;
  }
  listening_ = false;
  if (auto broken_off = decoder_.finish()) exchange_.decoded = std::move(*broken_off);
  if (!exchange_.silent()) timeline.run_until(std::max(timeline.now(), exchange_.answer_end()));
}

/// Runs until so many characters have come, or `limit` has passed with none in progress.
void Requester::receive_until(Timeline& timeline, Tick limit, std::size_t characters) {
  while (exchange_.characters.size() < characters) {
    if (timeline.step(limit)) continue;
    if (!receiver_.receiving()) {
      timeline.run_until(std::max(timeline.now(), limit));
      return;
    }
    limit = receiver_.next();
  }
}

void Requester::line_changed(Tick at, bool level) {
  if (sender_.busy()) return;  // it would receive itself
  if (receiver_.line_changed(at, level)) announce();
}

bool Requester::run_begins(const CharacterRun& run) {
  announce();
  return sender_.busy() || receiver_.set_run(run);
}

void Requester::run_cut(Tick at, bool /*level*/) {
  announce();
  sender_.run_cut(at);
  receiver_.cut_run(at);
}

void Requester::run(Tick now) {
  if (sender_.busy()) return sender_.run(now);
  receiver_.run(now);
}

void Requester::character(const ReceivedCharacter& received) {
  last_activity_ = received.end;
  if (!listening_) return;
  exchange_.characters.push_back(received);
  exchange_.raw.push_back(received.byte);
  if (decided_) return;  // after a wrong answer, further characters are only kept in `raw`
  if (auto decoded = decoder_.feed(received.byte)) {
    exchange_.decoded = std::move(*decoded);
    decided_ = true;
  }
}

}  // namespace dsdpv1::bus
