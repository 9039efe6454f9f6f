#include "tb/bench/conditions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"
#include "tb/input/units.hpp"

namespace tb {
namespace {

using scenario::Condition;

constexpr std::size_t kShownBytes = 16;

/// Collects the parts of a condition: what is wanted, what is there, whether they agree.
class Parts {
 public:
  void add(const std::string& wanted, const std::string& seen, bool holds) {
    append(wanted_, wanted);
    append(seen_, seen);
    holds_ = holds_ && holds;
  }
  const std::string& wanted() const { return wanted_; }
  Judged judged() const { return {holds_, seen_}; }

 private:
  static void append(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }
  std::string wanted_, seen_;
  bool holds_ = true;
};

std::string shown(const bus::Bytes& bytes) { return bytes.empty() ? "none" : bytes_text(bytes, kShownBytes); }

const char* service_word(scenario::ActionKind service) {
  switch (service) {
    case scenario::ActionKind::kReadInputs: return "read_inputs";
    case scenario::ActionKind::kReadOutputs: return "read_outputs";
    case scenario::ActionKind::kGetCfg: return "get_cfg";
    case scenario::ActionKind::kSlaveDiag: return "slave_diag";
    case scenario::ActionKind::kC1Read: return "c1_read";
    case scenario::ActionKind::kC1Write: return "c1_write";
    case scenario::ActionKind::kC2Read: return "c2_read";
    case scenario::ActionKind::kC2Write: return "c2_write";
    case scenario::ActionKind::kC2Transport: return "c2_transport";
    default: return "set_slave_address";
  }
}

// Each function handles one group of keys; `facts` is null when only the words are wanted.

void add_state(Parts& parts, const Condition& c, const ChipStatus& status) {
  if (c.dp_state)
    parts.add(fmt::format("dp_state {}", name(*c.dp_state)), fmt::format("dp_state {}", name(status.dp_state)),
              status.dp_state == *c.dp_state);
  if (c.baud) parts.add("baud " + baud_text(*c.baud), "baud " + baud_text(status.baud), status.baud == *c.baud);
  if (c.station_address) {
    parts.add(fmt::format("station_address {}", *c.station_address), fmt::format("station_address {}", status.address),
              status.address == *c.station_address);
  }
}

void add_counts(Parts& parts, const Condition& c, const ChipStatus& status) {
  const auto exchanges = static_cast<std::int64_t>(status.data_exchanges);
  const std::string seen = fmt::format("data_exchanges {}", exchanges);
  if (c.data_exchanges)
    parts.add(fmt::format("data_exchanges >= {}", *c.data_exchanges), seen, exchanges >= *c.data_exchanges);
  if (c.data_exchanges_at_most)
    parts.add(fmt::format("data_exchanges <= {}", *c.data_exchanges_at_most), seen,
              exchanges <= *c.data_exchanges_at_most);
  if (c.longest_wait_at_most) {
    const Tick wait = status.longest_wait;
    parts.add("longest wait <= " + time_text(*c.longest_wait_at_most), "longest wait " + time_text(wait),
              wait <= *c.longest_wait_at_most);
  }
}

void add_event(Parts& parts, const Condition& c, const Facts* facts) {
  if (c.event.empty()) return;
  const std::int64_t count =
      facts != nullptr ? static_cast<std::int64_t>(facts->journal.count(c.slave.text, c.event.text)) : 0;
  const bool bounded = c.count_at_most.has_value();
  const std::string wanted = bounded ? fmt::format("event {} {} to {} times", c.event.text,
                                                   std::min(c.count, *c.count_at_most), *c.count_at_most)
                                     : fmt::format("event {} at least {} times", c.event.text, c.count);
  const bool enough = count >= (bounded ? std::min(c.count, *c.count_at_most) : c.count);
  parts.add(wanted, fmt::format("{} times", count), enough && (!bounded || count <= *c.count_at_most));
}

void add_tsdr(Parts& parts, const Condition& c, const Tsdr& tsdr) {
  const std::string seen =
      tsdr.answers == 0 ? "no answers" : fmt::format("TSDR {:.2f} to {:.2f}", tsdr.min_bits, tsdr.max_bits);
  if (c.tsdr_min)
    parts.add(fmt::format("TSDR >= {} bit times", *c.tsdr_min), seen,
              tsdr.answers != 0 && tsdr.min_bits >= *c.tsdr_min);
  if (c.tsdr_max)
    parts.add(fmt::format("TSDR <= {} bit times", *c.tsdr_max), seen,
              tsdr.answers != 0 && tsdr.max_bits <= *c.tsdr_max);
}

bus::Bytes inputs_at_master(const Facts* facts, const std::string& slave) {
  const bus::Master1* master = facts != nullptr ? facts->stations.master_of(slave) : nullptr;
  return master != nullptr ? master->slave(*facts->stations.listed_address(slave)).inputs : bus::Bytes{};
}

void add_data(Parts& parts, const Condition& c, const Facts* facts, const bus::Bytes& outputs) {
  if (c.inputs) {
    const bus::Bytes inputs = inputs_at_master(facts, c.slave.text);
    parts.add("inputs " + shown(*c.inputs), "inputs " + shown(inputs), inputs == *c.inputs);
  }
  if (c.outputs) parts.add("outputs " + shown(*c.outputs), "outputs " + shown(outputs), outputs == *c.outputs);
}

void add_reply(Parts& parts, const Condition& c, const Facts* facts) {
  if (!c.reply_of) return;
  const std::string& asker = c.connection.empty() ? c.master.text : c.connection.text;
  const Reply* reply = facts != nullptr ? facts->replies.last(asker, *c.reply_of) : nullptr;
  const std::string seen = reply == nullptr ? "nothing" : reply->answered ? shown(reply->data) : "no answer";
  const char* service = service_word(*c.reply_of);
  if (c.reply)
    parts.add(fmt::format("reply to {} {}", service, shown(*c.reply)), fmt::format("reply {}", seen),
              reply != nullptr && reply->answered && reply->data == *c.reply);
  if (c.outcome)
    parts.add(fmt::format("outcome of {} {}", service, bus::name(*c.outcome)),
              fmt::format("outcome {}", reply == nullptr ? "nothing" : bus::name(reply->outcome)),
              reply != nullptr && reply->outcome == *c.outcome);
}

void add_connection(Parts& parts, const Condition& c, const Facts* facts) {
  if (!c.connection_state) return;
  const auto state =
      facts != nullptr ? facts->stations.connection(c.connection.text).state() : bus::ConnectionState::kClosed;
  parts.add(fmt::format("connection {}", bus::name(*c.connection_state)),
            fmt::format("connection {}", bus::name(state)), state == *c.connection_state);
}

Parts examine(const Condition& c, const Facts* facts) {
  Parts parts;
  const SlaveStation* slave = facts != nullptr && !c.slave.empty() ? &facts->stations.slave(c.slave.text) : nullptr;
  const ChipStatus status = slave != nullptr ? slave->chip().status() : ChipStatus{};
  add_state(parts, c, status);
  add_counts(parts, c, status);
  add_data(parts, c, facts, slave != nullptr ? slave->outputs() : bus::Bytes{});
  add_event(parts, c, facts);
  add_tsdr(parts, c, slave != nullptr ? slave->tsdr() : Tsdr{});
  add_reply(parts, c, facts);
  add_connection(parts, c, facts);
  return parts;
}

}  // namespace

Judged judge(const scenario::Condition& condition, const Facts& facts) { return examine(condition, &facts).judged(); }

std::string describe(const scenario::Condition& condition) {
  const std::string& asker = condition.connection.empty() ? condition.master.text : condition.connection.text;
  const std::string& subject = condition.slave.empty() ? asker : condition.slave.text;
  return (subject.empty() ? "" : subject + ": ") + examine(condition, nullptr).wanted();
}

std::string describe(const scenario::Expectation& expectation) {
  const std::string text = describe(static_cast<const scenario::Condition&>(expectation));
  if (expectation.at) return text + " at " + time_text(*expectation.at);
  if (expectation.by) return text + " by " + time_text(*expectation.by);
  return text + " at the end";
}

}  // namespace tb
