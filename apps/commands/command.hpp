#pragma once
// A command of dsdpv1-sim: all of it is in one file of this folder.
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

#include "apps/exit_codes.hpp"

namespace dsdpv1::app {

/// The end of --help where exit codes have no other meaning than this.
constexpr const char* kExitCodes =
    "\nExit codes: 0 passed, 1 a check or expectation failed, 2 wrong input (one line says where, what, and what is "
    "allowed),\n"
    "3 nothing was judged, 130 interrupted.\n";

/// Made at every start, whichever is called: what takes time is in carry_out.
class Command {
 public:
  /// `line`: what --help of the program says of it.
  Command(const char* name, const char* line) : name_(name), line_(line) {}
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;
  virtual ~Command() = default;

  const char* name() const { return name_; }
  const char* line() const { return line_; }

  /// It is about the options of all commands; else they are said for those that the command line names.
  virtual bool shows_all() const { return false; }
  /// Says its options, examples and exit codes to its part of the command line. carry_out checks words and times:
  /// CLI11 would do it before it handles --help.
  virtual void options(CLI::App& app) = 0;
  /// Once the options have their values. Returns the exit code; throws tb::InputError.
  virtual int carry_out() = 0;

  std::vector<std::string> words;  ///< the whole command line without the program's name, from carry_out on

 private:
  const char *name_, *line_;
};

std::unique_ptr<Command> make_accept();
std::unique_ptr<Command> make_calibrate();
std::unique_ptr<Command> make_compare();
std::unique_ptr<Command> make_completion();
std::unique_ptr<Command> make_cosim();
std::unique_ptr<Command> make_decode();
std::unique_ptr<Command> make_demo();
std::unique_ptr<Command> make_gsd();
std::unique_ptr<Command> make_manual();
std::unique_ptr<Command> make_reasons();
std::unique_ptr<Command> make_recover();
std::unique_ptr<Command> make_regress();
std::unique_ptr<Command> make_replay();
std::unique_ptr<Command> make_rtl_faults();
std::unique_ptr<Command> make_rtl_random();
std::unique_ptr<Command> make_run();
std::unique_ptr<Command> make_schema();
std::unique_ptr<Command> make_serve();
std::unique_ptr<Command> make_sweep();
std::unique_ptr<Command> make_traces();
std::unique_ptr<Command> make_verify_rtl();

}  // namespace dsdpv1::app
