// A module in a SystemC platform: an idle user, and a saturated 12 Mbit/s bus with 16 bytes each way. A program can run
// only one simulation, so each call measures one row. Speeds are simulated time divided by CPU time.
#include <tlm_utils/simple_initiator_socket.h>

#include <array>
#include <systemc>

#include "tests/bench/programs.hpp"
#include "tests/bench/saturated_bus.hpp"
#include "tests/bench/stopwatch.hpp"
#include "tests/systemc/bench.hpp"

namespace dsdpv1::speed {
namespace {

using dsdpv1::systemc::BusCharacter;
using dsdpv1::systemc::ChipModule;
using dsdpv1::systemc::to_time;

constexpr int kIo = 16;
constexpr Tick kMillisecond = 12'000'000, kSlice = 5 * kMillisecond;
constexpr double kMeasured = 0.3;  // seconds
constexpr Tick kReady = kMillisecond, kInitialised = 2 * kMillisecond;

/// The requests of the bus in sequence: the begin of the next one, and its number.
class Requests {
 public:
  const Bytes& next() {
    if (begun_ < bring_up_.size()) return bring_up_[begun_++];
    ++exchanges_;
    return cyclic_[exchanges_ & 1U];
  }
  /// From the begin of the request returned by `next` to that of the next one.
  Tick period(const Bytes& request) const {
    const int idle = exchanges_ > 0 ? answer_and_syn_bits(kIo) : 1000;
    return (static_cast<int>(request.size()) * bus::kCharacterBits + idle) * kBit;
  }
  std::uint64_t exchanges() const { return exchanges_; }

 private:
  std::vector<Bytes> bring_up_ = bring_up(kIo), cyclic_ = exchange_requests(kIo);
  std::size_t begun_ = 0;
  std::uint64_t exchanges_ = 0;
};

/// Sends requests as characters.
struct CharacterMaster : sc_core::sc_module, private tlm::tlm_analysis_if<BusCharacter> {
  sc_core::sc_port<tlm::tlm_analysis_if<BusCharacter>> send{"send"};
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> receive{"receive"};
  Requests requests;
  std::uint64_t received = 0;

  explicit CharacterMaster(const sc_core::sc_module_name& name) : sc_module(name) {
    receive.bind(*this);
    SC_HAS_PROCESS(CharacterMaster);
    SC_METHOD(run);
    dont_initialize();
    sensitive << start_;
    start_.notify(to_time(kInitialised));
  }
  void run() {
    const Bytes& request = requests.next();
    sc_core::sc_time start = sc_core::sc_time_stamp();
    for (const std::uint8_t byte : request) {
      send->write({start, bit_, byte, true, true});
      start += character_;
    }
    next_trigger(to_time(requests.period(request)));
  }
  void write(const BusCharacter& /*character*/) override { ++received; }

 private:
  sc_core::sc_event start_;
  const sc_core::sc_time bit_ = to_time(kBit), character_ = to_time(bus::kCharacterBits * kBit);
};

/// Sends requests edge by edge.
struct EdgeMaster : sc_core::sc_module {
  sc_core::sc_signal<bool>& line;
  Requests requests;

  EdgeMaster(const sc_core::sc_module_name& name, sc_core::sc_signal<bool>& pbrxd) : sc_module(name), line(pbrxd) {
    SC_HAS_PROCESS(EdgeMaster);
    SC_METHOD(run);
    dont_initialize();
    sensitive << start_;
    start_.notify(to_time(kInitialised));
  }
  void run() {
    if (edge_ == wave_.edges.size()) begin();
    const Tick at = wave_.edges[edge_].at;
    line.write(wave_.edges[edge_].level);
    const Tick next = ++edge_ < wave_.edges.size() ? wave_.edges[edge_].at : period_;
    next_trigger(to_time(next - at));
  }

