// Keys of a master and of the slaves that it brings up.
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {

const ObjectOf<BusParameters>& bus_keys() {
  static const ObjectOf<BusParameters> keys = [] {
    using B = BusParameters;
    ObjectOf<B> o("bus", "Bus parameters of a master.");
    o.integer("slot_time", &B::slot_time, {37, 16383}, "bit times",
              "T_SL (default: EN 50170's value for the baud rate, 100 ... 1000).");
    o.integer("setup_time", &B::setup_time, {1, 255}, "bit times", "T_SET (default: that of the baud rate).");
    o.integer("quiet_time", &B::quiet_time, {0, 255}, "bit times", "T_QUI (default: that of the baud rate).");
    o.integer("retries", &B::retries, {0, 8}, "",
              "Repetitions of an unanswered request (default: 1; at 3, 6 and 12 Mbit/s 2, 3 and 4).");
    o.integer("gap_factor", &B::gap_factor, {0, 100}, "cycles",
              "Data cycles between two FDL status polls for the live list, 0 for none.");
    o.integer("highest_address", &B::highest_address, {1, 126}, "", "HSA, the last address of the live list.");
    o.integer("min_slave_interval", &B::min_slave_interval, {0, 1000000}, "us",
              "Least time from the start of one data cycle to the next; 0: as fast as the bus allows (default: the "
              "greatest Min_Slave_Intervall in the GSD files of its slaves).");
    o.boolean("token", &B::token, "true: passes the token (to itself) after each cycle, as a single master does.");
    o.boolean("ring", &B::ring,
              "true: the master shares the token with others. It learns the active stations, enters by the GAP poll "
              "and passes the token on. Masters of class 2 always do.");
    o.integer("target_rotation", &B::target_rotation, {256, 16777215}, "bit times",
              "T_TR: target time of a token rotation, in a ring.");
    o.integer("clock_error", &B::clock_error, {-20000, 20000}, "ppm",
              "Error of the master's bit clock; positive is slow.");
    return o;
  }();
  return keys;
}

namespace {

const ObjectOf<MasterAlarms>& master_alarm_keys() {
  static const ObjectOf<MasterAlarms> keys = [] {
    using A = MasterAlarms;
    ObjectOf<A> o("master alarms", "Alarms of DPV1 that the master enables in Set_Prm (DPV1_Status_2 and 3).");
    o.boolean("pull_plug", &A::pull_plug, "Pull and plug alarms.");
    o.boolean("process", &A::process, "Process alarms.");
    o.boolean("diagnostic", &A::diagnostic, "Diagnostic alarms.");
    o.boolean("manufacturer", &A::manufacturer, "Alarms of the manufacturer's types 32 to 126.");
    o.boolean("status", &A::status, "Status alarms.");
    o.boolean("update", &A::update, "Update alarms.");
    o.integer("mode", &A::mode, {0, 7}, "",
              "Alarm_Mode: 0: one alarm of each type at a time; 1 to 7: 2, 4, 8, 12, 16, 24, 32 in all.");
    o.boolean("extra_sap", &A::extra_sap, "true: acknowledges at SAP 50, false: at SAP 51, after reads and writes.");
    o.boolean("acknowledge", &A::acknowledge, "false: never acknowledges, to test the slave's limits.");
    return o;
  }();
  return keys;
}

const ObjectOf<MasterSlave>& master_slave_keys() {
  static const ObjectOf<MasterSlave> keys = [] {
    using S = MasterSlave;
    ObjectOf<S> o("master slave", "A slave from its master's view: its address, and the data sent to it.");
    o.name_of("slave", &S::slave,
              "Name of the scenario's slave: its address, GSD and modules are taken unless given here.");
    o.integer("address", &S::address, kAddresses, "", "Station address; needed if no slave is named.");
    o.file("gsd", &S::gsd, "GSD file for ident, Set_Prm and Chk_Cfg, relative to the scenario's folder.");
    o.names("modules", &S::modules, {0, 64}, "Names of the GSD's modules, in the order of the slots.");
    o.bytes("user_prm", &S::user_prm, {0, 237},
            "User parameters (after the seven standard bytes) instead of those of the GSD.");
    o.bytes("cfg", &S::cfg, {1, 244}, "Configuration bytes instead of those of the GSD's modules.");
    o.integer("ident", &S::ident, {0, 0xFFFF}, "", "Ident number instead of that of the GSD.");
    o.time("watchdog", &S::watchdog, {0, 650 * bus::kTicksPerSecond},
           "Watchdog time of Set_Prm, rounded up to a possible WD_Fact_1 x WD_Fact_2; 0ns: off.");
    o.integer("min_tsdr", &S::min_tsdr, {0, 255}, "bit times", "min_TSDR of Set_Prm; 0 leaves the slave's unchanged.");
    o.bytes("groups", &S::groups, {0, 8}, "Group numbers 1 to 8 that the slave belongs to (Group_Ident).");
    o.boolean("sync", &S::sync, "Sync_Req of Set_Prm.");
    o.boolean("freeze", &S::freeze, "Freeze_Req of Set_Prm.");
    o.boolean("fail_safe", &S::fail_safe, "Fail_Safe of the first DPV1 byte of Set_Prm.");
    o.boolean("dpv1", &S::dpv1, "DPV1_Enable of the first DPV1 byte of Set_Prm.");
    o.object("alarms", &S::alarms, master_alarm_keys(),
             "Alarms that the master enables and acknowledges; needs `dpv1`.");
    o.bytes_or("outputs", &S::outputs, {0, 244},
               std::vector<WordFor<bus::OutputPattern>>{
                   {bus::OutputPattern::kCount, "count", "each byte is the number of the data exchange"},
                   {bus::OutputPattern::kRandom, "random", "other bytes in each data exchange"}},
               &S::pattern,
               "First outputs, filled up with 0 (default: all 0). `set_outputs` of the script ends the words.");
    o.integer("seed", &S::seed, {1, 0x7FFFFFFE}, "", "Of `outputs: random`.");
    o.at_least_one = {{"slave", "address"}};
    return o;
  }();
  return keys;
}

}  // namespace

const ObjectOf<Master>& master_keys() {
  static const ObjectOf<Master> keys = [] {
    ObjectOf<Master> o("master", "A DP master class 1.");
    o.name_of("name", &Master::name, "Name of the master in the log and the script.").required = true;
    o.integer("address", &Master::address, {0, 125}, "", "Station address.");
    o.word("personality", &Master::personality,
           std::vector<WordFor<Personality>>{
               {Personality::kHighAlways, "high_always",
                "SRD high for everything, SD3 if 8 bytes fit, min_TSDR 0 possible"},
               {Personality::kClassic, "classic",
                "SRD low for diagnosis, parameters and configuration, a Global_Control before Set_Prm"}},
           "Its habits, after real masters.");
    o.time("start", &Master::start, kAnyTime, "Time at which it enters the bus.");
    o.boolean("operate", &Master::operate,
              "true: goes to Operate automatically; false: stays in Clear until the script says `operate`.");
    o.object("bus", &Master::bus, bus_keys(), "Bus parameters other than those of the baud rate.");
    o.list("slaves", &Master::slaves, master_slave_keys(), {0, 125}, "The slaves that it brings up.");
    return o;
  }();
  return keys;
}

}  // namespace dsdpv1::tb::scenario
