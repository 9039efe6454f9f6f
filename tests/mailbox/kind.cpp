#include "tests/mailbox/kind.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "tb/bench/record.hpp"
#include "tb/chip/pin_chip.hpp"
#include "tb/scenario/scenario.hpp"
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

constexpr PinNumber number(Pin pin) { return static_cast<PinNumber>(pin); }

class Device : public tb::PinDevice {
 public:
  explicit Device(tb::Engine engine) : chip_({engine == tb::Engine::kStep ? Engine::kStep : Engine::kSkip}) {}

  void set(Tick at, PinNumber pin, Level level) override { chip_.set(at, static_cast<Pin>(pin), level); }
  void advance(Tick to) override { chip_.advance(to); }
  Tick now() const override { return chip_.now(); }
  Tick next_event() const override { return chip_.next_event(); }
  Level level(PinNumber pin) const override { return chip_.level(static_cast<Pin>(pin)); }
  Level sample(Tick /*at*/) override { return tb::kLevelZ; }
  void watch(const tb::PinSink& sink, tb::PinMask pins) override {
    sink_ = sink;
    chip_.watch({[](void* self, Tick at, Pin pin, Level level) {
                   const tb::PinSink& to = static_cast<Device*>(self)->sink_;
                   to.call(to.self, at, number(pin), level);
                 },
                 this},
                pins);
  }
  void on_event(const profibus::EventSink& sink) override { chip_.on_event(sink); }
  tb::ChipStatus status() const override { return tb::common_status(chip_.status()); }
  std::uint8_t address() const override { return chip_.status().address; }
  std::uint8_t peek(std::uint16_t /*address*/) const override { return 0; }
  void poke(std::uint16_t /*address*/, std::uint8_t /*value*/) override {}

 private:
  Chip chip_;
  tb::PinSink sink_;
};

constexpr tb::BoardPins kBoardPins = {number(Pin::kReset), number(Pin::kPbrxd), number(Pin::kPbtxd),
                                      number(Pin::kPbrts), number(Pin::kInt)};

class View : public tb::PinChip, private SpiPins {
 public:
  using PinChip::level;
  using PinChip::PinChip;

  void reset_host(Tick at) override {
    set(at, Pin::kXss, 1);
    set(at, Pin::kSck, 0);
    set(at, Pin::kMosi, 0);
  }
  user_cpu::UserSide* user_side() override { return static_cast<SpiPins*>(this); }

 private:
  void set(Tick at, Pin pin, Level level) override { set_pin(at, number(pin), level); }
  Level level(Pin pin) const override { return PinChip::level(number(pin)); }
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
  void interrupt_changed(Tick, bool) override {}  // the program reads INT itself
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

class Kind : public tb::ChipKind {
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

  const tb::BoardPins& board_pins() const override { return kBoardPins; }

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

  const std::vector<profibus::Reason>& reasons() const override {
    static const std::vector<profibus::Reason> all = mailbox::reasons();
    return all;
  }
  std::string describe(const profibus::Event& event) const override { return mailbox::describe(event); }
  const std::vector<tb::CodeTable>& codes() const override {
    static const std::vector<tb::CodeTable> tables = [] {
      tb::CodeTable chip{"The chip", "", {}};
      for (const profibus::Reason reason : mailbox::reasons())
        chip.codes.push_back(
            {profibus::code(reason), tb::name(profibus::severity(reason)), "", text_template(reason), advice(reason)});
      return std::vector<tb::CodeTable>{chip};
    }();
    return tables;
  }

  std::unique_ptr<tb::PinDevice> make_device(const tb::ChipRequest& request) const override {
    return std::make_unique<Device>(request.engine);
  }
  std::unique_ptr<tb::PinChip> make_pin_chip(const tb::ChipRequest& request, std::unique_ptr<tb::PinDevice> device,
                                             bus::Segment& segment) const override {
    return std::make_unique<View>(request.name, std::move(device), pins(), kBoardPins, request.watched, segment);
  }
  tb::MakeUser make_user(const tb::UserRequest& request) const override {
    UserConfig config;
    config.period = request.slave.user_cpu.cycle;
    config.sck_period = static_cast<const UserSettings&>(*request.slave.user_cpu.own).sck_period;
    return [config, &spi = static_cast<SpiPins&>(*request.chip.user_side())](const user_cpu::StationConfig& station,
                                                                             Tick start) {
      UserConfig now = config;
      now.start = start + 10 * bus::kTicksPerUs;
      now.address = station.address;
      now.ident = station.ident;
      return std::make_unique<Cpu>(spi, now);
    };
  }
};

}  // namespace

const tb::ChipKind& kind() {
  static const Kind kind;
  return kind;
}

}  // namespace dsdpv1::mailbox
