// Each code with its message.
#include <functional>
#include <string>

#include "tests/capi/capi.hpp"

namespace dsdpv1::capi_test {
namespace {

void expect(dpsim_status status, const char* name, const std::string& message, dpsim_status wanted) {
  EXPECT_EQ(status, wanted) << message;
  EXPECT_STREQ(dpsim_status_name(status), name);
  EXPECT_EQ(std::string(dpsim_error_message()), message);
}
#define EXPECT_FAILS(call, code, message) expect(call, #code, message, code)

TEST(CapiError, ArgumentsAreNamedWithWhatIsAllowed) {
  const auto chip = make_chip();
  EXPECT_FAILS(dpsim_chip_create(nullptr, nullptr), DPSIM_ERR_ARGUMENT, "dpsim_chip_create: chip is NULL");
  EXPECT_FAILS(dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_L_REQ, 1), DPSIM_ERR_ARGUMENT,
               "dpsim_chip_set: L_REQ is an output");
  EXPECT_FAILS(dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_A, 0x800), DPSIM_ERR_ARGUMENT,
               "dpsim_chip_set: the level of A is 2048, expected 0 to 2047");
  EXPECT_FAILS(dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_D_IN, DPSIM_X), DPSIM_ERR_ARGUMENT,
               "dpsim_chip_set: the level of D_IN is -2, expected 0 to 255 and DPSIM_Z");
  EXPECT_FAILS(dpsim_chip_set(chip.get(), DPSIM_LAST_TICK + 1, 0, 1), DPSIM_ERR_ARGUMENT,
               "dpsim_chip_set: tick is 4611686018427387905, expected 0 to 4611686018427387904");
  uint8_t cell = 0;
  EXPECT_FAILS(dpsim_chip_peek(chip.get(), 0x800, &cell), DPSIM_ERR_ARGUMENT,
               "dpsim_chip_peek: address is 2048, expected 0 to 2047");
  const dpsim_parameter wrong = {"rts_lead", 33};
  auto options = sized<dpsim_chip_options>();
  options.parameters = &wrong;
  options.parameter_count = 1;
  dpsim_chip* made = nullptr;
  EXPECT_FAILS(dpsim_chip_create(&options, &made), DPSIM_ERR_ARGUMENT,
               "dpsim_chip_create: rts_lead is 33, expected 0 to 32");
  EXPECT_EQ(made, nullptr);
}

TEST(CapiError, AStructWithoutItsSizeIsRefused) {
  dpsim_chip_options options{};
  dpsim_chip* chip = nullptr;
  const std::string size = std::to_string(sizeof options);
  EXPECT_FAILS(dpsim_chip_create(&options, &chip), DPSIM_ERR_SIZE,
               "dpsim_chip_create: size of options is 0, expected sizeof, " + size + " here");
  options.size = sizeof options + 8;  // of a later header
  EXPECT_EQ(dpsim_chip_create(&options, &chip), DPSIM_ERR_SIZE);
  dpsim_pin_info info{};
  EXPECT_EQ(dpsim_pin_get(nullptr, 0, &info), DPSIM_ERR_SIZE);
}

TEST(CapiError, WhatThereIsNotIsNotFound) {
  const auto chip = make_chip();
  auto options = sized<dpsim_chip_options>();
  options.kind = "spc9";
  dpsim_chip* made = nullptr;
  EXPECT_FAILS(dpsim_chip_create(&options, &made), DPSIM_ERR_NOT_FOUND,
               "dpsim_chip_create: kind is \"spc9\", expected dsdpv1, dsdpv1_r, dsdpv1_rsu, apc3, spc3, vpc3, xgate");
  EXPECT_FAILS(dpsim_chip_set(chip.get(), 0, 18, 1), DPSIM_ERR_NOT_FOUND,
               "dpsim_chip_set: pin is 18, expected 0 to 17");
  uint16_t pin = 0;
  EXPECT_FAILS(dpsim_pin_find(nullptr, "XINT", &pin), DPSIM_ERR_NOT_FOUND,
               "dpsim_pin_find: the chip has no pin \"XINT\"");
  size_t rule = 0;
  EXPECT_FAILS(dpsim_rule_find(nullptr, "TIMING_TX", &rule), DPSIM_ERR_NOT_FOUND,
               "dpsim_rule_find: there is no rule \"TIMING_TX\"");
}

