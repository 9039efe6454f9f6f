"""GSD files of a generator over the keywords of revisions 1 to 5, with values at their limits.

Each file's Set_Prm and Chk_Cfg, as `dsdpv1-sim gsd FILE --json` makes them, is held byte by byte against the bytes that
this program lays down itself.

    generated_test.py DSDPV1-SIM [--files 100] [--seed 1] [--keep FOLDER]
"""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

FLAG, U8, U16, U32 = (0, 1), (0, 0xFF), (0, 0xFFFF), (0, 0xFFFFFFFF)
RATES = "9.6 19.2 31.25 45.45 93.75 187.5 500 1.5M 3M 6M 12M".split()
# Revision, keyword, limits. Those that a station's bytes depend on are written by Station.
KEYWORDS = [(0, "Protocol_Ident", U8), (0, "FMS_supp", FLAG), (0, "Redundancy", FLAG), (0, "Repeater_Ctrl_Sig", (0, 2)),
            (0, "24V_Pins", (0, 2)), (0, "Freeze_Mode_supp", FLAG), (0, "Sync_Mode_supp", FLAG),
            (0, "Auto_Baud_supp", FLAG), (0, "Set_Slave_Add_supp", FLAG), (0, "Min_Slave_Intervall", U16),
            (0, "Max_Diag_Data_Len", (6, 244)), (1, "Fail_Safe", FLAG), (1, "Diag_Update_Delay", U16),
            (2, "Fail_Safe_required", FLAG), (2, "Revision_Number", (0, 63)), (2, "Max_iParameter_Size", U32)]
KEYWORDS += [(3, name, FLAG) for name in
             "C1_Read_Write_supp C1_Read_Write_required C2_Read_Write_supp C2_Read_Write_required WD_Base_1ms_supp "
             "Check_Cfg_Mode Publisher_supp Extra_Alarm_SAP_supp Alarm_Type_Mode_supp DPV1_Data_Types".split()]
KEYWORDS += [(3, f"{alarm}_Alarm_{kind}", FLAG) for kind in ("supp", "required") for alarm in
             "Diagnostic Process Pull_Plug Status Update Manufacturer_Specific".split()]
KEYWORDS += [(3, "C1_Max_Data_Len", (0, 240)), (3, "C2_Max_Data_Len", (0, 240)), (3, "C1_Response_Timeout", U16),
             (3, "C2_Response_Timeout", U16), (3, "C2_Max_Count_Channels", (0, 49)), (3, "Max_Initiate_PDU_Length", U8),
             (3, "Alarm_Sequence_Mode_Count", (0, 32))]
KEYWORDS += [(4, name, FLAG) for name in "Subscriber_supp DXB_supp Isochron_Mode_supp Isochron_Mode_required "
             "X_Prm_SAP_supp Time_Sync_supp Prm_Block_Structure_supp Prm_Block_Structure_req PrmCmd_supp".split()]
KEYWORDS += [(4, "Max_Count_Publisher", U8), (4, "DXB_Max_Link_Count", (0, 125)), (4, "DXB_Max_Data_Length", (0, 244)),
             (4, "TBASE_DP", U32), (4, "TDP_MIN", U16), (4, "TDP_MAX", U32), (4, "T_PLL_W_MAX", U16),
             (4, "TBASE_IO", U32), (4, "TI_MIN", U16), (4, "TO_MIN", U16), (4, "Slave_Redundancy_supp", U8),
             (5, "Ident_Maintenance_supp", FLAG), (5, "Jokerblock_supp", FLAG), (5, "Slave_Max_Switch_Over_Time", U16)]
TYPES = {"Unsigned8": (1, 0, 0xFF), "Unsigned16": (2, 0, 0xFFFF), "Unsigned32": (4, 0, 0xFFFFFFFF),
         "Signed8": (1, -0x80, 0x7F), "Signed16": (2, -0x8000, 0x7FFF), "Signed32": (4, -0x80000000, 0x7FFFFFFF)}


class Parameter:
    """An ExtUserPrmData whose default is at a limit of its type or of its own range."""

    def __init__(self, number, dice, revision):
        self.number, self.bits, self.slot = number, None, revision >= 5 and dice.random() < 0.2
        kind = "Unsigned8" if self.slot else dice.choice(list(TYPES) + ["Bit", "BitArea"])
        if kind in TYPES:
            self.size, low, high = TYPES[kind]
            word = kind
        else:
            first = dice.randint(0, 7)
            last = first if kind == "Bit" else dice.randint(first, 7)
            self.size, self.bits, low, high = 1, (first, last), 0, (1 << (last - first + 1)) - 1
            word = f"Bit({first})" if kind == "Bit" else f"BitArea({first}-{last})"
        self.default = dice.choice([low, high])
        allowed = dice.choice(["", f" {low}-{high}", f" {self.default},{self.default}"])
        self.text = (f'ExtUserPrmData = {number} "{"[SlotNumber]" if self.slot else f"parameter {number}"}"\n'
                     f"{word} {self.default}{'' if self.slot else allowed}\nEndExtUserPrmData\n")

    def lay(self, data, at, slot):
        value = slot if self.slot and slot is not None else self.default
        if self.bits is None:
            data[at:at + self.size] = (value & (1 << 8 * self.size) - 1).to_bytes(self.size, "big")
            return
        for bit in range(self.bits[0], self.bits[1] + 1):
            data[at] = data[at] & ~(1 << bit) | (value >> (bit - self.bits[0]) & 1) << bit


