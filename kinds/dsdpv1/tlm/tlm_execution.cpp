#include "kinds/dsdpv1/tlm/tlm_execution.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <systemc>
#include <utility>
#include <vector>

#include "io/input/input_error.hpp"
#include "kinds/dsdpv1/chip/core_device.hpp"
#include "kinds/dsdpv1/chip/dsdpv1_pin_chip.hpp"
#include "kinds/dsdpv1/keys/settings.hpp"
#include "kinds/dsdpv1/pins/pin_table.hpp"
#include "kinds/dsdpv1/tlm/tlm_chip.hpp"
#include "kinds/dsdpv1/tlm/tlm_host_bus.hpp"
#include "model/systemc/main_stack.hpp"
#include "model/systemc/sim_time.hpp"

namespace dsdpv1::tb {
namespace {

// Pins at which an agent's plan changes: the user CPU, and readers of the serial ports' telegrams.
constexpr std::uint32_t kPlannedBy =
    dsdpv1::mask(Pin::kIntr0) | dsdpv1::mask(Pin::kTxd) | dsdpv1::mask(Pin::kRxd) | dsdpv1::mask(Pin::kXss);

class TlmChipView : public ChipView {
 public:
  template <class Options>
  TlmChipView(const std::string& name, const Options& options, std::uint32_t watched, bus::Segment& segment,
              systemc_bench::TimelineModule& timeline)
      : chip_(name.c_str(), options, segment, timeline), bus_((name + "_host").c_str(), chip_) {
    chip_.on_pin = [this, watched, &timeline](Tick at, Pin pin, dsdpv1::Level level) {
      if (!dsdpv1::is_input(pin) || (watched & dsdpv1::mask(pin)) != 0) tell(at, pin, level);
      if (pin == Pin::kTxd && bus_.on_txd) bus_.on_txd(at, level != 0);
      if ((dsdpv1::mask(pin) & kPlannedBy) != 0) timeline.wake();
    };
    chip_.module().on_event = [this, &timeline](const profibus::Event& event) {
      if (listener_ != nullptr) listener_->event(number_, event);
      timeline.wake();  // the script may have waited for it
    };
    bus_.on_begin = [this](Tick at, const user_cpu::Access& access, Tick sample) {
      if (wanted_.actions) listener_->action(number_, at, words_of(access));
      if (!access.write && wanted_.reads) listener_->read(number_, sample);
    };
    bus_.on_looked = [this](const user_cpu::Looks& last) {
      if (!wanted_.reads) return;
      listener_->looked(number_, number(Pin::kLReq), last.l_req);
      listener_->looked(number_, number(Pin::kLSta), last.l_sta);
    };
    bus_.on_handshake = [this](Tick at, const char* pin, bool level) {
      if (wanted_.actions) listener_->action(number_, at, words_of(pin, level));
    };
  }

  void set_reset(Tick, bool level) override { chip_.set_reset(level); }
  void reset_host(Tick) override { bus_.reset(); }
  user_cpu::UserSide* user_side() override { return &bus_; }
  bus::StationId station() const override { return chip_.station(); }
  ChipStatus status() const override { return status_of(core()); }
  std::uint8_t address() const override { return core().address(); }
  Level level(PinNumber pin) const override { return core().level(static_cast<Pin>(pin)); }
  std::uint8_t peek(std::uint16_t address) const override { return core().peek(address); }
  void sync(Tick now) override { chip_.module().sync(dsdpv1::systemc::time_until(now)); }

 private:
  const dsdpv1::Chip& core() const { return chip_.module().chip(); }
  void tell(Tick at, Pin pin, Level level) const {
    if (listener_ == nullptr) return;
    if (pin == Pin::kIntr0) listener_->interrupt(number_, at, level != 0);
    listener_->pin(number_, at, number(pin), level);
  }

  systemc_bench::TlmChip chip_;
  user_cpu::TlmHostBus bus_;
};

class TlmExecution : public Execution {
 public:
  std::unique_ptr<ChipView> make_chip(const ChipKind& kind, const ChipRequest& request) override {
    const auto* settings = dynamic_cast<const Dsdpv1Settings*>(&request.settings);
    if (settings == nullptr)
      throw InputError(fmt::format("--view tlm is not for chips of the kind {}, expected --view pins", kind.name()));
    if (!has_serial_ports(settings->part)) return make_view(request, dsdpv1::systemc::TlmOptions());
    dsdpv1::systemc::RsuTlmOptions options;
    options.straps = {settings->mode, settings->address, settings->uart_rate, settings->interval};
    return make_view(request, options);
  }

  Tick quiet_until(const bus::Agent& agent) override { return module_.quiet_until(agent); }
  bool go_on(const bus::Agent& agent, Tick tick) override { return module_.go_on(agent, tick); }

  void run(Tick end, const std::function<bool()>& stopped) override {
    if (stopped()) return;
    module_.limit = end;
    module_.stopped = stopped;
    sc_core::sc_start(dsdpv1::systemc::to_time(end + 1));  // SystemC excludes the last tick
    dsdpv1::systemc::announce_main_stack();
  }

 private:
  template <class Options>
  std::unique_ptr<ChipView> make_view(const ChipRequest& request, Options options) {
    options.chip = config_of(request);
    options.report_violations = false;  // the bench reports them
    options.observed =
        request.watched | dsdpv1::mask(Pin::kIntr0) | dsdpv1::mask(Pin::kPbrts) | dsdpv1::mask(Pin::kTxd);
    return std::make_unique<TlmChipView>(request.name, options, request.watched, segment_, module_);
  }

  systemc_bench::TimelineModule module_{"timeline", timeline_};
};

const std::function<int()>* body_of_sc_main = nullptr;
std::exception_ptr failure_of_sc_main;

}  // namespace

std::unique_ptr<Execution> make_tlm_execution() { return std::make_unique<TlmExecution>(); }

int inside_systemc(const std::function<int()>& body) {
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  body_of_sc_main = &body;
  char name[] = "dsdpv1-sim";
  char* arguments[] = {name, nullptr};
  const int status = sc_core::sc_elab_and_sim(1, arguments);
  if (failure_of_sc_main) std::rethrow_exception(std::exchange(failure_of_sc_main, nullptr));
  return status;
}

/// SystemC would print an exception with its own text.
int run_body() {
  try {
    return (*body_of_sc_main)();
  } catch (...) {
    failure_of_sc_main = std::current_exception();
    return 1;
  }
}

}  // namespace dsdpv1::tb

int sc_main(int, char**) { return dsdpv1::tb::run_body(); }
