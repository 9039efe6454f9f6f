#include "tests/kinds/dsdpv1/claims/made_capture.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bus/wire/uart.hpp"

namespace dsdpv1::calibrate_test {

namespace fc = bus::fc;
namespace sap = bus::sap;

Telegram srd(std::uint8_t dsap, const Bytes& data, std::uint8_t master) {
  return bus::make_telegram(kStation, master, fc::kRequest | fc::kSrdHigh, data, dsap, sap::kMaster);
}

Telegram data_exchange(const Bytes& outputs, unsigned fcb, std::uint8_t master) {
  const auto code = static_cast<std::uint8_t>(fc::kRequest | fc::kSrdHigh | fcb);
  return bus::make_telegram(kStation, master, code, outputs);
}

Telegram fdl_status(std::uint8_t master, std::uint8_t station) {
  return bus::make_telegram(station, master, fc::kRequest | fc::kFdlStatus);
}

Telegram set_prm(std::uint8_t status, std::uint8_t wd, std::uint8_t min_tsdr, std::uint8_t master) {
  return srd(sap::kSetPrm, {status, wd, 1, min_tsdr, 0x0C, 0xC9, 0}, master);
}

Telegram data_answer(const Bytes& inputs, std::uint8_t master) {
  return bus::make_telegram(master, kStation, fc::kDl, inputs);
}

Telegram sap_answer(std::uint8_t sap, const Bytes& data, std::uint8_t master) {
  return bus::make_telegram(master, kStation, fc::kDl, data, sap::kMaster, sap);
}

Telegram status(std::uint8_t fc, std::uint8_t master) { return bus::make_telegram(master, kStation, fc); }

Telegram diagnosis(std::uint8_t status1, std::uint8_t status2) {
  return sap_answer(sap::kSlaveDiag, {status1, static_cast<std::uint8_t>(status2 | 4U), 0, kMaster, 0x0C, 0xC9});
}

MadeCapture::MadeCapture(int baud, const std::vector<Wire>& pins) : baud_(baud) {
  const auto add = [this](Wire wire, bool level) {
    record_.traces.at(static_cast<std::size_t>(wire)) = {true, level, {}};
  };
  add(wire::kPbrxd, true), add(wire::kPbtxd, true), add(wire::kPbrts, false);
  for (const Wire wire : pins) add(wire, wire == wire::kIntr0 || wire == wire::kPbf);
}

void MadeCapture::set_at(Wire wire, Tick at, bool level) {
  calibrate::Trace& trace = record_.traces.at(static_cast<std::size_t>(wire));
  if (trace.level(trace.edges.size()) != level) trace.edges.push_back(at);
}

void MadeCapture::pulse(Wire wire, Tick length) {
  const calibrate::Trace& trace = record_[wire];
  const bool level = trace.level(trace.edges.size());
  set_at(wire, now_, !level), set_at(wire, now_ + length, level);
}

void MadeCapture::send(Wire wire, const Bytes& bytes) {
  for (const std::uint8_t byte : bytes) {
    const std::uint16_t bits = bus::Character::of(byte).bits;
    for (int i = 0; i < bus::kCharacterBits; ++i) {
      set_at(wire, now_, (bits >> i & 1) != 0);
      wait_bits(1);
    }
  }
}

void MadeCapture::request(const Telegram& telegram, double idle) { request(bus::encode(telegram), idle); }

void MadeCapture::request(const Bytes& bytes, double idle) {
  wait_bits(idle);
  send(wire::kPbrxd, bytes);
}

void MadeCapture::request_unread(const Telegram& telegram) {
  Bytes bytes = bus::encode(telegram);
  bytes.at(5) ^= 0x04U;
  request(bytes);
}

void MadeCapture::answer(const Telegram& telegram, double tsdr) {
  wait_bits(tsdr), wait_cycles(0.5);
  set_at(wire::kPbrts, now_ - static_cast<Tick>(lead_ * bus::kTicksPerCycle), true);
  send(wire::kPbtxd, bus::encode(telegram));
  set_at(wire::kPbrts, now_ + static_cast<Tick>(trail_ * bus::kTicksPerCycle), false);
}

void MadeCapture::answer_undriven(const Telegram& telegram, double tsdr) {
  wait_bits(tsdr), wait_cycles(0.5);
  send(wire::kPbtxd, bus::encode(telegram));
}

void MadeCapture::cut_answer(const Telegram& telegram, std::size_t characters, int bits) {
  wait_bits(11), wait_cycles(0.5);
  set_at(wire::kPbrts, now_ - static_cast<Tick>(lead_ * bus::kTicksPerCycle), true);
  const Bytes bytes = bus::encode(telegram);
  send(wire::kPbtxd, Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(characters)));
  for (int i = 0; i < bits; ++i) {
    set_at(wire::kPbtxd, now_, (bus::Character::of(bytes.at(characters)).bits >> i & 1) != 0);
    wait_bits(1);
  }
  set_at(wire::kPbtxd, now_, true), set_at(wire::kPbrts, now_, false);
}

