"""The outputs of dsdpv1-sim, each with the command that writes it."""
import os
import shutil
import subprocess

SCENARIO = """name: short
baud: 12M
end: 3ms
slaves:
  - {name: demo, address: 5, gsd: device.gsd, modules: ["2 bytes in, 2 bytes out"]}
masters:
  - {name: plc, address: 2, slaves: [{slave: demo, outputs: "01 02"}]}
"""
RTL_FAULT = "12"  # of rtl_ref/dsdpv1/faults.txt, one that is quickly found and shrunk


class Output:
    """One output: its kind and file, and the words of its command, of which the last is the option for it."""

    finite, endless = [], []  # make the command end soon or never
    usual = 0                 # its exit code without a fault
    besides = ()              # other files that its command writes whatever becomes of it
    other_input = ""          # a file that it reads, not the scenario
    simulates = False         # a scenario, until it is interrupted
    others = {}               # another option for an output

    def __init__(self, kind, file, *words):
        self.kind, self.file, self.words, self.reference = kind, file, list(words), b""
        self.name = " ".join(filter(None, [words[0], kind]))

    @property
    def option(self):
        return self.words[-1]

    @property
    def other(self):
        return self.others.get(self.option)

    def command(self, path=None, more=(), endless=False):
        return [word for word in [*self.words, path or self.file, *(self.endless if endless else self.finite), *more] if word]

    def wait_until_it_runs(self, process, place):
        """Text read meanwhile from its error channel."""
        place.part(of=".%d" % process.pid)
        return b""


class OfRun(Output):
    endless = ["--set", "end=3000s", "--progress"]
    other_input = "device.gsd"
    simulates = True
    others = {"--wave": "--log", "--log": "--result", "--result": "--trace", "--trace": "--log", "--capture": "--log", "--report": "--log"}

    def __init__(self, kind, file, option):
        super().__init__(kind, file, "run", "s.yaml", "--quiet", option)

    def held(self, name):
        """The options for a file that is opened after the output; of trace and capture, which are the last, before it, and the result is there already."""
        return ["--wave", name, "--result", "held.json"] if self.kind in ("trace", "capture") else ["--trace", name]

    def beside(self, name):
        return ["--log" if self.kind == "trace" else "--trace", name]

    def wait_until_it_runs(self, process, place):
        return process.stderr.read(1)  # of the progress bar


class SaveFile(Output):
    """For --wave-save: the file beside the wave, which exists before it is written."""

    other_input = "device.gsd"

    def __init__(self, ending, beside):
        super().__init__("save file ." + ending, "o." + ending, "run", "s.yaml", "--quiet", "--wave-save", "--wave")
        self.besides = ("o.vcd", "o." + beside)

    def command(self, path=None, more=(), endless=False):
        wave = os.path.splitext(path or self.file)[0] + ".vcd"
        return [*self.words, wave, *more]


class OfServe(Output):
    finite, endless = ["--for", "3ms"], ["--for", "3000s"]
    other_input = "device.gsd"
    simulates = True
    usual = 1  # at any end: the master of the scenario has another address for the slave
    others = {"--wave": "--log", "--log": "--result", "--result": "--log", "--capture": "--log", "--report": "--log"}

    def __init__(self, kind, file, option):
        super().__init__(kind, file, "serve", "s.yaml", "--tcp", "0", "--quiet", "--set", "masters.0.slaves.0.address=9", option)

    def held(self, name):
        return ["--wave", name, "--result", "held.json"] if self.kind in ("log", "capture") else ["--log", name]

    def beside(self, name):
        return ["--wave" if self.kind == "log" else "--log", name]

    def wait_until_it_runs(self, process, place):
        process.stdout.readline()  # where it serves
        return b""


class OfCapture(Output):
    """For a command that reads a capture; compare reads two."""

    OTHERS = {"calibrate": {"--chip": "--json", "--json": "--table", "--table": "--chip"},
              "replay": {"--wave": "--log", "--log": "--result", "--result": "--capture", "--capture": "--json", "--json": "--table", "--table": "--log"},
              "decode": {"--json": "--table", "--table": "--json"},
              "compare": {"--wave": "--json", "--json": "--junit", "--junit": "--json"}}

    def __init__(self, kind, file, option, *words):
        super().__init__(kind, file, *words, "--quiet", option)
        self.other_input, self.others = words[1], self.OTHERS[words[0]]


