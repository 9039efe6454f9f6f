#pragma once
// One wave of a run in lockstep: the model's side, beside it the inside of the user's RTL, and where they differ.
#include <memory>
#include <string>
#include <vector>

#include "cosim/lockstep.hpp"
#include "cosim/rtl_trace.hpp"
#include "io/output/part_file.hpp"

namespace dsdpv1::cosim {

/// Until it is finished its parts are in files of their own in the folder of the build, which go with it.
class JoinedWave {
 public:
  /// `path`: .vcd or .fst. `folder`: for the parts.
  JoinedWave(std::string path, std::string folder);
  ~JoinedWave();
  JoinedWave(const JoinedWave&) = delete;
  JoinedWave& operator=(const JoinedWave&) = delete;

  /// Where the model's side is to be written.
  const std::string& model() const { return model_; }
  /// What the RTL of the chip in the model's scope `chip` is to record, into the scope `chip`.rtl.
  RtlTrace trace(const std::string& chip, Tick from = 0, Tick to = bus::kNever);
  /// Writes the wave, once all sides are there: the RTL is gone. With a difference its scope `lockstep` tells it.
  /// Throws tb::InputError.
  void finish(const std::optional<Difference>& difference);

 private:
  struct Trace {
    std::string chip, file;
  };
  std::string part(const std::string& name);

  std::string path_, folder_;
  std::vector<std::unique_ptr<tb::NameToRemove>> parts_;
  std::string model_;
  std::vector<Trace> traces_;
};

}  // namespace dsdpv1::cosim
