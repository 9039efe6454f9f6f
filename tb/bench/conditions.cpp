#include "tb/bench/conditions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/baud.hpp"
#include "io/input/units.hpp"

namespace dsdpv1::tb {
namespace {

using scenario::Condition;

constexpr std::size_t kShownBytes = 16;

/// Collects the parts of a condition: whether they hold, or as text the wanted and the actual values.
class Parts {
 public:
  enum class In : std::uint8_t { kTruth, kWords };
  explicit Parts(In in) : in_(in) {}

  /// `wanted` and `seen` make text, and are called only for that.
  template <class Wanted, class Seen>
  void add(bool holds, const Wanted& wanted, const Seen& seen) {
    holds_ = holds_ && holds;
    if (in_ == In::kTruth) return;
    append(wanted_, wanted());
    append(seen_, seen());
  }
  bool hold() const { return holds_; }
  const std::string& wanted() const { return wanted_; }
  const std::string& seen() const { return seen_; }

 private:
  static void append(std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; }
  const In in_;
  std::string wanted_, seen_;
  bool holds_ = true;
};

std::string shown(const bus::Bytes& bytes) { return bytes.empty() ? "none" : bytes_text(bytes, kShownBytes); }

std::string times_text(std::int64_t count) { return count == 1 ? "once" : fmt::format("{} times", count); }

// Each function handles one group of keys; `facts` is null if only the wanted text is needed.

void add_state(Parts& parts, const Condition& c, const ChipStatus& status) {
  if (c.dp_state)
    parts.add(
        status.dp_state == *c.dp_state, [&] { return fmt::format("dp_state {}", name(*c.dp_state)); },
        [&] { return fmt::format("dp_state {}", name(status.dp_state)); });
  if (c.baud)
    parts.add(
        status.baud == *c.baud, [&] { return "baud " + baud_text(*c.baud); },
        [&] { return "baud " + baud_text(status.baud); });
  if (c.station_address)
    parts.add(
        status.address == *c.station_address, [&] { return fmt::format("station_address {}", *c.station_address); },
        [&] { return fmt::format("station_address {}", status.address); });
}

void add_counts(Parts& parts, const Condition& c, const ChipStatus& status) {
  const auto exchanges = static_cast<std::int64_t>(status.data_exchanges);
  const auto seen = [&] { return fmt::format("data_exchanges {}", exchanges); };
  if (c.data_exchanges)
    parts.add(
        exchanges >= *c.data_exchanges, [&] { return fmt::format("data_exchanges >= {}", *c.data_exchanges); }, seen);
  if (c.data_exchanges_at_most)
    parts.add(
        exchanges <= *c.data_exchanges_at_most,
        [&] { return fmt::format("data_exchanges <= {}", *c.data_exchanges_at_most); }, seen);
  if (c.longest_wait_at_most)
    parts.add(
        status.longest_wait <= *c.longest_wait_at_most,
        [&] { return "longest wait <= " + time_text(*c.longest_wait_at_most); },
        [&] { return "longest wait " + time_text(status.longest_wait); });
}

void add_event(Parts& parts, const Condition& c, const Facts* facts) {
  if (c.event.empty()) return;
  const std::int64_t count =
      facts != nullptr ? static_cast<std::int64_t>(facts->journal.count(c.slave.text, c.event.text)) : 0;
  const bool bounded = c.count_at_most.has_value();
  const std::int64_t least = bounded ? std::min(c.count, *c.count_at_most) : c.count;
  parts.add(
      count >= least && (!bounded || count <= *c.count_at_most),
      [&] {
        return bounded ? fmt::format("event {} {} to {} times", c.event.text, least, *c.count_at_most)
                       : fmt::format("event {} at least {}", c.event.text, times_text(least));
      },
      [&] { return times_text(count); });
}

void add_tsdr(Parts& parts, const Condition& c, const Tsdr& tsdr) {
  const bool answered = tsdr.answers != 0;
  const auto seen = [&] {
    return answered ? fmt::format("TSDR {:.2f} to {:.2f}", tsdr.min_bits, tsdr.max_bits) : std::string("no answers");
  };
  if (c.tsdr_min)
    parts.add(
        answered && tsdr.min_bits >= *c.tsdr_min, [&] { return fmt::format("TSDR >= {} bit times", *c.tsdr_min); },
        seen);
  if (c.tsdr_max)
    parts.add(
        answered && tsdr.max_bits <= *c.tsdr_max, [&] { return fmt::format("TSDR <= {} bit times", *c.tsdr_max); },
        seen);
}

const bus::Bytes* inputs_at_master(const Facts* facts, const std::string& slave) {
  const bus::Master1* master = facts != nullptr ? facts->stations.master_of(slave) : nullptr;
  return master != nullptr ? &master->slave(*facts->stations.listed_address(slave)).inputs : nullptr;
}

void add_bytes(Parts& parts, const char* what, const bus::Bytes& wanted, const bus::Bytes* there) {
  static const bus::Bytes none;
  const bus::Bytes& seen = there != nullptr ? *there : none;
  parts.add(
      seen == wanted, [&] { return fmt::format("{} {}", what, shown(wanted)); },
      [&] { return fmt::format("{} {}", what, shown(seen)); });
}

void add_data(Parts& parts, const Condition& c, const Facts* facts, const SlaveStation* slave) {
  if (c.inputs) add_bytes(parts, "inputs", *c.inputs, inputs_at_master(facts, c.slave.text));
  if (c.outputs) add_bytes(parts, "outputs", *c.outputs, slave != nullptr ? &slave->outputs() : nullptr);
}

void add_reply(Parts& parts, const Condition& c, const Facts* facts) {
  if (!c.reply_of) return;
  const std::string& asker = c.connection.empty() ? c.master.text : c.connection.text;
  const Reply* reply = facts != nullptr ? facts->replies.last(asker, *c.reply_of) : nullptr;
  const char* service = service_word(*c.reply_of);
  if (c.reply)
    parts.add(
        reply != nullptr && reply->answered && reply->data == *c.reply,
        [&] { return fmt::format("reply to {} {}", service, shown(*c.reply)); },
        [&] {
          return "reply " + (reply == nullptr ? "nothing" : reply->answered ? shown(reply->data) : "no answer");
        });
  if (c.outcome)
    parts.add(
        reply != nullptr && reply->outcome == *c.outcome,
        [&] { return fmt::format("outcome of {} {}", service, bus::name(*c.outcome)); },
        [&] { return fmt::format("outcome {}", reply == nullptr ? "nothing" : bus::name(reply->outcome)); });
}

void add_connection(Parts& parts, const Condition& c, const Facts* facts) {
  if (!c.connection_state) return;
  const auto state =
      facts != nullptr ? facts->stations.connection(c.connection.text).state() : bus::ConnectionState::kClosed;
  parts.add(
      state == *c.connection_state, [&] { return fmt::format("connection {}", bus::name(*c.connection_state)); },
      [&] { return fmt::format("connection {}", bus::name(state)); });
}

/// The state of a slave outside the bench as known to its master: data exchange or not, and its count.
ChipStatus status_at_master(const Stations& stations, const std::string& slave) {
  ChipStatus status;
  const bus::Master1* master = stations.master_of(slave);
  if (master == nullptr) return status;
  const bus::SlaveView& view = master->slave(*stations.listed_address(slave));
  if (view.state == bus::SlaveState::kDataExchange) status.dp_state = profibus::DpState::kDataExch;
  status.data_exchanges = view.counters.data_exchanges;
  return status;
}

ChipStatus status_of(const Condition& c, const Facts* facts, const SlaveStation* slave) {
  if (slave != nullptr) return slave->chip().status();
  return facts != nullptr && !c.slave.empty() ? status_at_master(facts->stations, c.slave.text) : ChipStatus{};
}

Parts examine(const Condition& c, const Facts* facts, Parts::In in) {
  Parts parts(in);
  const SlaveStation* slave = facts != nullptr && !c.slave.empty() ? facts->stations.find_slave(c.slave.text) : nullptr;
  const ChipStatus status = status_of(c, facts, slave);
  add_state(parts, c, status);
  add_counts(parts, c, status);
  add_data(parts, c, facts, slave);
  add_event(parts, c, facts);
  add_tsdr(parts, c, slave != nullptr ? slave->tsdr() : Tsdr{});
  add_reply(parts, c, facts);
  add_connection(parts, c, facts);
  return parts;
}

}  // namespace

bool holds(const scenario::Condition& condition, const Facts& facts) {
  return examine(condition, &facts, Parts::In::kTruth).hold();
}

std::string seen(const scenario::Condition& condition, const Facts& facts) {
  return examine(condition, &facts, Parts::In::kWords).seen();
}

std::string describe(const scenario::Condition& condition) {
  const std::string& asker = condition.connection.empty() ? condition.master.text : condition.connection.text;
  const std::string& subject = condition.slave.empty() ? asker : condition.slave.text;
  return (subject.empty() ? "" : subject + ": ") + examine(condition, nullptr, Parts::In::kWords).wanted();
}

std::string describe(const scenario::Expectation& expectation) {
  const std::string text = describe(static_cast<const scenario::Condition&>(expectation));
  if (expectation.at) return text + " at " + time_text(*expectation.at);
  if (expectation.by) return text + " by " + time_text(*expectation.by);
  return text + " at the end";
}

}  // namespace dsdpv1::tb
