#include "bus/master/master1.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dsdpv1::bus {

namespace {

/// High or low priority of the data link layer; bytes that are not a telegram count as low.
bool is_high(const FdlRequest& request) {
  const std::uint8_t function = request.telegram.function();
  return function == fc::kSrdHigh || function == fc::kSdnHigh || function == fc::kSdaHigh;
}

}  // namespace

Master1::Master1(Segment& segment, const MasterConfig& config)
    : config_(config), fdl_(segment, config.name, config.address, config.bus), baud_(config.baud) {
  if (config.address >= kHighestAddress)
    throw std::invalid_argument(fmt::format("master address {}, expected 0 to 125", config.address));
  if (config.bus.ring) ring_ = std::make_unique<TokenRing>(fdl_, config.address, config.bus);
  if (ring_) ring_->set_baud(config.baud);
  fdl_.set_baud(now_, config.baud);
  fdl_.on_done = [this](const FdlResult& result) { finished(result); };
  fdl_.on_plan = [this] { announce(); };
}

void Master1::add_slave(const SlaveParameters& parameters) {
  if (has_slave(parameters.address) || parameters.address == config_.address)
    throw std::invalid_argument(fmt::format("address {} is used twice", parameters.address));
  const std::uint8_t address = parameters.address;
  const Tick timeout = parameters.c1_response_timeout * kTimeUnit10ms;
  auto slave = std::make_unique<Slave>(Slave{SlaveHandler(parameters, config_.address, config_.personality),
                                             C1Client(address, config_.address, timeout),
                                             C1Client(address, config_.address, timeout, sap::kMs1Alarm)});
  SlaveHandler& handler = slave->handler;
  handler.set_clear(clear_);
  if (parameters.alarms.acknowledged) {
    C1Client& client = parameters.alarms.extra_sap ? slave->alarms : slave->c1;
    handler.on_alarm = [this, address, &client](const AcyclicRequest& ack) { client.push(now_, ack, told(address)); };
  }
  handler.on_state = [this, address, &each = *slave](SlaveState from, SlaveState to) {
    if (from == SlaveState::kDataExchange) leave_acyclic(each, "data exchange was left");
    if (on_state) on_state(now_, address, from, to);
  };
  handler.on_inputs = [this, address] {
    if (on_inputs) on_inputs(now_, address);
  };
  handler.on_diagnosis = [this, address] {
    if (on_diagnosis) on_diagnosis(now_, address);
  };
  slaves_.push_back(std::move(slave));
}

std::int64_t Master1::min_slave_interval_us() const {
  std::int64_t greatest = 0;
  for (const auto& slave : slaves_) greatest = std::max(greatest, slave->handler.parameters().min_slave_interval_us);
  return config_.bus.min_slave_interval_us.value_or(greatest);
}

Tick Master1::next() const {
  if (stop_requested_ || (start_requested_ && !running_)) return now_;
  if (!running_ || !fdl_.idle()) return fdl_.next();
  if (ring_) return ring_->holds_token() ? now_ : std::min(ring_->next(), fdl_.next());
  if (work_to_do()) return now_;
  return std::min(due_, fdl_.next());
}

bool Master1::work_to_do() const {
  if (phase_ == Phase::kListen) return false;
  return phase_ != Phase::kWait || new_baud_.has_value() || !commands_.empty();
}

void Master1::run(Tick now) {
  now_ = now;
  if (stop_requested_) {
    stop_requested_ = false;
    running_ = false;
    if (ring_) ring_->stop(now);
    fdl_.abort(now);
    for (const auto& slave : slaves_) leave_acyclic(*slave, "the master was stopped");
  }
  if (start_requested_) begin_operation();
  fdl_.run(now);
  while (running_ && fdl_.idle() && start_next()) {
  }
}

void Master1::leave_acyclic(Slave& slave, const std::string& reason) {
  slave.alarms.leave(now_, reason);
  slave.c1.leave(now_, reason);
}

void Master1::begin_operation() {
  start_requested_ = false;
  if (running_) return;
  running_ = true;
  phase_ = ring_ ? Phase::kWait : Phase::kListen;
  due_ = now_;
  if (ring_) ring_->start(now_);
  claims_ = 0;
  listen_from_ = now_;
  for (const auto& slave : slaves_) {
    if (slave->handler.view().state != SlaveState::kReleased) slave->handler.restart("master started");
    fdl_.restart_series(slave->handler.parameters().address);
  }
}

/// Begins the next request. Returns false if none can begin before `due_`.
bool Master1::start_next() {
  if (new_baud_) {
    baud_ = *std::exchange(new_baud_, std::nullopt);
    fdl_.set_baud(now_, baud_);
    if (ring_) ring_->set_baud(baud_);
  }
  if (ring_) return start_in_ring();
  if (phase_ == Phase::kListen) return listen();
  return commands_.empty() ? start_phase() : start_command();
}

bool Master1::start_in_ring() {
  if (!ring_->holds_token()) return ring_->act(now_);
  const bool command = !commands_.empty();
  const bool high = command ? is_high(commands_.front().request) : phase_ == Phase::kSlaves || phase_ == Phase::kWait;
  if (ring_->may_begin(now_, high)) return command ? start_command() : start_phase();
  ring_->release(now_);
  return true;
}

bool Master1::start_command() {
  Command command = std::move(commands_.front());
  commands_.pop_front();
  ask(std::move(command.request), std::move(command.done));
  return true;
}

