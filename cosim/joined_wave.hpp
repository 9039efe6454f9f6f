#pragma once
// One wave of a lockstep run: the model's side, internal signals of the user's RTL, and their difference.
#include <memory>
#include <string>
#include <vector>

#include "cosim/lockstep.hpp"
#include "cosim/rtl_trace.hpp"
#include "io/output/part_file.hpp"

namespace dsdpv1::cosim {

/// Until it is finished, its parts are in separate files in the build folder, which are then removed.
class JoinedWave {
 public:
  /// `path`: .vcd or .fst. `folder`: for the parts.
  JoinedWave(std::string path, std::string folder);
  ~JoinedWave();
  JoinedWave(const JoinedWave&) = delete;
  JoinedWave& operator=(const JoinedWave&) = delete;

  /// The file for the model's side.
  const std::string& model() const { return model_; }
  /// The trace of the RTL of the chip in the model's scope `chip`, in scope `chip`.rtl.
  RtlTrace trace(const std::string& chip, Tick from = 0, Tick to = bus::kNever);
  /// Writes the wave once all sides are complete and the RTL is destroyed. A difference is shown in its scope
  /// `lockstep`. Throws tb::InputError.
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