TEST(CapiError, TimeDoesNotGoBack) {
  const auto chip = make_chip();
  ok(dpsim_chip_advance(chip.get(), 5000));
  EXPECT_FAILS(dpsim_chip_set(chip.get(), 4999, DPSIM_DSDPV1_RESET, 1), DPSIM_ERR_TIME,
               "dpsim_chip_set: tick is 4999, which is before the present tick 5000");
  EXPECT_EQ(dpsim_chip_advance(chip.get(), 4999), DPSIM_ERR_TIME);
  const auto bus = make_bus();
  ok(dpsim_bus_run(bus.get(), 10));
  EXPECT_EQ(dpsim_bus_run(bus.get(), 9), DPSIM_ERR_TIME);
}

TEST(CapiError, AChangeAfterAWrongOneIsNotCarriedOut) {
  const auto chip = make_chip();
  const dpsim_change inputs[] = {{10, 0, DPSIM_DSDPV1_R_REQ, 1, 0}, {5, 0, DPSIM_DSDPV1_R_STA, 1, 0}};
  size_t done = 0;
  EXPECT_EQ(dpsim_chip_set_many(chip.get(), inputs, 2, &done), DPSIM_ERR_TIME);
  EXPECT_EQ(done, 1U);
}

struct InCallback {
  dpsim_chip* chip;
  dpsim_status advance = DPSIM_OK, level = DPSIM_ERR_INTERNAL;
  std::string message = {};
};

TEST(CapiError, InsideOfItsCallbackAChipIsNotRun) {
  const auto chip = make_chip();
  InCallback seen{chip.get()};
  ok(dpsim_chip_watch(
      chip.get(), DPSIM_ALL_PINS,
      [](void* user, const dpsim_change* change) {
        auto& own = *static_cast<InCallback*>(user);
        dpsim_level level = 0;
        own.advance = dpsim_chip_advance(own.chip, change->tick + 1);
        own.message = dpsim_error_message();
        own.level = dpsim_chip_level(own.chip, change->pin, &level);
      },
      &seen));
  ok(dpsim_chip_set(chip.get(), 0, DPSIM_DSDPV1_RESET, 1));
  EXPECT_EQ(seen.advance, DPSIM_ERR_STATE);
  EXPECT_EQ(seen.message,
            "dpsim_chip_advance: called inside of a callback of the same object, where it must not be changed");
  EXPECT_EQ(seen.level, DPSIM_OK);
  ok(dpsim_chip_advance(chip.get(), 1000));
}

TEST(CapiError, BusAndMastersSayWhatTheStateForbids) {
  const auto bus = make_bus();
  dpsim_chip *first = nullptr, *late = nullptr;
  dpsim_master* master = nullptr;
  ok(dpsim_bus_add_chip(bus.get(), nullptr, &first));
  EXPECT_FAILS(dpsim_chip_set(first, 0, DPSIM_DSDPV1_PBRXD, 0), DPSIM_ERR_STATE,
               "dpsim_chip_set: PBRXD of a chip on a bus is the line");
  ok(dpsim_bus_add_master(bus.get(), nullptr, &master));
  EXPECT_FAILS(dpsim_bus_add_chip(bus.get(), nullptr, &late), DPSIM_ERR_STATE,
               "dpsim_bus_add_chip: chips are added before other stations, and before the bus runs or is watched");
  EXPECT_FAILS(dpsim_master_connect(master, 0), DPSIM_ERR_STATE,
               "dpsim_master_connect: the master is of class 1, this is for one of class 2");
  EXPECT_FAILS(dpsim_master_release(master, 5), DPSIM_ERR_NOT_FOUND,
               "dpsim_master_release: the master has no slave with the address 5");
  auto ring = sized<dpsim_ring_status>();
  EXPECT_FAILS(dpsim_master_get_ring(master, &ring), DPSIM_ERR_STATE,
               "dpsim_master_get_ring: the master is alone, it was made without `ring`");
  EXPECT_FAILS(dpsim_bus_drive(bus.get(), 0, 0, 1, 0), DPSIM_ERR_NOT_FOUND,
               "dpsim_bus_drive: station 0 drives the line by itself");
  uint16_t station = 0;
  EXPECT_FAILS(dpsim_chip_station(make_chip().get(), &station), DPSIM_ERR_STATE,
               "dpsim_chip_station: the chip is on no bus");
}

