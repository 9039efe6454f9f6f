// Keys of DPV1 at the user CPU: its objects by slot and index, I&M0, its answers.
#include "tb/scenario/describe.hpp"

namespace dsdpv1::tb::scenario {
namespace {

const ObjectOf<Dpv1Object>& object_keys() {
  static const ObjectOf<Dpv1Object> keys = [] {
    using D = Dpv1Object;
    const Range byte = {0, 255};
    ObjectOf<D> o("object", "Data of the user CPU that masters read and write by slot and index.");
    o.integer("slot", &D::slot, {0, 254}, "", "Slot number.").required = true;
    o.integer("index", &D::index, byte, "", "Index; slot 0 index 255 belongs to I&M if `im0` is given.").required =
        true;
    o.bytes("data", &D::data, {0, 240}, "First content; its length is the greatest length of the object.");
    o.integer("min_length", &D::min_length, {0, 240}, "bytes", "Least length of a request.");
    o.boolean("read", &D::read, "DS_Read is allowed.");
    o.boolean("write", &D::write, "DS_Write is allowed; it replaces the first bytes.");
    o.boolean("transport", &D::transport,
              "DS_Transport is allowed; it replaces the first bytes and is answered with the earlier ones.");
    o.word("classes", &D::classes,
           std::vector<WordFor<std::uint8_t>>{{user_cpu::kBothClasses, "both", ""},
                                              {user_cpu::kClass1, "class_1", "only the master of class 1, on C1"},
                                              {user_cpu::kClass2, "class_2", "only masters of class 2, on C2"}},
           "Masters that may use it.");
    return o;
  }();
  return keys;
}

const ObjectOf<Im0>& im0_keys() {
  static const ObjectOf<Im0> keys = [] {
    const Range word = {0, 0xFFFF};
    ObjectOf<Im0> o("im0", "The electronic nameplate, I&M0: slot 0, index 255, call header 08 00 FD E8.");
    o.integer("manufacturer_id", &Im0::manufacturer_id, word, "", "Given by the PROFIBUS organisation.");
    o.text("order_id", &Im0::order_id, "Order number.", 20);
    o.text("serial_number", &Im0::serial_number, "Serial number.", 16);
    o.integer("hardware_revision", &Im0::hardware_revision, word, "", "Hardware revision.");
    o.bytes("software_revision", &Im0::software_revision, {3, 3}, "Software revision, three bytes.");
    o.integer("profile_id", &Im0::profile_id, word, "", "Profile; 0xF600 is a generic device.");
    return o;
  }();
  return keys;
}

}  // namespace

const std::vector<WordFor<Answering>>& answering_words() {
  static const std::vector<WordFor<Answering>> words = {
      {Answering::kNormal, "normal", "as the objects allow"},
      {Answering::kRefuse, "refuse", "with error_code_1 and error_code_2"},
      {Answering::kNever, "never", "not at all"}};
  return words;
}

const ObjectOf<Dpv1User>& dpv1_keys() {
  static const ObjectOf<Dpv1User> keys = [] {
    using D = Dpv1User;
    ObjectOf<D> o("dpv1", "The user CPU's handling of acyclic requests; `init: {dpv1: true}` switches DPV1 on.");
    o.list("objects", &D::objects, object_keys(), {0, 100}, "Its objects by slot and index.");
    o.object("im0", &D::im0, im0_keys(), "Identification & Maintenance data.");
    o.word("answering", &D::answering, answering_words(), "Its answers to requests to its objects.");
    o.time("delay", &D::delay, {0, 100 * bus::kTicksPerSecond}, "From the poll that finds a request to the answer.");
    o.integer("error_code_1", &D::error_code_1, {0, 255}, "", "Error_Code_1 of refusals (table 29).");
    o.integer("error_code_2", &D::error_code_2, {0, 255}, "", "Error_Code_2 of refusals.");
    return o;
  }();
  return keys;
}

}  // namespace dsdpv1::tb::scenario
