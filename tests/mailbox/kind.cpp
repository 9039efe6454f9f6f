#include "tests/mailbox/kind.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "tb/bench/record.hpp"
#include "tb/chip/line_driver.hpp"
#include "tests/mailbox/chip.hpp"
#include "tests/mailbox/reasons.hpp"
#include "tests/mailbox/spi_port.hpp"
#include "tests/mailbox/user.hpp"

namespace dsdpv1::mailbox {
namespace {

using tb::PinNumber;

// --- keys ------------------------------------------------------------------------------------------------------------

struct ChipSettings : tb::OwnSettings {};

struct UserSettings : tb::OwnSettings {
  Tick sck_period = 1200;
};

// --- the chip on the segment -----------------------------------------------------------------------------------------

class View : public tb::ChipView, public bus::Agent, public SpiPins, private bus::Listener {
 public:
  View(const tb::ChipRequest& request, bus::Segment& segment)
      : chip_({request.engine == tb::Engine::kStep ? Engine::kStep : Engine::kSkip}),
        watched_(request.watched),
        station_(segment.attach(request.name, this)),
        line_(segment, station_) {
    chip_.watch(
        {[](void* self, Tick at, Pin pin, Level level) { static_cast<View*>(self)->changed(at, pin, level); }, this},
        kOutputPins);
    chip_.on_event({[](void* self, const profibus::Event& event) {
                      const auto& view = *static_cast<View*>(self);
                      if (view.on_event) view.on_event(event);
                    },
                    this});
  }

  // tb::ChipView
  void set_reset(Tick at, bool level) override { set(at, Pin::kReset, level ? 1 : 0); }
  void reset_host(Tick at) override {
    set(at, Pin::kXss, 1);
    set(at, Pin::kSck, 0);
    set(at, Pin::kMosi, 0);
  }
  bus::StationId station() const override { return station_; }
  tb::ChipStatus status() const override { return tb::common_status(chip_.status()); }
  std::uint8_t address() const override { return chip_.status().address; }
  tb::Level level(PinNumber pin) const override { return chip_.level(static_cast<Pin>(pin)); }
  void sync(Tick now) override { run(now); }

  // SpiPins
  void set(Tick at, Pin pin, Level level) override {
    announce();
    const Level before = chip_.level(pin);
    chip_.set(at, pin, level);
    const auto number = static_cast<PinNumber>(pin);
    if (before != level && (watched_ & tb::mask_of(number)) != 0 && on_pin) on_pin(at, number, level);
  }
  Level level(Pin pin) const override { return chip_.level(pin); }

  // bus::Agent
  Tick next() const override { return line_.waits() ? line_.since() : chip_.next_event(); }
  void run(Tick now) override {
    chip_.advance(now);
    line_.pass_on();
  }

 private:
  void line_changed(Tick at, bool level) override { set(at, Pin::kPbrxd, level ? 1 : 0); }
  void changed(Tick at, Pin pin, Level level) {
    if (pin == Pin::kInt && on_interrupt) on_interrupt(at, level != 0);
    if (on_pin) on_pin(at, static_cast<PinNumber>(pin), level);
    if (pin == Pin::kPbtxd) line_.drive(at, level != 0);
    if (pin == Pin::kPbrts) line_.enable(at, level != 0);
  }

  Chip chip_;
  tb::PinMask watched_;
  bus::StationId station_;
  tb::LineDriver line_;
};

// --- the user CPU ----------------------------------------------------------------------------------------------------

class Cpu : public user_cpu::StationCpu {
 public:
  Cpu(SpiPins& pins, const UserConfig& config) : user_(pins, config) {}

