#pragma once
// A file of telegrams in whatever form: text, pcapng, pcap, a sigrok session, a logic analyser's CSV, VCD, FST.
#include <cstdint>
#include <fstream>
#include <istream>
#include <optional>
#include <string>

#include "apps/options/rewound_input.hpp"
#include "bus/capture/csv_reader.hpp"

namespace dsdpv1::app {

enum class CaptureForm : std::uint8_t { kText, kPcapng, kPcap, kSigrok, kCsv, kWave };

/// How exact a recording's times are, as far as it says so itself.
struct Sampling {
  std::optional<std::uint64_t> rate = {};  ///< samples a second
  double unit = 0;                         ///< without a rate: ticks to which times were rounded
};

/// What it is, is known by how it begins.
class CaptureFile {
 public:
  /// `path`: empty or "-" is standard input. Throws tb::InputError.
  explicit CaptureFile(const std::string& path);

  CaptureForm form() const { return form_; }
  /// Its telegrams stand in packets, each with its time.
  bool packets() const { return form_ == CaptureForm::kPcapng || form_ == CaptureForm::kPcap; }
  /// Empty: standard input.
  std::string path() const { return standard_input_ ? "" : path_; }
  /// For messages.
  const std::string& name() const { return name_; }
  std::istream& stream() { return input_.stream(); }

  /// Gives `take` each telegram of any form but kText; what it returns is the signal of a recording, nothing for
  /// packets. Throws tb::InputError.
  std::optional<bus::capture::LogicSource> read(const bus::capture::LogicSettings& settings,
                                                const bus::capture::TakeTelegram& take);
  /// Gives `taker` the levels of a recording: a wave, a session of sigrok, a table. Throws tb::InputError, also for
  /// another form.
  Sampling read_levels(bus::capture::LevelTaker& taker);

 private:
  bool standard_input_;
  std::string path_, name_;
  std::ifstream file_;
  RewoundInput input_;
  CaptureForm form_;
};

}  // namespace dsdpv1::app
