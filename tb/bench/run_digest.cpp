#include "tb/bench/run_digest.hpp"

#include <string_view>

namespace dsdpv1::tb {
namespace {

Hash begun(char kind, Tick at) {
  Hash hash;
  hash.add(std::string_view(&kind, 1));
  hash.add(static_cast<std::uint64_t>(at));
  return hash;
}

}  // namespace

void RunDigest::event(std::size_t slave, const profibus::Event& event) {
  Hash hash = begun('e', event.at);
  hash.add(std::uint64_t{slave});
  hash.add(std::string_view(profibus::code(event.reason)));
  for (const std::uint16_t number : {event.a, event.b, event.c}) hash.add(std::uint64_t{number});
  add(event.at, hash);
}

void RunDigest::telegram(const HeardTelegram& heard) {
  const bus::WireTelegram& telegram = heard.telegram;
  Hash hash = begun('t', telegram.start);
  hash.add(static_cast<std::uint64_t>(telegram.end));
  hash.add(static_cast<std::uint64_t>(telegram.tsdr.value_or(-1)));
  for (const std::uint8_t byte : telegram.decoded.bytes) hash.add(std::uint64_t{byte});
  add(telegram.end, hash);
}

void RunDigest::violated(const std::string& slave, const checks::Violation& violation, const char* /*kind*/) {
  Hash hash = begun('v', violation.at);
  hash.add(slave);
  hash.add(violation.text);
  add(violation.found, hash);
}

void RunDigest::flag(const bus::Flag& flag) {
  Hash hash = begun('f', flag.at);
  hash.add(flag.text);
  add(flag.at, hash);
}

void RunDigest::master_state(Tick now, const std::string& master, const std::string& member, const std::string& state) {
  Hash hash = begun('m', now);
  for (const std::string* text : {&master, &member, &state}) hash.add(*text);
  add(now, hash);
}

std::uint64_t RunDigest::before(Tick now) {
  while (!waiting_.empty() && waiting_.begin()->first < now) {
    sum_ += waiting_.begin()->second;
    waiting_.erase(waiting_.begin());
  }
  return sum_;
}

}  // namespace dsdpv1::tb