void MadeCapture::find_rate() {
  request(fdl_status(kMaster, kStation + 1), 100);
  decide();
  set(wire::kBr, true);
}

void MadeCapture::stretch(double ppm) {
  const auto stretched = [&](Tick at) { return at + static_cast<Tick>(static_cast<double>(at) * ppm * 1e-6); };
  for (calibrate::Trace& trace : record_.traces)
    for (Tick& edge : trace.edges) edge = stretched(edge);
  now_ = stretched(now_);
}

void MadeCapture::jitter(Tick most) {
  std::minstd_rand chance(1);
  for (calibrate::Trace& trace : record_.traces)
    for (Tick& edge : trace.edges) edge += static_cast<Tick>(chance() % (2 * static_cast<unsigned>(most) + 1)) - most;
}

void MadeCapture::begin_at(Tick at) {
  for (calibrate::Trace& trace : record_.traces) {
    trace.first = trace.at(at);
    trace.edges.erase(trace.edges.begin(), trace.edges.begin() + static_cast<std::ptrdiff_t>(trace.count_until(at)));
    for (Tick& edge : trace.edges) edge -= at;
  }
  now_ -= at;
}

calibrate::Result MadeCapture::judge_sampled(double rate) {
  const auto period = static_cast<Tick>(static_cast<double>(bus::kTicksPerSecond) / rate);
  calibrate::Record sampled = record_;
  for (calibrate::Trace& trace : sampled.traces) {
    std::vector<Tick> edges;
    for (const Tick edge : trace.edges) {
      const Tick sample = (edge + period - 1) / period * period;
      if (!edges.empty() && edges.back() == sample)
        edges.pop_back();  // shorter than a sample
      else
        edges.push_back(sample);
    }
    trace.edges = std::move(edges);
  }
  sampled.end = now_ + bus::kTicksPerMs;
  calibrate::Sampling sampling;
  sampling.rate = rate;
  return calibrate::calibrate("made", sampled, sampling, kStation, *tb::chip_kinds().front());
}

calibrate::Result MadeCapture::judge() {
  record_.end = now_ + bus::kTicksPerMs;
  calibrate::Sampling sampling;
  sampling.rate = 480e6;
  sampling.jitter_ns = 0.5;
  return calibrate::calibrate("made", record_, sampling, kStation, *tb::chip_kinds().front());
}

const calibrate::ClaimResult& claim(const calibrate::Result& result, const std::string& ruling,
                                    const std::string& words) {
  for (const calibrate::ClaimResult& each : result.claims)
    if (each.ruling == ruling && each.says.find(words) != std::string::npos) return each;
  ADD_FAILURE() << "no claim of " << ruling << " says " << words;
  return result.claims.front();
}

const calibrate::ParameterResult& parameter(const calibrate::Result& result, const std::string& key) {
  for (const calibrate::ParameterResult& each : result.parameters)
    if (each.row->key == key) return each;
  ADD_FAILURE() << "no parameter " << key;
  return result.parameters.front();
}

std::string contradicted(const calibrate::Result& result) {
  std::string text;
  for (const calibrate::ClaimResult& each : result.claims)
    for (const calibrate::Contradiction& place : each.tally.contradictions)
      text += each.ruling + ": " + each.says + ": " + place.how + "\n";
  return text;
}

}  // namespace dsdpv1::calibrate_test
