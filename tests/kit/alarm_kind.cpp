#include "tests/kit/alarm_kind.hpp"

#include "io/keys/keys.hpp"

namespace dsdpv1::kit {
namespace {

using profibus::kNever;

enum : PinNumber { kStart = kOwn, kRaise, kOpen };

/// A rise of START initialises the slave; a number at RAISE is the slot of a process alarm; OPEN counts those that are
/// open. It takes an Alarm_Ack one edge after the slave has it.
class AlarmPort : public UserPort {
 public:
  explicit AlarmPort(Chip& chip) : chip_(chip) {}

  void reset() override { starts_at_ = raises_at_ = takes_at_ = kNever; }
  void input(Tick at, PinNumber pin, Level level) override {
    if (pin == kStart && level == 1) starts_at_ = profibus::first_edge_after(at);
    if (pin == kRaise && level > 0) raises_at_ = profibus::first_edge_after(at);
  }
  void eval(Cycle now) override {
    if (now == starts_at_) start(now);
    if (now == raises_at_) raise(now);
    if (now == takes_at_) alarms().mail().due.clear();
  }
  void show(Cycle now) override {
    for (Cycle* at : {&starts_at_, &raises_at_, &takes_at_})
      if (*at == now) *at = kNever;
    if (alarms().with_user() && takes_at_ == kNever) takes_at_ = now + 1;
    chip_.drive_at(now, kOpen, static_cast<Level>(alarms().open()));
  }
  Cycle next() const override { return std::min({starts_at_, raises_at_, takes_at_}); }

 private:
  profibus::Alarms& alarms() { return chip_.user().msac().alarms; }
  void start(Cycle now) {
    profibus::SlaveConfig config;
    config.address = 8;
    config.ident = 0x0CC9;
    config.dpv1 = true;
    config.max_input = config.max_output = 2;
    config.max_diag = 20;
    config.max_prm = 3;
    config.max_cfg = 2;
    chip_.user().initialise(now, config);
  }
  void raise(Cycle now) {
    const auto slot = static_cast<std::uint8_t>(chip_.level(kRaise));
    const std::uint8_t block[] = {4, 2, slot, static_cast<std::uint8_t>(slot << 3U | 1)};
    chip_.user().new_alarm(now, block, 4);
  }

  Chip& chip_;
  Cycle starts_at_ = kNever, raises_at_ = kNever, takes_at_ = kNever;
};

struct UserSettings : tb::OwnSettings {
  int raise = 0;
};

/// Raises alarms of slots 1 to `raise`, one a cycle, and those that a diagnosis of the script has.
void program(Cpu& cpu) {
  const int last = static_cast<const UserSettings&>(cpu.settings()).raise;
  cpu.wait(10 * bus::kTicksPerUs);
  cpu.set(kStart, 1);
  for (Level next = 1;;) {
    cpu.wait(cpu.period());
    const std::optional<Diagnosis> ordered = cpu.diagnosis();
    const bool alarm = ordered && ordered->bytes.size() >= 4;
    if (!alarm && next > last) continue;
    cpu.set(kRaise, alarm ? ordered->bytes[2] : next++);
    cpu.wait(bus::kTicksPerUs);
    cpu.set(kRaise, 0);
  }
}

Parts parts() {
  Parts parts{"alarmer", "slave with alarms"};
  parts.pins = {{"START", kInput, 0}, {"RAISE", kInput, 0, 5}, {"OPEN", kOutput, 0, 6}};
  parts.capacities = {3, 2, 2, 0, 8};
  parts.diagnosis = true;
  parts.port = [](Chip& chip) { return std::make_unique<AlarmPort>(chip); };
  parts.program = program;
  return parts;
}

class AlarmKind : public Kind {
 public:
  AlarmKind() : Kind(parts()) {}

  const tb::keys::Object& user_keys() const override {
    static const tb::keys::ObjectOf<UserSettings> keys = [] {
      tb::keys::ObjectOf<UserSettings> o("user_cpu", "The program.");
      o.integer("raise", &UserSettings::raise, {0, 31}, "", "Alarms, one a cycle.");
      return o;
    }();
    return keys;
  }
  std::unique_ptr<tb::OwnSettings> make_user_settings() const override { return std::make_unique<UserSettings>(); }
};

}  // namespace

const Kind& alarm_kind() {
  static const AlarmKind kind;
  return kind;
}

}  // namespace dsdpv1::kit
