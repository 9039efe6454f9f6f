// scenarios/xgate.gsd, the module's own file, as a master reads it and as the module takes it.
#include <fstream>

#include "bus/gsd/setup.hpp"
#include "tests/xgate/module_bench.hpp"

namespace dsdpv1::xgate {
namespace {

bus::GsdResult read_file() {
  std::ifstream in(XGATE_GSD);
  return bus::parse_gsd(in, XGATE_GSD);
}
bus::Gsd module_file() { return read_file().gsd.value(); }

/// Command 04 of a host whose configuration is that of the master, with the greatest lengths that the file declares.
Bytes initialisation(const bus::Gsd& gsd, const bus::GsdSetup& setup) {
  const auto byte = [](auto value) { return static_cast<std::uint8_t>(value); };
  const std::size_t prm = setup.user_prm.size() == 3 ? 0 : setup.user_prm.size();
  const Bytes head = {kSlave,
                      byte(gsd.ident & 0xFF),
                      byte(gsd.ident >> 8),
                      byte(setup.chk_cfg.size()),
                      byte(setup.lengths.input),
                      byte(setup.lengths.output),
                      byte(prm)};
  const Bytes dpv1 = {
      1, 0, 0, 0, 0, 0, 10, byte(gsd.c1_max_data.value()), byte(gsd.c2_max_data.value()), 0x82, gsd.alarms.types, 5};
  return head + dpv1 + setup.chk_cfg;
}

TEST(XgateGsd, DeclaresWhatTheModuleHas) {
  const bus::GsdResult result = read_file();
  for (const bus::GsdDiagnostic& remark : result.diagnostics) ADD_FAILURE() << to_string(remark);
  const bus::Gsd gsd = result.gsd.value();
  EXPECT_EQ(gsd.ident, 0x0F01);  // X28
  EXPECT_TRUE(gsd.freeze && gsd.sync && gsd.fail_safe && gsd.auto_baud && gsd.wd_base_1ms && gsd.modular);
  EXPECT_FALSE(gsd.set_slave_add);  // X1
  EXPECT_TRUE(gsd.dpv1 && gsd.c1_read_write && gsd.c2_read_write);
  EXPECT_EQ(gsd.c2_channels, profibus::kC2Channels);
  EXPECT_EQ(gsd.alarms.types, 0xFC);  // 4.2.2: bits 7 to 2
  EXPECT_EQ(gsd.alarms.sequence_count, profibus::Alarms::kMost);
  EXPECT_TRUE(gsd.alarms.type_mode && gsd.alarms.extra_sap);
  EXPECT_EQ(gsd.max_input, profibus::kMaxIo);
  EXPECT_EQ(gsd.max_output, profibus::kMaxIo);
  for (int i = 0; i < bus::kBaudCount; ++i)
    EXPECT_EQ(gsd.bauds.at(static_cast<std::size_t>(i)).max_tsdr, bus::baud(i).max_tsdr_bits) << bus::gsd_baud_name(i);
}

TEST(XgateGsd, TheModuleTakesEachOfItsModules) {
  const bus::Gsd gsd = module_file();
  ModuleBench bench;
  for (const bus::GsdModule& module : gsd.modules) {
    const bus::GsdSetup setup = bus::set_up(gsd, {{module.name}, {}});
    ASSERT_TRUE(setup.ok()) << module.name;
    EXPECT_EQ(bench.ask(0x04, initialisation(gsd, setup)), frame(0x04, {})) << module.name;
  }
}

TEST(XgateGsd, AMasterWithTheFileReachesDataExchange) {
  const bus::Gsd gsd = module_file();
  const bus::GsdSetup setup =
      bus::set_up(gsd, {{"4 bytes in, 4 bytes out, with parameters", "25 bytes in, 5 bytes out, as 4.8.4"},
                        {{std::nullopt, "DPV1_Enable", "on"}}});
  ASSERT_TRUE(setup.ok());
  ModuleBench bench;
  ASSERT_EQ(bench.ask(0x04, initialisation(gsd, setup)), frame(0x04, {}));
  bench.diagnosis();
  bench.set_prm(setup.user_prm);
  bench.service(62, setup.chk_cfg);
  ASSERT_TRUE(bench.exchanging());
  EXPECT_EQ(bench.ask(0x22), frame(0x22, {0x80, 0, 0, 0xAA, 0x55}));
  const Bytes outputs(static_cast<std::size_t>(setup.lengths.output), 0x5A);
  bench.service(-1, outputs);
  EXPECT_EQ(bench.ask(0x21, Bytes(29, 0xA5)), frame(0x21, outputs));
  EXPECT_EQ(bench.service(-1, outputs), Bytes(29, 0xA5));
}

}  // namespace
}  // namespace dsdpv1::xgate
