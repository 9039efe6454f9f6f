#pragma once
// What a stimulus may do to a slave: actions of masters, telegrams, waiting. Here they become lines of a scenario's
// script. Their times count from the slave's first data exchange, because firmware starts as slowly as it likes.
#include <cstdint>
#include <random>
#include <string>

#include "bus/gsd/gsd.hpp"
#include "bus/master/slave_parameters.hpp"
#include "bus/time.hpp"

namespace dsdpv1::tb::accept {

/// Names in the scenario.
constexpr const char* kDevice = "device";
constexpr const char* kMaster = "plc";       ///< of class 1
constexpr const char* kProbe = "probe";      ///< of class 1, without slaves: sends single telegrams
constexpr const char* kMaster2 = "eng";      ///< of class 2
constexpr const char* kConnection = "tool";  ///< of kMaster2 to the slave
constexpr const char* kBrief = "brief";      ///< a second one, whose Send_Timeout is brief_timeout

/// An object that the slave's masters may read.
struct Object {
  int slot = 1, index = 1, length = 4;
};

/// The slave, as its masters see it.
struct Slave {
  bus::SlaveParameters parameters;
  bus::Gsd gsd;
  std::uint8_t master = 0, probe = 0;  ///< addresses of kMaster and kProbe
  Object object;
};

/// As short as a user may need who serves what comes `within` that time, in steps of 10 ms.
constexpr bus::Tick brief_timeout(bus::Tick within) {
  constexpr bus::Tick kStep = 10 * bus::kTicksPerMs;
  return (within / kStep + 1) * kStep;
}

class Requests {
 public:
  /// `slave` must outlive it. It serves what comes `within` that time.
  Requests(const Slave& slave, std::uint32_t seed, bus::Tick within) : slave_(slave), random_(seed), within_(within) {}

  const Slave& slave() const { return slave_; }
  /// An action as in a script, without its time: "do: stop_master".
  void act(const std::string& keys);
  /// A request of the master of class 1 outside of its cycle, or of kProbe.
  void telegram(std::uint8_t sap, std::uint8_t ssap, const bus::Bytes& data);
  /// From now on the slave is free, and gets nothing but what the stimulus sends, from kProbe.
  void stop_cycle();
  /// The master takes the slave again; it is back in data exchange after a while.
  void start_cycle();
  void wait(bus::Tick time) { now_ += time; }
  /// Until the user has served what came.
  bus::Tick served() const { return within_; }
  /// Until a slave that was refused or asked again is in data exchange: diagnosis, parameters and configuration take
  /// two verdicts, and a master repeats what came to nothing.
  bus::Tick returned() const { return 6 * within_; }
  /// 0 to `most`, of the seed.
  bus::Tick chance(bus::Tick most);

  bus::Tick now() const { return now_; }
  /// The lines of the script.
  const std::string& script() const { return script_; }

 private:
  const Slave& slave_;
  /// A request by `sender`, by the master in the cycle or by kProbe.
  void send(std::uint8_t sender, std::uint8_t sap, std::uint8_t ssap, const bus::Bytes& data);
  /// `holder` releases the slave.
  void unlock(std::uint8_t holder);

  std::minstd_rand random_;
  bus::Tick within_;
  bus::Tick now_ = 0;
  bool in_cycle_ = true;
  std::string script_;
};

}  // namespace dsdpv1::tb::accept