class Block:
    """User parameters of a station or of a module: constants, and parameters over them."""

    def __init__(self, dice, parameters, length, prefix=""):
        self.length = length
        self.constants, self.refs = [], []
        while dice.random() < 0.7 and length:
            at = dice.randrange(length)
            self.constants.append((at, bytes(dice.choice([0, 255, 0xA5]) for _ in range(dice.randint(1, length - at)))))
        for parameter in dice.sample(parameters, min(len(parameters), 3)):
            if parameter.size <= length:
                self.refs.append((dice.randint(0, length - parameter.size), parameter))
        self.text = "".join(f"{prefix}Ext_User_Prm_Data_Const({at}) = {', '.join(map(str, data))}\n"
                            for at, data in self.constants)
        self.text += "".join(f"{prefix}Ext_User_Prm_Data_Ref({at}) = {p.number}\n" for at, p in self.refs)

    def bytes(self, slot=None, whole=True):
        """A module's block has its length; the station's ends with its last byte."""
        used = [at + len(data) for at, data in self.constants] + [at + p.size for at, p in self.refs]
        result = bytearray(self.length if whole else max(used, default=0))
        for at, data in self.constants:
            result[at:at + len(data)] = data
        for at, parameter in self.refs:
            parameter.lay(result, at, slot)
        return bytes(result)


def identifiers(dice):
    """Bytes of a Chk_Cfg, and the bytes of input and output that they stand for."""
    words, consistent = dice.choice([0, 1]), dice.choice([0, 0x80])
    if dice.random() < 0.5:
        way, length = dice.choice([(1, 0), (0, 1), (1, 1)]), dice.choice([1, 2])
        first = (way[0] * 0x10 | way[1] * 0x20 | words * 0x40 | consistent | length - 1)
        return bytes([first]), way[0] * length * (1 + words), way[1] * length * (1 + words)
    way, vendor, length = dice.choice([(1, 0), (0, 1), (1, 1), (0, 0)]), dice.choice([0, 1, 14]), dice.choice([1, 3])
    head = way[0] * 0x40 | way[1] * 0x80 | vendor
    counts = bytes([consistent | words * 0x40 | length - 1]) * sum(way)
    extra = bytes(dice.choice([0, 0xFF]) for _ in range(vendor))
    return bytes([head]) + counts + extra, way[0] * length * (1 + words), way[1] * length * (1 + words)


class Module:
    def __init__(self, number, dice, parameters, revision):
        self.name = f"module {number}"
        self.cfg, self.input, self.output = identifiers(dice)
        self.prm = Block(dice, parameters if revision else [], dice.choice([0, 1, 4, 9]) if revision else 0)
        safe = revision >= 4 and dice.random() < 0.3
        self.f_prm = Block(dice, [p for p in parameters if not p.slot], 14 if safe else 0, "F_")
        self.preset = dice.random() < 0.4
        self.text = f'Module = "{self.name}" {", ".join(f"0x{b:02X}" for b in self.cfg)}\n'
        self.text += f"{number}\n" if revision >= 3 else ""
        self.text += "Preset = 1\n" if self.preset else ""
        self.text += f"Ext_Module_Prm_Data_Len = {self.prm.length}\n{self.prm.text}" if revision else ""
        self.text += f"F_Ext_Module_Prm_Data_Len = 14\n{self.f_prm.text}" if safe else ""
        self.text += "EndModule\n"