class OfReplay(Output):
    """The output for a difference: in an existing case, which is faster."""

    usual = 1
    other_input = "case.stimulus"

    others = {"--log": "--result", "--result": "--log"}

    def __init__(self, kind, file, option="--difference"):
        nowhere = [] if option == "--difference" else ["--difference", "nowhere.vcd"]
        super().__init__(kind, file, "rtl-random", "--replay", self.other_input, "--fault", RTL_FAULT, *nowhere, option)


class OfRandom(Output):
    """Its other output is nowhere, except when it runs until it is interrupted."""

    finite, endless = ["--fault", RTL_FAULT], ["--cycles", "1000000000000", "--difference", "d.vcd"]
    usual = 1
    others = {"--stimulus": "--difference"}

    def __init__(self):
        super().__init__("stimulus", "o.stimulus", "rtl-random", "--stimulus")

    def command(self, path=None, more=(), endless=False):
        nowhere = [] if endless or "--difference" in more else ["--difference", "nowhere.vcd"]
        return super().command(path, [*nowhere, *more], endless)


class OfFaults(Output):
    finite, endless = ["--cycles", "1"], ["--cycles", "1000000000000"]
    other_input = "list.txt"

    def __init__(self):
        super().__init__("tsv", "o.tsv", "rtl-faults", "--list", self.other_input, "--directed", "directed", "--tsv")


class OfRecover(Output):
    other_input = "killed.fst.1.part"

    def __init__(self):
        super().__init__("", "o.fst", "recover", self.other_input, "--output")


WAVES = [("wave .fst", "o.fst", "--wave"), ("wave .vcd", "o.vcd", "--wave")]
LOG, RESULT, CAPTURE = ("log", "o.log", "--log"), ("result", "o.json", "--result"), ("capture", "o.pcapng", "--capture")
REPORT = ("report", "o.html", "--report")
OUTPUTS = [*(OfRun(*each) for each in [*WAVES, LOG, ("log .jsonl", "o.jsonl", "--log"), RESULT, ("trace", "o.txt", "--trace"), CAPTURE, REPORT]),
           *(OfServe(*each) for each in [*WAVES, LOG, RESULT, CAPTURE, REPORT]),
           Output("", "o.schema", "schema", "--output"), Output("", "o.md", "reasons", "--markdown", "--output"), OfRecover()]
SAVES = [SaveFile("gtkw", "sucl"), SaveFile("sucl", "gtkw")]
JSON, TABLE = ("json", "o.json", "--json"), ("table", "o.txt", "--table")
OF_CAPTURES = [*(OfCapture(*each, "replay", "recorded.pcapng", "--as", "5") for each in [*WAVES, LOG, RESULT, CAPTURE, JSON, TABLE]),
               *(OfCapture(*each, "calibrate", "board.vcd") for each in [("chip", "o.yaml", "--chip"), JSON, TABLE]),
               *(OfCapture(*each, "decode", "recorded.pcapng") for each in [JSON, TABLE]),
               *(OfCapture(*each, "compare", "board.vcd", "again.vcd") for each in [*WAVES, JSON, ("junit", "o.xml", "--junit")])]
OF_RTL = [OfReplay("difference .fst", "o.fst"), OfReplay("difference .vcd", "o.vcd"), OfReplay(*LOG), OfReplay(*RESULT), OfRandom(), OfFaults()]
SPEAKERS = [Output("", "o.log", "run", "s.yaml", "--log"), *(Output("", "", *words) for words in (
    ["schema"], ["reasons"], ["gsd", "device.gsd"], ["decode", "whole.log"]))]


def make_captures(program, folder):
    """A start-up: a wave, the same again, and its telegrams."""
    words = ["run", "s.yaml", "--quiet", "--set", "end=4ms", "--wave", "board.vcd", "--capture", "recorded.pcapng"]
    subprocess.run([program, *words], cwd=folder, check=True)
    shutil.copy(os.path.join(folder, "board.vcd"), os.path.join(folder, "again.vcd"))


def make_case(program, folder):
    """The inputs of the commands for RTL."""
    with open(os.path.join(folder, "list.txt"), "w", encoding="UTF-8") as file:
        file.write(RTL_FAULT + " telegram_rx a fault\n")
    words = ["rtl-random", "--fault", RTL_FAULT, "--stimulus", "case.stimulus", "--difference", "nowhere.vcd"]
    subprocess.run([program, *words], cwd=folder, stdout=subprocess.DEVNULL, check=False)
    os.mkdir(os.path.join(folder, "directed"))
    shutil.copy(os.path.join(folder, "case.stimulus"), os.path.join(folder, "directed"))
