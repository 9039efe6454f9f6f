#pragma once
// A station of a platform's own on a segment, by characters: a master or a bus model that knows characters only.
#include <systemc>

#include "bus/timeline.hpp"
#include "bus/wire/segment.hpp"
#include "model/systemc/bus_character.hpp"
#include "model/systemc/core_module.hpp"

namespace dsdpv1::systemc_bench {

class SegmentModule;

/// Sends; SegmentModule::heard has what is on the line. Its driver is enabled from a start bit to the end of the stop
/// bit, so that two stations at once collide.
class CharacterStation : public dsdpv1::systemc::TimedModule,
                         private bus::Agent,
                         private tlm::tlm_analysis_if<dsdpv1::systemc::BusCharacter> {
 public:
  /// Characters to the line. `start` is now or later, in order of time; the warnings /dsdpv1/bus are those of
  /// TlmModule::bus_in.
  sc_core::sc_export<tlm::tlm_analysis_if<dsdpv1::systemc::BusCharacter>> in{"in"};

  /// `line` must outlive it.
  CharacterStation(const sc_core::sc_module_name& name, SegmentModule& line);

 private:
  void write(const dsdpv1::systemc::BusCharacter& character) override;
  bus::Tick next() const override;
  void run(bus::Tick now) override;

  SegmentModule& line_;
  bus::StationId station_;
  dsdpv1::systemc::CharacterInput input_{*this};
  bool enabled_ = false;
};

}  // namespace dsdpv1::systemc_bench
