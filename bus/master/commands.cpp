// The bench's commands to a class-1 master.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "bus/master/master1.hpp"

namespace dsdpv1::bus {

void Master1::start() {
  start_requested_ = true;
  announce();
}

void Master1::stop() {
  start_requested_ = false;
  stop_requested_ = true;
  announce();
}

void Master1::change_baud(int index) {
  bus::baud(index);  // throws for an unknown rate
  new_baud_ = index;
  announce();
}

void Master1::set_mode(bool clear) {
  if (clear_ == clear) return;
  clear_ = clear;
  for (const auto& slave : slaves_) slave->handler.set_clear(clear);
  global_control(clear ? global_control::kClearData : std::uint8_t{0});
}

bool Master1::has_slave(std::uint8_t address) const {
  return std::any_of(
      slaves_.begin(), slaves_.end(),
      [&](const auto& slave) { return slave->handler.parameters().address == address; });
}

Master1::Slave& Master1::slave_at(std::uint8_t address) {
  for (const auto& slave : slaves_)
    if (slave->handler.parameters().address == address) return *slave;
  throw std::out_of_range(fmt::format("no slave with address {}", address));
}

const Master1::Slave& Master1::slave_at(std::uint8_t address) const {
  for (const auto& slave : slaves_)
    if (slave->handler.parameters().address == address) return *slave;
  throw std::out_of_range(fmt::format("no slave with address {}", address));
}

void Master1::set_outputs(std::uint8_t address, const Bytes& outputs) {
  slave_at(address).handler.set_outputs(outputs);
}

void Master1::vary_outputs(std::uint8_t address, OutputPattern pattern, std::uint32_t seed) {
  slave_at(address).handler.vary_outputs(pattern, seed);
}

void Master1::release(std::uint8_t address) { slave_at(address).handler.release(); }

void Master1::activate(std::uint8_t address) { slave_at(address).handler.restart("activated"); }

const SlaveView& Master1::slave(std::uint8_t address) const { return slave_at(address).handler.view(); }

const SlaveParameters& Master1::parameters(std::uint8_t address) const {
  return slave_at(address).handler.parameters();
}

std::vector<std::uint8_t> Master1::slave_addresses() const {
  std::vector<std::uint8_t> addresses;
  for (const auto& slave : slaves_) addresses.push_back(slave->handler.parameters().address);
  return addresses;
}

void Master1::push(FdlRequest request, AnswerCallback done) {
  commands_.push_back({std::move(request), std::move(done)});
  announce();
}

void Master1::request(const Telegram& telegram, AnswerCallback done) {
  FdlRequest request;
  request.telegram = telegram;
  push(std::move(request), std::move(done));
}

void Master1::service(std::uint8_t address, std::uint8_t sap, const Bytes& data, AnswerCallback done) {
  const bool high = config_.personality == Personality::kHighAlways;
  const auto function = static_cast<std::uint8_t>(fc::kRequest | (high ? fc::kSrdHigh : fc::kSrdLow));
  const Telegram telegram = make_telegram(address, config_.address, function, data, sap, sap::kMaster);
  request(high ? prefer_sd3(telegram) : telegram, std::move(done));
}

void Master1::global_control(std::uint8_t command, std::uint8_t group, std::uint8_t da, AnswerCallback done) {
  request(make_telegram(da, config_.address, fc::kRequest | fc::kSdnHigh, {command, group}, sap::kGlobalControl,
                        sap::kMaster),
          std::move(done));
}

void Master1::read_inputs(std::uint8_t address, AnswerCallback done) {
  service(address, sap::kReadInputs, {}, std::move(done));
}

void Master1::read_outputs(std::uint8_t address, AnswerCallback done) {
  service(address, sap::kReadOutputs, {}, std::move(done));
}

void Master1::get_cfg(std::uint8_t address, AnswerCallback done) {
  service(address, sap::kGetCfg, {}, std::move(done));
}

void Master1::slave_diag(std::uint8_t address, AnswerCallback done) {
  service(address, sap::kSlaveDiag, {}, std::move(done));
}

void Master1::fdl_status(std::uint8_t address, AnswerCallback done) {
  request(make_telegram(address, config_.address, fc::kRequest | fc::kFdlStatus), std::move(done));
}

void Master1::set_slave_address(std::uint8_t address, std::uint8_t new_address, std::uint16_t ident, bool lock,
                                AnswerCallback done) {
  const Bytes data = {new_address, static_cast<std::uint8_t>(ident >> 8), static_cast<std::uint8_t>(ident & 0xFF),
                      static_cast<std::uint8_t>(lock ? 0xFF : 0)};
  service(address, sap::kSetSlaveAddress, data, std::move(done));
}

void Master1::c1_read(std::uint8_t address, std::uint8_t slot, std::uint8_t index, std::uint8_t length,
                      AcyclicCallback done) {
  c1_request(address, read_request(slot, index, length), std::move(done));
}

void Master1::c1_write(std::uint8_t address, std::uint8_t slot, std::uint8_t index, const Bytes& data,
                       AcyclicCallback done) {
  c1_request(address, write_request(slot, index, data), std::move(done));
}

void Master1::c1_request(std::uint8_t address, const AcyclicRequest& request, AcyclicCallback done) {
  slave_at(address).c1.push(now_, request, told(address, std::move(done)));
}

AcyclicCallback Master1::told(std::uint8_t address, AcyclicCallback done) {
  return [this, address, done = std::move(done)](const AcyclicResult& result) {
    if (done) done(result);
    if (on_acyclic) on_acyclic(now_, address, result);
  };
}

std::size_t Master1::c1_open(std::uint8_t address) const { return slave_at(address).c1.open(); }

void Master1::send_raw(const Bytes& bytes, const WireFaults& faults, bool wants_answer, AnswerCallback done) {
  FdlRequest request;
  request.raw = characters(bytes, faults);
  request.wants_answer = wants_answer;
  TelegramDecoder decoder;
  for (const std::uint8_t byte : bytes) {
    const auto decoded = decoder.feed(byte);
    if (!decoded) continue;
    if (decoded->error == DecodeError::kNone) request.telegram = decoded->telegram;
    break;
  }
  push(std::move(request), std::move(done));
}

}  // namespace dsdpv1::bus