TEST(CapiError, WrongSlavesAreRefusedInTheMastersWords) {
  const auto bus = make_bus();
  dpsim_master* master = nullptr;
  ok(dpsim_bus_add_master(bus.get(), nullptr, &master));
  auto slave = sized<dpsim_slave>();
  EXPECT_FAILS(dpsim_master_add_slave(master, &slave), DPSIM_ERR_ARGUMENT,
               "dpsim_master_add_slave: cfg_size is 0, expected 1 to 244");
  slave.cfg_size = 1;
  slave.address = 127;
  EXPECT_EQ(dpsim_master_add_slave(master, &slave), DPSIM_ERR_ARGUMENT) << dpsim_error_message();
  EXPECT_NE(std::string(dpsim_error_message()).find("127"), std::string::npos) << dpsim_error_message();
}

TEST(CapiError, FilesAreWrongAtTheirLines) {
  auto options = sized<dpsim_run_options>();
  options.path = "none.yaml";
  dpsim_run* run = nullptr;
  EXPECT_EQ(dpsim_run_create(&options, &run), DPSIM_ERR_INPUT);
  EXPECT_EQ(std::string(dpsim_error_message()).rfind("none.yaml: ", 0), 0U) << dpsim_error_message();
  options.text = "name: x\nbaud: 13M\n";
  EXPECT_EQ(dpsim_run_create(&options, &run), DPSIM_ERR_INPUT);
  EXPECT_EQ(std::string(dpsim_error_message()).rfind("none.yaml:2: ", 0), 0U) << dpsim_error_message();
  dpsim_gsd* gsd = nullptr;
  EXPECT_EQ(dpsim_gsd_load("none.gsd", &gsd), DPSIM_ERR_INPUT);
  const std::string text = "#Profibus_DP\nGSD_Revision = x\n";
  EXPECT_EQ(dpsim_gsd_parse(text.data(), text.size(), "bad.gsd", &gsd), DPSIM_ERR_INPUT);
  EXPECT_STREQ(dpsim_error_message(),
               "bad.gsd:1: Ident_Number is missing, Ident_Number = 0x0000 to 0xFFFF is needed\n"
               "bad.gsd:2: GSD_Revision is x, 0 to 255 is allowed");
}

TEST(CapiError, WhatAMessageQuotesIsPrintable) {
  auto options = sized<dpsim_run_options>();
  options.path = "my.yaml";
  options.text = "name: a\n\"b\\n\\x1b[2Jc\": 1\n";
  dpsim_run* run = nullptr;
  EXPECT_EQ(dpsim_run_create(&options, &run), DPSIM_ERR_INPUT);
  const std::string message = dpsim_error_message();
  EXPECT_EQ(message.rfind("my.yaml:2: unknown key b\\n\\x1B[2Jc in scenario", 0), 0U) << message;
}

TEST(CapiError, ABoardIsNotInThisLibrary) {
  for (const std::string name : {"arm_board_12m.yaml", "spc3_arm.yaml"}) {
    const std::string path = std::string(DSDPV1_SOURCE_DIR "/scenarios/") + name;
    auto options = sized<dpsim_run_options>();
    options.path = path.c_str();
    dpsim_run* run = nullptr;
    EXPECT_EQ(dpsim_run_create(&options, &run), DPSIM_ERR_UNSUPPORTED);
    EXPECT_NE(std::string(dpsim_error_message()).find("has an ARM board"), std::string::npos) << dpsim_error_message();
    EXPECT_NE(std::string(dpsim_error_message()).find(name + ":"), std::string::npos);
  }
}