  Tick next() const override { return user_.next(); }
  void run(Tick now) override {
    user_.run(now);
    outputs_.assign(user_.outputs().begin(), user_.outputs().end());
  }
  void interrupt_changed(Tick, bool) override {}  // the program looks at INT itself
  void command(Tick, const user_cpu::Command& command) override {
    const auto* set = std::get_if<user_cpu::command::SetInputs>(&command);
    if (set == nullptr) throw std::invalid_argument("the program of a mailbox only knows set_inputs");
    Data inputs{};
    std::copy_n(set->bytes.begin(), std::min(set->bytes.size(), inputs.size()), inputs.begin());
    user_.set_inputs(inputs);
  }
  user_cpu::UserCounters counters() const override {
    user_cpu::UserCounters counters;
    counters.program->exchanges = user_.counters().frames;
    counters.program->outputs_received = user_.counters().outputs_received;
    counters.program->inputs_written = user_.counters().inputs_written;
    return counters;
  }
  std::uint64_t outputs_received() const override { return user_.counters().outputs_received; }
  const std::vector<std::uint8_t>& outputs() const override { return outputs_; }

 private:
  User user_;
  std::vector<std::uint8_t> outputs_;
};

// --- the kind --------------------------------------------------------------------------------------------------------

class Kind : public tb::ChipMaker {
 public:
  const char* name() const override { return "mailbox"; }
  const char* title() const override { return "8-byte mailbox"; }
  int most_cfg() const override { return kCapacities.cfg; }
  const tb::PinTable& pins() const override {
    static const tb::PinTable table = [] {
      tb::PinTable pins;
      for (int i = 0; i < kPinCount; ++i) {
        const auto pin = static_cast<Pin>(i);
        pins.push_back({mailbox::name(pin), 1, (mask(pin) & kOutputPins) == 0});
      }
      return pins;
    }();
    return table;
  }

  const tb::keys::Object& chip_keys() const override {
    static const tb::keys::ObjectOf<ChipSettings> keys("chip", "The mailbox has no parameters.");
    return keys;
  }
  std::unique_ptr<tb::OwnSettings> make_chip_settings() const override { return std::make_unique<ChipSettings>(); }
  const tb::keys::Object& user_keys() const override {
    static const tb::keys::ObjectOf<UserSettings> keys = [] {
      tb::keys::ObjectOf<UserSettings> o("user_cpu", "The SPI controller.");
      o.time("sck_period", &UserSettings::sck_period, {500, 1'000'000}, "A period of SCK, high and low alike.");
      return o;
    }();
    return keys;
  }
  std::unique_ptr<tb::OwnSettings> make_user_settings() const override { return std::make_unique<UserSettings>(); }

  std::string describe(const profibus::Event& event) const override { return mailbox::describe(event); }
  const std::vector<tb::CodeTable>& codes() const override {
    static const std::vector<tb::CodeTable> tables = [] {
      tb::CodeTable chip{"The chip", "", {}};
      for (const profibus::Reason reason : reasons())
        chip.codes.push_back(
            {profibus::code(reason), tb::name(profibus::severity(reason)), text_template(reason), advice(reason)});
      return std::vector<tb::CodeTable>{chip};
    }();
    return tables;
  }

  std::unique_ptr<tb::ChipView> make_pin_chip(const tb::ChipRequest& request, bus::Segment& segment,
                                              bus::Timeline& timeline) const override {
    auto chip = std::make_unique<View>(request, segment);
    timeline.add(*chip);
    return chip;
  }
  tb::MakeUser make_user(const tb::UserRequest& request) const override {
    UserConfig config;
    config.period = request.slave.user_cpu.cycle;
    config.sck_period = static_cast<const UserSettings&>(*request.slave.user_cpu.own).sck_period;
    return [config, &view = static_cast<View&>(request.chip)](const user_cpu::StationConfig& station, Tick start) {
      UserConfig now = config;
      now.start = start + 10 * bus::kTicksPerUs;
      now.address = station.address;
      now.ident = station.ident;
      return std::make_unique<Cpu>(view, now);
    };
  }
};

}  // namespace

const tb::ChipMaker& kind() {
  static const Kind kind;
  return kind;
}

}  // namespace dsdpv1::mailbox
