#pragma once
// A loop that looks at something outside of the processor until it changes. A pass that stores nothing and leaves all
// registers as they were is followed by passes just like it, until what it looks at may change: they are left out, and
// their time and instructions counted.
#include <cstdint>

#include "board/cpu/engine.hpp"

namespace dsdpv1::arm {

class Polling {
 public:
  explicit Polling(Engine& engine) : engine_(engine) {}

  /// Between two instructions, the first of which has looked outside: what it saw stays until `until` (thousandths of a
  /// cycle). Leaves out the passes that end before that, none unless the last two were alike.
  void looked(std::uint64_t until);
  /// When the pass at work began, just after a look.
  std::uint64_t began() const { return began_; }
  /// Something outside may have changed: the passes to come may be others.
  void restart() { begun_ = false; }
  /// Something happened that need not happen again: a store, an exception, a look at a value that changes with time.
  void end();
  /// Between two instructions without a look.
  void pass_by();

 private:
  static constexpr unsigned kMostLooks = 8;               ///< in a pass
  static constexpr std::uint64_t kMostInstructions = 64;  ///< from one look to the next
  void begin(bool looks_at_stores);

  Engine& engine_;
  bool begun_ = false, looks_at_stores_ = false;
  EngineState first_{};  ///< after the look with which the pass began
  std::uint64_t began_ = 0, instructions_ = 0;
  unsigned looks_ = 0;
};

}  // namespace dsdpv1::arm
