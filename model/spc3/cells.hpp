#pragma once
// Addresses of the map (Intel order) and bits of its registers (M tables 3.2 to 4.6).
#include <cstdint>

namespace dsdpv1::spc3 {

using Address = std::uint16_t;

namespace regs {
// Read side.
constexpr Address kIrr = 0x00, kIr = 0x02, kStatus = 0x04, kDinSm = 0x08, kNewDin = 0x09, kDoutSm = 0x0A,
                  kNextDout = 0x0B, kDiagSm = 0x0C, kNewDiag = 0x0D, kPrmOk = 0x0E, kPrmNotOk = 0x0F, kCfgOk = 0x10,
                  kCfgNotOk = 0x11, kSsaFree = 0x14, kMode1 = 0x15;
// Write side; IRR is on both.
constexpr Address kIar = 0x02, kImr = 0x04, kMode0 = 0x06, kMode1Set = 0x08, kMode1Clear = 0x09, kWdBaudControl = 0x0A,
                  kMinTsdr = 0x0B, kMode2 = 0x0C, kMode3 = 0x12;
// Organisation: RAM on both sides.
constexpr Address kOrganisation = 0x16, kTsAdr = 0x16, kUserWd = 0x18, kLenDout = 0x1A, kDoutPtr = 0x1B, kLenDin = 0x1E,
                  kDinPtr = 0x1F, kLenDiag = 0x24, kDiagPtr = 0x26, kLenAux = 0x28, kAuxSel = 0x2A, kAuxPtr = 0x2B,
                  kLenSsa = 0x2D, kSsaPtr = 0x2E, kLenPrm = 0x2F, kPrmPtr = 0x30, kLenCfg = 0x31, kCfgPtr = 0x32,
                  kLenReadCfg = 0x33, kReadCfgPtr = 0x34, kNoAddChange = 0x39, kIdentLow = 0x3A, kIdentHigh = 0x3B,
                  kControl = 0x3C, kLenSpecPrm = 0x3D, kBuffers = 0x40;
}  // namespace regs

/// Bits of IRR, IR, IMR and IAR.
namespace event {
constexpr std::uint16_t kMacReset = 1U << 0, kGoLeaveDataEx = 1U << 1, kBaudDetect = 1U << 2, kWdTimeout = 1U << 3,
                        kUserTimer = 1U << 4, kNewControl = 1U << 8, kNewSsa = 1U << 9, kNewCfg = 1U << 10,
                        kNewPrm = 1U << 11, kDiagChanged = 1U << 12, kDxOut = 1U << 13;
}

namespace mode0 {
constexpr std::uint16_t kCombi = 1U << 3, kIntPol = 1U << 4, kSync = 1U << 6, kFreeze = 1U << 7, kDpMode = 1U << 8,
                        kEoiTimeBase = 1U << 9, kUserTimeBase = 1U << 10, kSpecPrmBuf = 1U << 12, kSpecClear = 1U << 13;
}
namespace mode1 {
constexpr std::uint8_t kStart = 1U << 0, kEoi = 1U << 1, kGoOffline = 1U << 2, kUserLeaveMaster = 1U << 3,
                       kEnChangeCfg = 1U << 4, kResUserWd = 1U << 5,
                       kStored = 1U << 7;  ///< vpc3: without effect
}
namespace mode2 {
constexpr std::uint8_t kEachControl = 1U << 0, kAnyControl = 1U << 1, kDxOutAlways = 1U << 2, kAnyPrm = 1U << 6,
                       k4KB = 1U << 7;
}

/// An answer to 0EH to 11H.
namespace verdict {
constexpr std::uint8_t kFinished = 0, kConflict = 1, kNotAllowed = 3;
}

}  // namespace dsdpv1::spc3