bool Master1::start_phase() {
  switch (phase_) {
    case Phase::kListen: return listen();
    case Phase::kClaim: return start_claim();
    case Phase::kSlaves: return start_slave();
    case Phase::kAcyclic: return start_acyclic();
    case Phase::kPollSlot: return start_poll_slot();
    case Phase::kGap: return start_gap_poll();
    case Phase::kToken: return start_token();
    case Phase::kWait: return wait();
  }
  return false;
}

bool Master1::listen() {
  const Tick timeout = (6 + 2 * Tick{config_.address}) * config_.bus.slot(baud_) * bus::baud(baud_).bit;
  due_ = std::max(listen_from_, fdl_.last_activity()) + timeout;
  if (now_ < due_) return false;
  phase_ = Phase::kClaim;
  return true;
}

bool Master1::start_claim() {
  // EN 50170: a master that finds a dead bus claims the token by passing it to itself twice.
  if (!config_.bus.token || claims_ == 2) {
    begin_cycle();
    return true;
  }
  ++claims_;
  FdlRequest request;
  request.telegram = make_token(config_.address, config_.address);
  ask(std::move(request), {});
  return true;
}

void Master1::begin_cycle() {
  phase_ = Phase::kSlaves;
  slave_position_ = 0;
  cycle_start_ = now_;
}

bool Master1::start_slave() {
  while (slave_position_ < slaves_.size()) {
    SlaveHandler& slave = slaves_[slave_position_++]->handler;
    if (slave.offline() || slave.view().state == SlaveState::kReleased) continue;
    ask_slave(slave);
    return true;
  }
  phase_ = Phase::kAcyclic;
  acyclic_position_ = 0;
  return true;
}

/// One acyclic telegram per slave and cycle, however many wait: the cyclic exchange keeps its rhythm.
bool Master1::start_acyclic() {
  while (acyclic_position_ < slaves_.size()) {
    Slave& slave = *slaves_[acyclic_position_++];
    if (slave.handler.view().state != SlaveState::kDataExchange) continue;
    C1Client* const due = slave.alarms.due(now_) ? &slave.alarms : slave.c1.due(now_) ? &slave.c1 : nullptr;
    if (due == nullptr) continue;
    ask_c1(*due);
    return true;
  }
  phase_ = Phase::kPollSlot;
  return true;
}

/// One offline slave per cycle, so that present ones do not wait for many slot times.
bool Master1::start_poll_slot() {
  phase_ = Phase::kGap;
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    offline_position_ = (offline_position_ + 1) % slaves_.size();
    if (!slaves_[offline_position_]->handler.offline()) continue;
    ask_slave(slaves_[offline_position_]->handler);
    break;
  }
  return true;
}

bool Master1::start_gap_poll() {
  phase_ = Phase::kToken;
  if (ring_) return true;  // the ring's GAP does it
  const auto factor = static_cast<std::uint64_t>(std::max(config_.bus.gap_factor, 0));
  if (factor == 0 || cycles_ % factor != 0) return true;
  for (int i = 0; i <= config_.bus.highest_address; ++i) {
    gap_address_ =
        gap_address_ >= config_.bus.highest_address ? std::uint8_t{0} : static_cast<std::uint8_t>(gap_address_ + 1);
    if (gap_address_ == config_.address || has_slave(gap_address_)) continue;
    FdlRequest request;
    request.telegram = make_telegram(gap_address_, config_.address, fc::kRequest | fc::kFdlStatus);
    ask(std::move(request), {});
    break;
  }
  return true;
}

bool Master1::start_token() {
  phase_ = Phase::kWait;
  ++cycles_;
  // A cycle without any request must also take some time.
  const Tick least = std::max(min_slave_interval_us() * kTicksPerUs, kSynBits * bus::baud(baud_).bit);
  due_ = cycle_start_ + least;
  if (ring_) {
    ring_->release(now_);
    return true;
  }
  if (!config_.bus.token) return true;
  FdlRequest request;
  request.telegram = make_token(config_.address, config_.address);
  ask(std::move(request), {});
  return true;
}

bool Master1::wait() {
  if (now_ < due_) {
    if (ring_) ring_->release(now_);
    return ring_ != nullptr;
  }
  cycle_time_ = now_ - cycle_start_;
  begin_cycle();
  return true;
}

void Master1::ask(FdlRequest request, AnswerCallback done) {
  current_done_ = std::move(done);
  if (ring_) ring_->begun(is_high(request));
  fdl_.start(now_, std::move(request));
}

void Master1::ask_slave(SlaveHandler& slave) {
  FdlRequest request;
  request.telegram = slave.next_request();
  ask(std::move(request), [&slave](const FdlResult& result) { slave.done(result); });
}

void Master1::ask_c1(C1Client& c1) {
  FdlRequest request;
  request.telegram = c1.next_request();
  ask(std::move(request), [this, &c1](const FdlResult& result) { c1.done(now_, result); });
}

void Master1::finished(const FdlResult& result) {
  const AnswerCallback done = std::exchange(current_done_, {});
  if (ring_ && ring_->asking()) ring_->done(now_, result);
  if (result.request.is_request()) record_live(result.request.da, result);
  if (done) done(result);
  if (on_answer) on_answer(now_, result);
}

void Master1::record_live(std::uint8_t address, const FdlResult& result) {
  if (result.outcome == FdlOutcome::kNoAnswer) live_.at(address) = LiveState::kAbsent;
  if (!result.answered() || result.answer.kind == TelegramKind::kSc) return;
  live_.at(address) = (result.answer.fc & 0x30U) == 0 ? LiveState::kPassive : LiveState::kActive;
}

}  // namespace dsdpv1::bus
