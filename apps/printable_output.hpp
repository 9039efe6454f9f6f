#pragma once
// Nothing that a scenario, a file name or firmware holds steers the user's terminal.
#include <memory>
#include <string>

namespace dsdpv1::app {

/// While it lives, what goes to std::cout and std::cerr is printable_lines(): escapes stand for control characters.
/// Line ends within a name are the business of whoever prints it (bus::printable). The progress bar goes round it, by
/// stderr.
class PrintableOutput {
 public:
  /// `name`: of this program, which stands where the lines name dsdpv1-sim.
  explicit PrintableOutput(const std::string& name);
  ~PrintableOutput();
  PrintableOutput(const PrintableOutput&) = delete;
  PrintableOutput& operator=(const PrintableOutput&) = delete;

  /// From now on lines of std::cout are painted() (apps/terminal.hpp), after that.
  void paint();

 private:
  class Filter;
  std::unique_ptr<Filter> out_, err_;
};

}  // namespace dsdpv1::app
