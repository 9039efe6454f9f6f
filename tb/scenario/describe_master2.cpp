// Keys of a class 2 master and its connections.
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

const ObjectOf<Connection>& connection_keys() {
  static const ObjectOf<Connection> keys = [] {
    using C = Connection;
    ObjectOf<C> o("connection", "A C2 connection (MSAC_C2) that the script opens with `c2_connect`.");
    o.name_of("name", &C::name, "Name of the connection in the log, the script and the expectations.").required = true;
    o.name_of("slave", &C::slave, "Name of the scenario's slave.");
    o.integer("address", &C::address, kAddresses, "", "Station address; needed if no slave is named.");
    o.integer("send_timeout", &C::send_timeout, {0, 0xFFFF}, "10 ms",
              "Send_Timeout of Initiate: F and U timer, half of the I timer.");
    o.bytes("add_addr", &C::add_addr, {0, 232}, "Add_Addr of Initiate: two APIs, or types, lengths and addresses.");
    o.time("poll_interval", &C::poll_interval, kAnyTime, "Least time between two polls; 0ns: at every token.");
    o.exactly_one = {{"slave", "address"}};
    return o;
  }();
  return keys;
}

}  // namespace

const std::vector<WordFor<bus::ConnectionState>>& connection_state_words() {
  using S = bus::ConnectionState;
  static const std::vector<WordFor<S>> words = {{S::kClosed, "closed", ""},
                                                {S::kInitiating, "initiating", "waits for the immediate answer"},
                                                {S::kConnecting, "connecting", "waits for the initiate answer"},
                                                {S::kOpen, "open", "connected, no request open"},
                                                {S::kBusy, "busy", "a request or Idle open"},
                                                {S::kAborting, "aborting", ""}};
  return words;
}

const ObjectOf<Master2>& master2_keys() {
  static const ObjectOf<Master2> keys = [] {
    ObjectOf<Master2> o("master2", "A DP master class 2. It is part of a token ring with the other masters.");
    o.name_of("name", &Master2::name, "Name of the master in the log and the script.").required = true;
    o.integer("address", &Master2::address, {0, 125}, "", "Station address.");
    o.time("start", &Master2::start, kAnyTime, "Time at which it begins to listen to the bus.");
    o.object("bus", &Master2::bus, bus_keys(), "Bus parameters other than those of the baud rate.");
    o.list("connections", &Master2::connections, connection_keys(), {0, 32}, "Its connections.");
    return o;
  }();
  return keys;
}

}  // namespace dsdpv1::tb::scenario
