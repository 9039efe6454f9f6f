#pragma once
// A synthetic capture: telegrams and pins of a station 5 as a test needs them, exact to a tenth of a cycle.
#include <string>

#include "kinds/dsdpv1/claims/wires.hpp"
#include "lab/calibrate/calibration.hpp"

namespace dsdpv1::calibrate_test {

using bus::Bytes;
using bus::Telegram;
using bus::Tick;
using calibrate::Verdict;
using calibrate::Wire;
namespace wire = calibrate::wire;

constexpr std::uint8_t kStation = 5, kMaster = 2, kOther = 3;       ///< kOther: a second master
constexpr std::uint8_t kLock = 0x80, kUnlock = 0x40, kWdOn = 0x08;  ///< of table 19
constexpr int k12M = 0, k1M5 = 3;

// Requests to the station, and answers of it. `fcb`: fc::kFcb, fc::kFcv, or both.
Telegram srd(std::uint8_t dsap, const Bytes& data = {}, std::uint8_t master = kMaster);
Telegram data_exchange(const Bytes& outputs, unsigned fcb = 0, std::uint8_t master = kMaster);
Telegram fdl_status(std::uint8_t master = kMaster, std::uint8_t station = kStation);
/// Seven bytes: `status` (table 19), watchdog of `wd` x 10 ms, min_TSDR.
Telegram set_prm(std::uint8_t status, std::uint8_t wd = 0, std::uint8_t min_tsdr = 0, std::uint8_t master = kMaster);
Telegram data_answer(const Bytes& inputs, std::uint8_t master = kMaster);
/// From `dsap` of the request to its SSAP.
Telegram sap_answer(std::uint8_t sap, const Bytes& data, std::uint8_t master = kMaster);
/// SD1 with this function code.
Telegram status(std::uint8_t fc, std::uint8_t master = kMaster);
/// Slave_Diag's answer with these two status bytes.
Telegram diagnosis(std::uint8_t status1, std::uint8_t status2);

class MadeCapture {
 public:
  /// With these pins besides PBRXD, PBTXD and PBRTS; all except INTR0 and PBF are low at first.
  explicit MadeCapture(int baud, const std::vector<Wire>& pins = {});

  double bit() const { return static_cast<double>(bus::baud(baud_).bit); }
  Tick now() const { return now_; }
  void wait_ms(double ms) { now_ += static_cast<Tick>(ms * bus::kTicksPerMs); }
  void wait_cycles(double cycles) { now_ += static_cast<Tick>(cycles * bus::kTicksPerCycle); }
  void wait_bits(double bits) { now_ += static_cast<Tick>(bits * bit()); }
  void set(Wire wire, bool level) { set_at(wire, now_, level); }
  /// In order of time for each wire.
  void set_at(Wire wire, Tick at, bool level);
  /// The pin is high where the capture begins.
  void begins_high(Wire wire) { record_.traces.at(static_cast<std::size_t>(wire)).first = true; }
  /// The pin is not in the capture.
  void hide(Wire wire) { record_.traces.at(static_cast<std::size_t>(wire)) = {}; }
  /// A pulse of the other level.
  void pulse(Wire wire, Tick length);

  /// A request after so many bit times of idle; now() is its end.
  void request(const Telegram& telegram, double idle = 40);
  void request(const Bytes& bytes, double idle = 40);
  /// ... that the capture does not show as it was.
  void request_unread(const Telegram& telegram);
  /// The chip's answer to it.
  void answer(const Telegram& telegram, double tsdr = 11);
  /// ... with no edge of PBRTS.
  void answer_undriven(const Telegram& telegram, double tsdr = 11);
  /// Only the first characters of it and some bits of the next one, then idle.
  void cut_answer(const Telegram& telegram, std::size_t characters, int bits);
  void exchange(const Telegram& asked, const Telegram& answered, double tsdr = 11) {
    request(asked), answer(answered, tsdr);
  }
  /// For the following answers; cycles.
  void set_driver(double lead, double trail) { lead_ = lead, trail_ = trail; }
  /// A telegram for another station ends the search: BR rises, and now() is where.
  void find_rate();
  /// Advances now() to 12 bits after the last start bit plus 3 to 4 cycles; call it at the end of a request.
  void decide() { wait_bits(1), wait_cycles(3.5); }

  /// Makes the capture's clock fast by this much.
  void stretch(double ppm);
  /// Makes edges up to this much early or late.
  void jitter(Tick most);
  /// The capture begins there, without earlier changes.
  void begin_at(Tick at);
  calibrate::Result judge();
  /// By an analyser with this sample rate.
  calibrate::Result judge_sampled(double rate);

 private:
  void send(Wire wire, const Bytes& bytes);

  int baud_;
  Tick now_ = bus::kTicksPerMs;
  double lead_ = 4, trail_ = 4;
  calibrate::Record record_{calibrate::wires()};
};

/// The claim of this ruling whose text has these words; fails the test without one.
const calibrate::ClaimResult& claim(const calibrate::Result& result, const std::string& ruling,
                                    const std::string& words);
const calibrate::ParameterResult& parameter(const calibrate::Result& result, const std::string& key);
/// "S3: claim: evidence, ..." of all contradicted claims; empty without any.
std::string contradicted(const calibrate::Result& result);

}  // namespace dsdpv1::calibrate_test
