#pragma once
// The object for the header's handle of a master, of either class, and its events.
#include <cstdint>
#include <memory>

#include "bus/master/master1.hpp"
#include "bus/master/master2.hpp"
#include "capi/bus.hpp"
#include "capi/names.hpp"
#include "dsdpv1/master.h"

struct dpsim_master {
  /// Attaches to the bus, after all of its chips.
  dpsim_master(dpsim_bus& its_bus, int master_class, const bus::MasterConfig& config);
  /// For a master created and owned elsewhere, which is the segment's station `id`.
  dpsim_master(dpsim_bus& its_bus, bus::StationId id, std::uint8_t its_address, bus::Master1& own);
  dpsim_master(dpsim_bus& its_bus, bus::StationId id, std::uint8_t its_address, bus::Master2& own);

  bool running() const { return class_1 != nullptr ? class_1->running() : class_2->running(); }
  int baud() const { return class_1 != nullptr ? class_1->baud() : class_2->baud(); }
  const bus::TokenRing* ring() const { return class_1 != nullptr ? class_1->ring() : &class_2->ring(); }
  std::uint32_t next_id() { return ++last_id; }
  /// An event of this master, at `at`.
  dpsim_event event(dpsim_event_type type, bus::Tick at) const;

  dpsim_bus& bus;
  const std::uint16_t station;
  const std::uint8_t address;
  bus::Master1* class_1 = nullptr;  ///< either this one is set
  bus::Master2* class_2 = nullptr;  ///< ... or this one
  std::uint32_t last_id = 0;

 private:
  dpsim_master(dpsim_bus& its_bus, std::uint8_t its_address);
  void add(bus::StationId id, bus::Master1& own);
  void add(bus::StationId id, bus::Master2& own);

  std::unique_ptr<bus::Master1> own_1_;
  std::unique_ptr<bus::Master2> own_2_;
};

namespace dsdpv1::capi {

/// The master as one of class 1; throws for class 2.
bus::Master1& class_1_of(dpsim_master* master);
const bus::Master1& class_1_of(const dpsim_master* master);
bus::Master2& class_2_of(dpsim_master* master);
const bus::Master2& class_2_of(const dpsim_master* master);
/// Throws if the master has no such slave.
void need_slave(const bus::Master1& master, std::uint8_t address);
/// Throws if the master has no such connection.
void need_connection(const bus::Master2& master, std::uint32_t connection);

void connect(dpsim_master& master, bus::Master1& own);
void connect(dpsim_master& master, bus::Master2& own);
void connect(dpsim_master& master, bus::TokenRing& ring);

bus::Bytes bytes_of(const std::uint8_t* data, std::size_t count);
/// Reports the end of an acyclic request under `id`.
bus::AcyclicCallback acyclic_done(dpsim_master& master, std::uint32_t id, std::uint8_t address);

/// DS_Read and the like, to a slave or a connection.
void acyclic(dpsim_master* master, std::uint32_t peer, const bus::AcyclicRequest& request, std::uint32_t* id);

/// The body of a request: runs `begin(id)` and returns the id to the caller.
template <class Begin>
void numbered(dpsim_master& master, std::uint32_t* id, const Begin& begin) {
  const std::uint32_t number = master.next_id();
  begin(number);
  if (id != nullptr) *id = number;
}

}  // namespace dsdpv1::capi
