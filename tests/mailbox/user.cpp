#include "tests/mailbox/user.hpp"

#include <algorithm>

#include "tests/mailbox/spi_port.hpp"

namespace dsdpv1::mailbox {

void User::run(bus::Tick now) {
  switch (edge_) {
    case Edge::kSelect: return select(now);
    case Edge::kRise: return rise(now);
    case Edge::kFall: return fall(now);
    case Edge::kDeselect: return deselect(now);
  }
}

// --- one frame -------------------------------------------------------------------------------------------------------

void User::begin(const std::vector<std::uint8_t>& bytes, Tick at) {
  sent_ = bytes;
  received_.assign(bytes.size(), 0);
  bit_ = 0;
  plan(Edge::kSelect, at);
}

void User::select(Tick now) {
  if (sent_.empty()) {
    cycle_ = now;
    begin({command::kStart, config_.address, static_cast<std::uint8_t>(config_.ident >> 8),
           static_cast<std::uint8_t>(config_.ident & 0xFF), 0},
          now);
  }
  announced_ = pins_.level(Pin::kInt) == 0;
  show_bit(now);
  pins_.set(now, Pin::kXss, 0);
  plan(Edge::kRise, now + config_.sck_period / 2);
}

void User::show_bit(Tick now) { pins_.set(now, Pin::kMosi, static_cast<Level>(sent_[bit_ / 8] >> (7 - bit_ % 8) & 1)); }

void User::rise(Tick now) {
  std::uint8_t& byte = received_[bit_ / 8];
  byte = static_cast<std::uint8_t>(byte << 1 | (pins_.level(Pin::kMiso) > 0 ? 1 : 0));
  pins_.set(now, Pin::kSck, 1);
  plan(Edge::kFall, now + config_.sck_period / 2);
}

void User::fall(Tick now) {
  pins_.set(now, Pin::kSck, 0);
  const bool last = ++bit_ == sent_.size() * 8;
  if (!last) show_bit(now);
  plan(last ? Edge::kDeselect : Edge::kRise, now + config_.sck_period / 2);
}

void User::deselect(Tick now) {
  pins_.set(now, Pin::kXss, 1);
  ++counters_.frames;
  switch (sent_[0]) {
    case command::kReadOutputs:
      std::copy_n(received_.begin() + 1, outputs_.size(), outputs_.begin());
      counters_.outputs_received += announced_ ? 1 : 0;
      return begin_write(now);
    case command::kWriteInputs: ++counters_.inputs_written; return begin_read(now);
    default: return begin_read(now);
  }
}

// --- the firmware ----------------------------------------------------------------------------------------------------

void User::begin_read(Tick now) {
  std::vector<std::uint8_t> bytes(kDataFrame, 0);
  bytes[0] = command::kReadOutputs;
  cycle_ = std::max(cycle_ + config_.period, now + frame_gap());
  begin(bytes, cycle_);
}

void User::begin_write(Tick now) {
  const Data& data = inputs_ ? *inputs_ : outputs_;
  std::vector<std::uint8_t> bytes = {command::kWriteInputs};
  bytes.insert(bytes.end(), data.begin(), data.end());
  begin(bytes, now + frame_gap());
}

}  // namespace dsdpv1::mailbox
