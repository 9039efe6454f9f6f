"""A copy of the reference RTL as a user's own: with other names and polarities, and an input of its own."""
import json
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PORT = re.compile(r"^  (input|output) +logic +(?:\[(\d+):0\] +)?(\w+?)_([io]),?(?: *//.*)?$", re.MULTILINE)
INVERTED = ("clk", "reset", "csr", "intr0", "d_oe", "miso_oe", "xss", "pbtxd")
COMMON = {"access_interval": 64, "ready_cycles": 5000, "rts_lead": 3, "rts_trail": 7, "intr_low": 70, "intr_gap": 90, "search_window_ms": 1,
          "search_window_bits": 150, "baud_control_ms": 3, "fcb_rule": "content"}
SERIAL = {"spi_reply_gap": 2, "spi_write_gap": 100, "serial_block_crc": 1, "u_timer": 30000, "uart_gaps": [9, 3, 5, 11, 21, 41, 101, 201],
          "uart_min_tsdr": 20, "uart_cfg_length": 1}
SWAPPED_CRC = 166  # of faults.txt
FAULTS = {"no": {"pad_scan": 5, "pad_fault": 0}, "swapped CRC": {"pad_scan": 5, "pad_fault": SWAPPED_CRC}, "spoilt PBRTS": {"pad_scan": 4, "pad_fault": 0}}


def tied(fault="no", **more):
    return f"tie: {json.dumps({**FAULTS[fault], **more})}"


class Copy:
    """The reference with this top: my_TOP has a port pad_NAME for each of NAME_i and NAME_o."""

    def __init__(self, sim, folder, top):
        self.sim, self.top, self.folder = sim, "my_" + top, folder / top
        shutil.rmtree(self.folder / "rtl", ignore_errors=True)
        self.reference = ROOT / "rtl_ref"
        source = (self.reference / top / f"{top}.sv").read_text(encoding="utf-8")
        self.ports = PORT.findall(source) + [("input", "7", "fault", "i")]
        self.parameters = {**COMMON, **(SERIAL if "spi_reply_gap" in source else {})}
        self.copy_files(top)
        self.write_top(top)

    def copy_files(self, top):
        """The list names the files relative to its own folder."""
        library = self.folder / "rtl" / "library"
        library.mkdir(parents=True)
        files = (self.reference / top / "files.txt").read_text(encoding="utf-8").split()
        for path in [self.reference / each for each in files] + [*self.reference.glob("*.svh"), ROOT / "registers/dsdpv1_regs.svh"]:
            shutil.copy2(path, library)
        names = "\n".join(pathlib.PurePath(each).name for each in files)
        (library / "chip.f").write_text(f"// as other simulators read it\n+incdir+.\n{names}\n")

    def write_top(self, top):
        def level(name):
            return f"{'~' if name in INVERTED else ''}pad_{name}"

        def port(direction, msb, name, side):
            return f"  {direction} logic {f'[{msb}:0] ' if msb else ''}pad_{'q' if (name, side) == ('d', 'o') else name}"

        lines = [f"module {self.top} (", ",\n".join(port(*each) for each in self.ports), "  , input logic [2:0] pad_scan);"]
        for direction, msb, name, side in self.ports:
            if direction == "output":  # with its other polarity, and spoilt when scan is not 0
                pad = "pad_q" if name == "d" else f"pad_{name}"
                lines += [f"  logic {f'[{msb}:0] ' if msb else ''}out_{name};", f"  assign {pad} = {'~' if name in INVERTED else ''}out_{name}"
                          f"{' ^ (pad_scan != 3`d5)'.replace('`', chr(39)) if name == 'pbrts' else ''};"]
        connected = [f".{name}_{side}({level(name) if direction == 'input' else f'out_{name}'})" for direction, _, name, side in self.ports]
        lines += [f"  {top} u_chip ({', '.join(connected)});", "endmodule\n"]
        (self.folder / "rtl" / "top.sv").write_text("\n".join(lines))

    def pins(self, name="pins.yaml", *, leave_out=(), **changes):
        """The map; `changes` replace a line each. The lines by their first words."""
        pins = []
        for direction, _, port, side in self.ports:
            if port in self.parameters or port in ("clk", "fault"):
                continue
            pin = {"d": "D_IN" if side == "i" else "D_OUT"}.get(port, port.upper())
            pad = "pad_q" if (port, side) == ("d", "o") else f"pad_{port}"
            pins.append(f"  {pin}: {{port: {pad}, inverted: true}}" if port in INVERTED else f"  {pin}: {pad}")
        lines = {"clock": "clock: {port: pad_clk, inverted: true}", "tie": tied(),
                 "chip": f"chip: {{{', '.join(f'{each}: {{port: pad_{each}}}' for each in self.parameters)}}}",
                 "defines": "defines: {DSDPV1_RUN_TIME_LIMITS: , SINGLE_FAULTS: 1}", "files": "files: [top.sv]",
                 "file_list": "file_list: library/chip.f", **changes}
        text = [text for key, text in lines.items() if key not in leave_out]
        (self.folder / name).write_text("\n".join([*text, "pins:", *pins, ""]))
        return name

    def run(self, *words):
        return subprocess.run([self.sim, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False)

    def own(self, pins="pins.yaml"):
        return ["--rtl", "rtl", "--top", self.top, "--pins", pins]

    def call(self, *words, pins="pins.yaml"):
        return self.run(*words, *self.own(pins))

    def result(self, *words, **more):
        (self.folder / "r.json").unlink(missing_ok=True)
        done = self.call(*words, "--result", "r.json", **more)
        path = self.folder / "r.json"
        return done, json.loads(path.read_text()) if path.exists() else None
