#include "bus/master/master2.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dsdpv1::bus {

Master2::Master2(Segment& segment, const MasterConfig& config)
    : config_(config),
      fdl_(segment, config.name, config.address, config.bus),
      ring_(fdl_, config.address, config.bus),
      baud_(config.baud) {
  if (config.address >= kHighestAddress)
    throw std::invalid_argument(fmt::format("master address {}, expected 0 to 125", config.address));
  fdl_.set_baud(now_, config.baud);
  ring_.set_baud(config.baud);
  fdl_.on_done = [this](const FdlResult& result) { finished(result); };
  fdl_.on_plan = [this] { announce(); };
}

void Master2::start() {
  start_requested_ = true;
  announce();
}

void Master2::stop() {
  start_requested_ = false;
  stop_requested_ = true;
  announce();
}

void Master2::change_baud(int index) {
  bus::baud(index);  // throws for an unknown rate
  new_baud_ = index;
}

// --- connections -----------------------------------------------------------------------------------------------------

ConnectionId Master2::add_connection(const ConnectionParameters& parameters) {
  const ConnectionId id = connections_.size();
  auto connection = std::make_unique<Connection>(parameters, config_.address);
  connection->on_state = [this, id](ConnectionState from, ConnectionState to) {
    if (on_state) on_state(now_, id, from, to);
  };
  connection->on_end = [this, id](const ConnectionEnd& end) {
    if (on_end) on_end(now_, id, end);
  };
  connections_.push_back(std::move(connection));
  return id;
}

void Master2::read(ConnectionId id, std::uint8_t slot, std::uint8_t index, std::uint8_t length, AcyclicCallback done) {
  request(id, read_request(slot, index, length), std::move(done));
}

void Master2::write(ConnectionId id, std::uint8_t slot, std::uint8_t index, const Bytes& data, AcyclicCallback done) {
  request(id, write_request(slot, index, data), std::move(done));
}

void Master2::transport(ConnectionId id, std::uint8_t slot, std::uint8_t index, const Bytes& data,
                        AcyclicCallback done) {
  request(id, transport_request(slot, index, data), std::move(done));
}

void Master2::request(ConnectionId id, const AcyclicRequest& request, AcyclicCallback done) {
  connections_.at(id)->push(
      now_, request,
      [this, id, done = std::move(done)](const AcyclicResult& result) {
        if (done) done(result);
        if (on_acyclic) on_acyclic(now_, id, result);
      });
}

// --- the order of things ---------------------------------------------------------------------------------------------

Tick Master2::next() const {
  if (stop_requested_ || (start_requested_ && !running_)) return now_;
  if (!running_ || !fdl_.idle()) return fdl_.next();
  return ring_.holds_token() ? now_ : std::min(ring_.next(), fdl_.next());
}

void Master2::run(Tick now) {
  now_ = now;
  if (std::exchange(stop_requested_, false)) {
    running_ = false;
    ring_.stop(now);
    fdl_.abort(now);
    for (const auto& connection : connections_) connection->stop(now);
  }
  if (std::exchange(start_requested_, false) && !running_) {
    running_ = true;
    ring_.start(now);
  }
  fdl_.run(now);
  while (running_ && fdl_.idle() && start_next()) {
  }
}

/// Begins the next request. Returns false if there is none.
bool Master2::start_next() {
  if (new_baud_) {
    baud_ = *std::exchange(new_baud_, std::nullopt);
    fdl_.set_baud(now_, baud_);
    ring_.set_baud(baud_);
  }
  if (ring_.holds_token()) return use_token();
  had_token_ = false;
  return ring_.act(now_);
}

bool Master2::use_token() {
  if (!std::exchange(had_token_, true)) turns_ = connections_.size();
  while (turns_ > 0 && ring_.may_begin(now_, false)) {
    Connection& connection = *connections_[position_];
    position_ = (position_ + 1) % connections_.size();
    --turns_;
    if (!connection.due(now_)) continue;
    ask(connection);
    return true;
  }
  had_token_ = false;
  ring_.release(now_);
  return true;
}

void Master2::ask(Connection& connection) {
  FdlRequest request;
  request.telegram = connection.next_request(now_);
  asking_ = &connection;
  ring_.begun(false);
  fdl_.start(now_, std::move(request));
}

void Master2::finished(const FdlResult& result) {
  if (ring_.asking()) ring_.done(now_, result);
  if (Connection* connection = std::exchange(asking_, nullptr)) connection->done(now_, result);
  if (on_answer) on_answer(now_, result);
}

}  // namespace dsdpv1::bus