TEST(CapiError, ABufferThatIsTooSmallIsToldTheSize) {
  auto token = sized<dpsim_telegram>();
  token.kind = DPSIM_SD4;
  token.dsap = token.ssap = DPSIM_NO_SAP;
  uint8_t bytes[2] = {};
  size_t count = 0;
  EXPECT_FAILS(dpsim_telegram_encode(&token, bytes, 2, &count), DPSIM_ERR_SPACE,
               "dpsim_telegram_encode: the telegram has 3 bytes, capacity is 2");
  EXPECT_EQ(count, 3U);
}

TEST(CapiError, NamesOfOtherNumbersAreUnknown) {
  EXPECT_STREQ(dpsim_status_name(1), "unknown status");
  EXPECT_STREQ(dpsim_status_name(-11), "unknown status");
  EXPECT_STREQ(dpsim_status_name(DPSIM_OK), "DPSIM_OK");
  EXPECT_STREQ(dpsim_status_name(DPSIM_ERR_INTERNAL), "DPSIM_ERR_INTERNAL");
}

// No pointer may be NULL unless the header says so.
TEST(CapiError, NullIsNoObject) {
  const std::vector<std::function<dpsim_status()>> calls = {
      [] { return dpsim_chip_advance(nullptr, 0); },
      [] { return dpsim_chip_next(nullptr, nullptr); },
      [] { return dpsim_chip_watch(nullptr, 0, nullptr, nullptr); },
      [] { return dpsim_chip_read_changes(nullptr, nullptr, 0, nullptr); },
      [] { return dpsim_chip_get_status(nullptr, nullptr); },
      [] { return dpsim_chip_set_many(nullptr, nullptr, 1, nullptr); },
      [] { return dpsim_bus_run(nullptr, 0); },
      [] { return dpsim_bus_watch(nullptr, 0, nullptr, nullptr); },
      [] { return dpsim_bus_on_event(nullptr, nullptr, nullptr); },
      [] { return dpsim_bus_add_master(nullptr, nullptr, nullptr); },
      [] { return dpsim_master_start(nullptr); },
      [] { return dpsim_master_read(nullptr, 0, 0, 0, 0, nullptr); },
      [] { return dpsim_master_add_slave(nullptr, nullptr); },
      [] { return dpsim_gsd_report(nullptr, nullptr, 0, 0, nullptr); },
      [] { return dpsim_checker_pin(nullptr, 0, 0, 0); },
      [] { return dpsim_checker_finish(nullptr, 0); },
      [] { return dpsim_scoreboard_create(nullptr, nullptr, nullptr); },
      [] { return dpsim_scoreboard_compare(nullptr, nullptr, 0, 0, nullptr); },
      [] { return dpsim_run_execute(nullptr, nullptr, nullptr); },
      [] { return dpsim_run_result(nullptr, nullptr); },
      [] { return dpsim_telegram_decode(nullptr, 1, nullptr, nullptr, nullptr); },
  };
  for (std::size_t i = 0; i < calls.size(); ++i) {
    EXPECT_EQ(calls[i](), DPSIM_ERR_ARGUMENT) << i;
    EXPECT_NE(std::string(dpsim_error_message()).find(" is NULL"), std::string::npos) << dpsim_error_message();
  }
  dpsim_chip_destroy(nullptr);
  dpsim_bus_destroy(nullptr);
  dpsim_checker_destroy(nullptr);
  dpsim_scoreboard_destroy(nullptr);
  dpsim_gsd_destroy(nullptr);
  dpsim_run_destroy(nullptr);
}

}  // namespace
}  // namespace dsdpv1::capi_test