 private:
  void begin() {
    const Bytes& request = requests.next();
    wave_ = wave_of(request);
    period_ = requests.period(request);
    edge_ = 0;
  }
  sc_core::sc_event start_;
  Wave wave_;
  std::size_t edge_ = 0;
  Tick period_ = 0;
};

/// The user's side of the TLM module, without an access.
struct IdleCpu : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<IdleCpu> socket{"socket"};
  explicit IdleCpu(const sc_core::sc_module_name& name) : sc_module(name) {}
};

/// The user writes without pins, which stay idle; time before this is not measured.
void initialise(ChipModule& chip) {
  for (const Cell& cell : initialisation(kIo)) chip.poke(cell.address, cell.value);
}

void run_for(Tick duration) { sc_core::sc_start(to_time(duration)); }

/// Simulated time divided by CPU time.
double speed_from_now() {
  Tick simulated = 0;
  const Stopwatch watch;
  for (; watch.seconds() < kMeasured; simulated += kSlice) run_for(kSlice);
  return static_cast<double>(simulated) / kTicksPerSecond / watch.seconds();
}

double measure(ChipModule& chip, const Requests& requests) {
  run_for(kReady);
  initialise(chip);
  run_for(kInitialised - kReady + kMillisecond);
  const std::uint64_t exchanged = chip.chip().status().data_exchanges, sent = requests.exchanges();
  const double speed = speed_from_now();
  const std::uint64_t answers = chip.chip().status().data_exchanges - exchanged, asked = requests.exchanges() - sent;
  if (answers + 1 < asked || answers == 0) throw Failure("exchanges were lost");  // one may be on its way
  return speed;
}

/// `handshake`: L_REQ and L_STA are bound, for a user who samples them.
double tlm_module(bool handshake) {
  dsdpv1::systemc::TlmModule chip("chip");
  CharacterMaster master("master");
  IdleCpu cpu("cpu");
  cpu.socket.bind(chip.host_socket);
  sc_core::sc_signal<bool> reset("reset"), r_req("r_req"), r_sta("r_sta"), l_req("l_req"), l_sta("l_sta");
  sc_core::sc_signal<bool> intr0("intr0");
  chip.RESET(reset), chip.R_REQ(r_req), chip.R_STA(r_sta);
  chip.INTR0(intr0);
  if (handshake) chip.L_REQ(l_req), chip.L_STA(l_sta);
  master.send.bind(chip.bus_in);
  chip.bus_out.bind(master.receive);
  reset.write(true);
  const double value = measure(chip, master.requests);
  if (master.received < master.requests.exchanges()) throw Failure("the master has got no answers");
  return value;
}

double systemc_pins() {
  PinBench pins("chip");
  pins.chip.on_pin = {};  // changes are not recorded
  EdgeMaster master("master", pins.pbrxd);
  pins.reset.write(true);
  return measure(pins.chip, master.requests);
}

// --- SystemC alone ---------------------------------------------------------------------------------------------------

/// Repeats the changes of a chip's output signals from some exchanges, without computing anything.
struct Replay : sc_core::sc_module {
  std::array<sc_core::sc_signal<bool>, dsdpv1::kPinCount> signals;

  Replay(const sc_core::sc_module_name& name, std::uint32_t pins) : sc_module(name) {
    constexpr int kExchanges = 20;
    dsdpv1::Chip chip;
    SaturatedBus<dsdpv1::Chip> bus(chip, kIo);
    bus.start();
    chip.watch({[](void* self, Tick at, dsdpv1::Pin pin, dsdpv1::Level level) {
                  static_cast<Replay*>(self)->changes_.push_back({at, pin, level != 0});
                },
                this},
               pins);
    begin_ = bus.now();
    for (int i = 0; i < kExchanges; ++i) bus.exchange();
    period_ = bus.now() - begin_;
    SC_HAS_PROCESS(Replay);
    SC_METHOD(run);
  }
  void run() {
    const Tick at = time_of(next_);
    for (; time_of(next_) == at; ++next_) {
      const Change& change = changes_[next_ % changes_.size()];
      signals.at(static_cast<std::size_t>(change.pin)).write(change.level);
    }
    next_trigger(to_time(time_of(next_) - at));
  }

 private:
  struct Change {
    Tick at;
    dsdpv1::Pin pin;
    bool level;
  };
  Tick time_of(std::size_t change) const {
    const std::size_t count = changes_.size();
    return static_cast<Tick>(change / count) * period_ + changes_[change % count].at - begin_;
  }
  std::vector<Change> changes_;  ///< of the core's outputs
  Tick begin_ = 0, period_ = 0;
  std::size_t next_ = 0;
};

/// Receives a signal and does nothing.
struct Ear : sc_core::sc_module {
  Ear(const sc_core::sc_module_name& name, sc_core::sc_signal<bool>& signal) : sc_module(name) {
    SC_HAS_PROCESS(Ear);
    SC_METHOD(run);
    dont_initialize();
    sensitive << signal;
  }
  void run() {}
};

/// The signals and changes of systemc_pins, and a receiver on PBRXD, without a chip.
double kernel_pins() {
  sc_core::sc_signal<bool> pbrxd("pbrxd");
  const Ear ear("ear", pbrxd);
  EdgeMaster master("master", pbrxd);
  Replay chip("chip", dsdpv1::kOutputPins);
  run_for(kInitialised + kMillisecond);
  return speed_from_now();
}

struct Sink : sc_core::sc_module, private tlm::tlm_analysis_if<BusCharacter> {
  sc_core::sc_export<tlm::tlm_analysis_if<BusCharacter>> receive{"receive"};
  explicit Sink(const sc_core::sc_module_name& name) : sc_module(name) { receive.bind(*this); }
  void write(const BusCharacter& /*character*/) override {}
};

/// The characters and changes of systemc_tlm_handshake, without a chip.
double kernel_handshake() {
  CharacterMaster master("master");
  Sink sink("sink");
  master.send.bind(sink.receive);
  Replay chip("chip", dsdpv1::mask(dsdpv1::Pin::kLReq) | dsdpv1::mask(dsdpv1::Pin::kLSta));
  run_for(kInitialised + kMillisecond);
  return speed_from_now();
}

}  // namespace
}  // namespace dsdpv1::speed

int sc_main(int argc, char* argv[]) {
  dsdpv1::systemc::require_femtoseconds();
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s ROW\n", argv[0]);
    return 2;
  }
  return dsdpv1::speed::run_rows(argc, argv,
                                 {{"systemc_tlm", [] { return dsdpv1::speed::tlm_module(false); }},
                                  {"systemc_tlm_handshake", [] { return dsdpv1::speed::tlm_module(true); }},
                                  {"kernel_handshake", dsdpv1::speed::kernel_handshake},
                                  {"systemc_pins", dsdpv1::speed::systemc_pins},
                                  {"kernel_pins", dsdpv1::speed::kernel_pins}});
}
