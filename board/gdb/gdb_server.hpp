#pragma once
// `--gdb PORT`: a processor under a gdb on the same machine, by the remote serial protocol. One thread: while the
// processor is halted the server does not return from its call, so simulated time stands still.
//
// The run waits at the first instruction until a gdb has connected and lets it go. gdb may leave (`detach`, `quit`, a
// broken connection): the run continues, and the next gdb may connect; `kill` ends the run. Only real time is lost, so
// a run with a debugger has the result of a run without, unless the user changes registers or memory.
//
// gdb goes back (reverse-step, reverse-continue) by a journey: the run ends, and its owner begins it again with the
// same history. The new run's server has the connection, and halts nowhere before the place that gdb wants.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "board/cpu/debug_target.hpp"
#include "board/gdb/gdb_commands.hpp"
#include "board/gdb/gdb_link.hpp"
#include "tb/chip/user_cpu/debug_history.hpp"

namespace dsdpv1::arm {

struct GdbOptions {
  int port = 0;  ///< 0 to 65535, at 127.0.0.1; 0: any free one
  /// True: the run must end (SIGINT). Called ten times a second while the processor is halted.
  std::function<bool()> stopped = [] { return false; };
  /// One line for the user, for stderr.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  user_cpu::DebugHistory* history = nullptr;  ///< null: gdb cannot go back; else it outlives the server
  std::uint64_t board = 0;                    ///< as DebugHistory counts them
  /// Flash with the program that the run's file has now; empty: none.
  std::function<std::vector<std::uint8_t>()> program_now = [] { return std::vector<std::uint8_t>(); };
};

class GdbServer final : public Debugger {
 public:
  /// Throws tb::InputError in one line when the port is not available. `target` is used until the server's destructor.
  GdbServer(DebugTarget& target, GdbOptions options);
  /// Tells a gdb that waits for a stop that the run has ended.
  ~GdbServer() override;
  GdbServer(const GdbServer&) = delete;
  GdbServer& operator=(const GdbServer&) = delete;

  int port() const { return link_->port(); }

  bool wanted() const override {
    if (travels()) return nears_end();
    return !over_ && (due_ || !commands_.breakpoints().empty() || !commands_.watchpoints().empty());
  }
  void before_instruction(std::uint32_t pc) override {
    if (travels()) return travel(pc);
    if (--until_look_ == 0 || due_ || commands_.breakpoints().at(pc)) consider(pc);
  }
  void data_access(std::uint32_t address, std::uint32_t size, bool write) override;
  void poll() override;
  void fault(const std::string& what) override;

 private:
  /// Instructions between two looks for Ctrl-C: about a millisecond of real time.
  static constexpr unsigned kInstructionsPerLook = 4096;

  /// Passed from the server of one run to that of the next.
  struct Session {
    std::shared_ptr<GdbLink> link;
    Stops stops;
    bool extended = false;
    std::optional<std::string> awaited;
  };
  /// The last place of a search so far.
  struct Found {
    std::uint64_t place = 0;
    std::string reply;
  };

  // Going back
  bool travels() const { return options_.history != nullptr && options_.history->journey.has_value(); }
  std::uint64_t place() const { return 2 * target_.instructions() + (target_.asleep() ? 1 : 0); }
  bool nears_end() const;
  void take_over();
  bool go_back(bool as_far_as_something_stops);
  void depart(user_cpu::Journey journey);
  void begin_again();
  void travel(std::optional<std::uint32_t> pc);
  void end_journey();

  void consider(std::uint32_t pc);
  bool halt_if_due(std::uint32_t pc, bool look);
  bool halt_if_gdb_wants();
  bool resumed_here(std::uint32_t pc);
  void expect_call_again();
  std::optional<std::string> reason_to_stop(std::uint32_t pc) const;
  void wait_for_gdb();
  void stop(const std::string& reply);
  void converse();
  bool carry_out(const std::string& packet);
  void resume(Resumption how);
  void let_go();
  void end();

  DebugTarget& target_;
  GdbOptions options_;
  std::shared_ptr<GdbLink> link_;
  GdbCommands commands_;
  bool due_ = true;        ///< consider() has to look at the next instruction, whichever it is
  bool waiting_ = true;    ///< for the first gdb
  bool attached_ = false;  ///< a gdb has connected and has not been let go
  unsigned until_look_ = kInstructionsPerLook;
  bool stepping_ = false;
  bool over_ = false;                        ///< the run ends: nothing halts it any more
  std::optional<std::uint32_t> resumed_at_;  ///< see expect_call_again()
  std::optional<std::string> awaited_;       ///< reply to what has reset the processor: when it is halted again
  std::optional<Found> found_;
  std::string watch_hit_;  ///< stop reply of a watchpoint that the last instruction met; empty: none
};

}  // namespace dsdpv1::arm