class Station:
    """One GSD file, a choice of its modules and the bytes of a master."""

    def __init__(self, seed):
        dice = random.Random(seed)
        self.revision, self.ident = seed % 6, dice.choice(U16)
        parameters = [Parameter(n + 1, dice, self.revision) for n in range(dice.randint(1, 12))]
        self.prm = Block(dice, [p for p in parameters if not p.slot], dice.choice([0, 3, 40]))
        self.modules = [Module(n + 1, dice, parameters, self.revision) for n in range(dice.randint(1, 6))]
        self.fixed = dice.random() < 0.4
        self.choice = [dice.choice(self.modules) for _ in range(dice.randint(1, 6))]
        self.offset = dice.choice([None, 0, 1, 9])
        self.slots = [dice.randint(0, 255) for _ in range(14)] if self.revision >= 3 and dice.random() < 0.3 else []
        self.old_prm = bytes(dice.choice(U8) for _ in range(dice.randint(1, 30)))
        self.text = self.write(dice, parameters)

    def plugged(self):
        presets = [m for m in self.modules if m.preset] if self.fixed else []
        rest = list(self.choice)
        for preset in presets:
            if preset in rest:
                rest.remove(preset)
        return presets + rest

    def slot(self, position):
        return self.slots[position] if self.slots else (1 if self.offset is None else self.offset) + position

    def user_prm(self):
        station = self.old_prm if self.revision == 0 else self.prm.bytes(whole=False)
        plugged = self.plugged()
        own = b"".join(m.prm.bytes(self.slot(i)) for i, m in enumerate(plugged))
        return station + own + b"".join(m.f_prm.bytes() for m in plugged)

    def telegrams(self):
        head = bytes([0x88, 10, 10, 11]) + self.ident.to_bytes(2, "big") + b"\0"
        plugged = self.plugged()
        return {"modules": [m.name for m in plugged], "set_prm": head + self.user_prm(),
                "chk_cfg": b"".join(m.cfg for m in plugged), "input_bytes": sum(m.input for m in plugged),
                "output_bytes": sum(m.output for m in plugged)}

    def write(self, dice, parameters):
        made = self.telegrams()
        lines = [f'Vendor_Name = "{"v" * 32}"', f'Model_Name = "{"m" * 32}"', f"Ident_Number = 0x{self.ident:04X}",
                 "Station_Type = 0", "Modular_Station = 1", f"Max_Module = {dice.choice([len(self.plugged()), 255])}"]
        lines += [f"GSD_Revision = {self.revision}"] if self.revision else []
        lines += [f"Max_Input_Len = {dice.choice([made['input_bytes'], 244])}",
                  f"Max_Output_Len = {dice.choice([made['output_bytes'], 244])}",
                  f"Max_Data_Len = {dice.choice([made['input_bytes'] + made['output_bytes'], 488])}"]
        lines += [f"{name} = {dice.choice(limits)}" for since, name, limits in KEYWORDS if since <= self.revision]
        lines += [f"{rate}_supp = {dice.choice(FLAG)}" for rate in RATES]
        lines += [f"MaxTsdr_{rate} = {dice.choice(U16)}" for rate in RATES]
        lines += ["FixPresetModules = 1"] if self.fixed else []
        lines += [f"Modul_Offset = {self.offset}"] if self.offset is not None else []
        lines += [f"DPV1_Slave = {dice.choice(FLAG)}"] if self.revision >= 3 else []
        dice.shuffle(lines)
        spelled = [self.spell(dice, line) for line in lines]
        if self.revision == 0:
            spelled += [f"User_Prm_Data_Len = {len(self.old_prm)}",
                        "User_Prm_Data = " + ",\\\n  ".join(f"0x{b:X}" for b in self.old_prm)]
        else:
            spelled += [f"Max_User_Prm_Data_Len = {self.prm.length}", self.prm.text]
        slots = "".join(f'Slot({n}) = "slot" {self.modules[0].name.split()[1]} 1-{len(self.modules)}\n'
                        for n in self.slots)
        return ("#Profibus_DP\n" + "\n".join(spelled) + "\n" + "".join(p.text for p in parameters) +
                "".join(m.text for m in self.modules) + (f"SlotDefinition\n{slots}EndSlotDefinition\n" if slots else ""))

    @staticmethod
    def spell(dice, line):
        keyword, value = line.split(" = ", 1)
        keyword = dice.choice([keyword, keyword.upper(), keyword.lower()])
        if value.isdigit() and dice.random() < 0.3:
            value = f"0x{int(value):X}"
        return f"{keyword}{dice.choice(['=', ' = ', chr(9) + '= '])}{value}{dice.choice(['', ' ; note'])}"


def read(sim, station, path):
    path.write_text(station.text, encoding="latin-1")
    modules = [word for m in station.choice for word in ("--module", m.name)]
    done = subprocess.run([sim, "gsd", str(path), "--json", *modules], capture_output=True, text=True, check=False)
    if done.returncode:
        return f"exit {done.returncode}: {done.stderr.strip()}"
    return json.loads(done.stdout)["selection"]


def difference(station, selection):
    if isinstance(selection, str):
        return selection
    for name, wanted in station.telegrams().items():
        got = selection[name]
        if isinstance(wanted, bytes):
            got, wanted = got["bytes"], wanted.hex(" ").upper()
        if got != wanted:
            return f"{name} is {got}, wanted {wanted}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sim")
    parser.add_argument("--files", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    given = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or pathlib.Path(scratch)
        folder.mkdir(exist_ok=True)
        for number in range(given.files):
            station = Station(given.seed * 1000 + number)
            wrong = difference(station, read(given.sim, station, folder / f"generated_{number}.gsd"))
            if wrong:
                print(f"file {number} of seed {given.seed}: {wrong}")
                failed += 1
    print(f"{given.files - failed} of {given.files} files agree")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
