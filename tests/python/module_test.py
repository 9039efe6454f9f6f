"""The module dsdpv1: each part once, and Python's additions: exceptions, callbacks, threads, numpy."""
import copy
import dataclasses
import functools
import os
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import threading
import types
import unittest
import unittest.mock

import numpy as np

import dsdpv1
from dsdpv1 import CYCLE, MS, NS, US, EventType, SlaveState

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = ROOT / "scenarios" / "power_on_12m.yaml"
SHORT = {"end": "11ms"}
MODULE = ["8 bytes in, 8 bytes out"]


# Replaces pandas, whether it is installed or not.
PANDAS = unittest.mock.patch.dict(sys.modules, {"pandas": types.SimpleNamespace(DataFrame=list)})


def slave_of_gsd(**members):
    return dsdpv1.Gsd(ROOT / "scenarios" / "dsdpv1.gsd").slave(5, MODULE, **members)


class Line:
    """A bus with a chip, its user CPU and a master that knows it."""

    def __init__(self, ring=0):
        self.slave = slave_of_gsd()
        self.bus = dsdpv1.Bus()
        self.chip = self.bus.add_chip()
        self.user = dsdpv1.User(self.chip)
        self.master = self.bus.add_master(2, ring=ring)
        self.master.add_slave(self.slave)

    def start(self):
        self.user.wait(20 * CYCLE)
        self.user.power_on(dsdpv1.Initialisation.of(self.slave))
        self.master.start()
        self.bus.run(5 * MS)


class Spc3User:
    """The user of a chip of the SPC3 family: sets it up and takes its events, by register calls (docs/spc3.md)."""

    BUFFERS = {0x1B: 8, 0x1C: 8, 0x1D: 8, 0x1F: 8, 0x20: 8, 0x21: 8, 0x26: 16, 0x27: 16, 0x2B: 64, 0x30: 64, 0x32: 64, 0x34: 64}

    def __init__(self, bus, chip, slave):
        self.bus, self.chip, self.outputs = bus, chip, b""
        chip.set("RESET", 0, bus.now + 20 * CYCLE)
        bus.run(bus.now + 30 * CYCLE)
        segment = 8
        for pointer, size in self.BUFFERS.items():
            self.store(pointer, segment)
            segment += size // 8
        for address, value in {0x16: slave.address, 0x1A: 8, 0x1E: 8, 0x24: 6, 0x25: 6, 0x28: 64, 0x33: len(slave.cfg), 0x39: 0xFF,
                               0x3A: slave.ident & 0xFF, 0x3B: slave.ident >> 8, 0x07: 0x01}.items():
            self.store(address, value)
        self.write_buffer(0x34, slave.cfg)
        self.set_inputs(bytes(8))
        self.store(0x08, 0x21)  # START, Res_User_Wd

    def load(self, address):
        return self.chip.load(address, self.bus.now + CYCLE)

    def store(self, address, value):
        self.chip.store(address, value, self.bus.now + CYCLE)

    def write_buffer(self, pointer, data):
        start = self.load(pointer) * 8
        for place, byte in enumerate(data):
            self.store(start + place, byte)

    def set_inputs(self, data):
        self.write_buffer(0x1E + (self.load(0x08) >> 4 & 3), data)
        self.load(0x09)

    def serve(self):
        events = self.load(0x01)
        self.store(0x03, events)
        while events & 0x08 and self.load(0x0E) == 1:  # New_Prm, again while a newer one has come
            pass
        while events & 0x04 and self.load(0x10) == 1:
            pass
        if events & 0x20:
            start = self.load(0x1A + (self.load(0x0B) & 3)) * 8
            self.outputs = bytes(self.load(start + place) for place in range(8))


class RegisterCallTest(unittest.TestCase):
    def test_a_program_brings_each_chip_of_the_spc3_family_to_data_exchange(self):
        for kind in ("apc3", "spc3", "vpc3"):
            with self.subTest(kind):
                slave, bus = slave_of_gsd(), dsdpv1.Bus()
                user = Spc3User(bus, bus.add_chip(kind=kind), slave)
                master = bus.add_master(2)
                master.add_slave(slave)
                master.set_outputs(5, bytes(range(8)))
                master.start()
                user.set_inputs(b"\xAA" * 8)
                for _ in range(200):
                    bus.run(bus.now + 50 * US)
                    user.serve()
                status = master.slave(5)
                self.assertEqual((status.state, status.inputs, user.outputs), (SlaveState.DATA_EXCHANGE, b"\xAA" * 8, bytes(range(8))))

    def test_other_kinds_have_pins(self):
        with self.assertRaises(dsdpv1.UnsupportedError):
            dsdpv1.Chip().load(4)


class ErrorsTest(unittest.TestCase):
    def refuses(self, kind, words, function, *arguments, **options):
        with self.assertRaisesRegex(kind, words):
            function(*arguments, **options)

    def test_what_the_library_refuses_is_an_exception_with_its_words(self):
        chip = dsdpv1.Chip()
        self.refuses(dsdpv1.NotFoundError, "no pin FOO, it has RESET, R_REQ", chip.set, "FOO", 1)
        self.refuses(dsdpv1.ArgumentError, "level of A is 2048, expected 0 to 2047", chip.set, "A", 2048)
        chip.advance(100)
        self.refuses(dsdpv1.TimeError, "tick is 99, which is before the present tick 100", chip.advance, 99)
        self.refuses(dsdpv1.StateError, "", lambda: chip.station)
        self.refuses(dsdpv1.NotFoundError, 'kind is "foo", expected dsdpv1, dsdpv1_r, dsdpv1_rsu, apc3, spc3, vpc3, xgate', dsdpv1.Chip, "foo")
        self.refuses(dsdpv1.NotFoundError, "speed", dsdpv1.Chip, parameters={"speed": 1})
        self.refuses(dsdpv1.InputError, "nix.yaml", dsdpv1.run, "nix.yaml")
        self.refuses(dsdpv1.InputError, "x.yaml:2: .*13M", dsdpv1.run, "x.yaml", text="name: x\nbaud: 13M\n")
        self.refuses(dsdpv1.UnsupportedError, "ARM board", dsdpv1.run, ROOT / "scenarios" / "arm_board_12m.yaml")
        self.refuses(ValueError, "engine is fast, expected skip, step", dsdpv1.Chip, engine="fast")
        self.refuses(ValueError, "baud is 13M, expected 12M", dsdpv1.Bus, "13M")

    def test_a_closed_object_refuses_everything(self):
        bus = dsdpv1.Bus()
        chip = bus.add_chip()
        with bus:
            pass
        self.refuses(dsdpv1.StateError, "this Chip is closed", chip.advance, 1)
        self.refuses(dsdpv1.StateError, "this Bus is closed", bus.run, 1)
        bus.close()


class ChipTest(unittest.TestCase):
    def test_a_user_reads_the_version_pin_by_pin(self):
        chip = dsdpv1.Chip()
        chip.watch(["L_REQ", "D_OUT"])
        chip.set("RESET", 1, at=1 * US)
        chip.advance(150 * US)
        chip.set("R_REQ", 1)
        chip.advance(chip.now + 1 * US)
        self.assertEqual((chip.level("L_REQ"), chip.level("L_STA")), (0, 0))
        chip.set("R_STA", 1)
        start = chip.now + 50 * NS
        for pin, level, after in (("A", 4, 0), ("CSR", 0, 0), ("RD", 0, 10)):
            chip.set(pin, level, at=start + after * NS)
        self.assertEqual(chip.sample(at=start + 50 * NS), 0xC5)
        chip.set("RD", 1)
        chip.set("CSR", 1)
        chip.advance(chip.now + 1 * US)
        self.assertEqual(chip.read(4, timing=dsdpv1.AccessTiming(rd_sample=400, rd_low=600)), 0xC5)
        self.assertEqual(chip.read(4, timing=dsdpv1.AccessTiming(rd_sample=300, rd_low=600)), dsdpv1.X)  # Tw
        changes = chip.changes()
        self.assertEqual(changes.dtype, dsdpv1.CHANGE)
        self.assertTrue((np.diff(changes["tick"].astype(np.int64)) >= 0).all())
        self.assertIn(0xC5, dsdpv1.of_pin(changes, chip.kind.pin("D_OUT").number)["level"])
        self.assertEqual(len(chip.changes()), 0)

    def test_step_and_skip_change_the_same_pins_and_many_at_once_are_as_one_by_one(self):
        stimulus = [(1 * US, 0, dsdpv1.kind_of().pin("RESET").number, 1), (200 * US, 0, dsdpv1.kind_of().pin("R_REQ").number, 1)]
        seen = []
        for engine in ("skip", "step"):
            chip = dsdpv1.Chip(engine=engine, parameters={"ready_cycles": 5000})
            chip.watch()
            if engine == "skip":
                chip.set_many(stimulus)
            else:
                for tick, _, pin, level in stimulus:
                    chip.set(pin, level, at=tick)
            chip.advance(250 * US)
            seen.append(sorted(chip.changes().tolist()))
        self.assertGreater(len(seen[0]), 100)
        self.assertEqual(*seen)

    def test_the_serial_ports_of_the_rsu_are_pins_as_any_other(self):
        """A scenario's changes of all input pins, straps included, have the same effect on a chip of Python; the library's table gives the pins."""
        for mode, port, least in (("spi", "MISO", 1000), ("uart", "TXD", 500)):
            with self.subTest(mode):
                run = dsdpv1.run(ROOT / "scenarios" / f"rsu_{mode}.yaml", changes=True)
                self.assertEqual(run.kind.name, "dsdpv1_rsu")
                inputs = np.isin(run.changes["pin"], [pin.number for pin in run.kind.pins if pin.input]) & (run.changes["station"] != dsdpv1.LINE)
                chip = dsdpv1.Chip("dsdpv1_rsu", parameters={"search_window_ms": 5})
                chip.watch(pin.name for pin in run.kind.pins if not pin.input)
                straps = {"MODE": {"spi": 1, "uart": 2}[mode], "ADR": 1, "UBR": 7, "UIV": 0}
                for pin, level in straps.items():
                    chip.set(pin, level)
                chip.set_many(run.changes[inputs])
                chip.advance(run.simulated)
                changes = chip.changes()
                self.assertGreater(len(dsdpv1.of_pin(changes, run.kind.pin(port).number)), least)
                for pin in run.kind.pins:
                    if not pin.input:
                        told = [(tick, level) for tick, _, _, level in run.pin(pin.name).tolist() if tick > 0]
                        self.assertEqual([(tick, level) for tick, _, _, level in dsdpv1.of_pin(changes, pin.number).tolist()], told, pin.name)

    def test_the_model_beside_a_chip_names_the_first_difference(self):
        chip = dsdpv1.Chip(parameters={"ready_cycles": 256})
        chip.watch()
        chip.set("RESET", 1, at=20 * CYCLE)
        chip.advance(100 * US)
        changes = chip.changes()
        scoreboard = dsdpv1.Scoreboard(parameters={"ready_cycles": 256})
        self.assertIsNone(scoreboard.compare(changes[:50], int(changes["tick"][49])))
        self.assertIsNone(scoreboard.compare(changes[50:], 100 * US + 1))
        self.assertEqual(scoreboard.matched, len(changes) - 1)
        at = int(np.flatnonzero(changes["pin"] == chip.kind.pin("L_STA").number)[3])
        late = np.delete(changes, at)
        difference = dsdpv1.Scoreboard("dsdpv1", {"ready_cycles": 256}).compare(late, 100 * US)
        tick, _, _, level = changes[at].tolist()
        self.assertEqual((difference.tick, difference.pin, difference.model, difference.dut), (tick, "L_STA", level, 1 - level))
        self.assertEqual(difference.last_input, (20 * CYCLE, "RESET", 1))
        self.assertEqual([type(each) for each in difference.events], [dsdpv1.ChipEvent] * len(difference.events))
        with self.assertRaisesRegex(dsdpv1.TimeError, "tick is 5, which is before the present tick"):
            scoreboard.compare([(5, 0, 0, 1)], 5)

    def test_callbacks_tell_what_is_kept_else(self):
        kept, told, events = dsdpv1.Chip(), dsdpv1.Chip(), []
        heard = []
        kept.watch(["L_STA"])
        told.watch(["L_STA"], lambda tick, pin, level: heard.append((tick, pin, level)))
        told.on_event(events.append)
        for chip in (kept, told):
            chip.set("RESET", 1, at=100)
            chip.advance(1 * MS)
        self.assertEqual([(tick, "L_STA", level) for tick, _, _, level in kept.changes().tolist()], heard)
        self.assertEqual([(each.code, each.severity.name) for each in events], [("READY_FLAG", "INFO")])
        self.assertLess(told.now, told.next)

    def test_a_chip_alone_answers_characters_on_its_line(self):
        chip = dsdpv1.Chip()
        user = dsdpv1.User(chip)
        user.wait(20 * CYCLE)
        user.power_on(dsdpv1.Initialisation.of(slave_of_gsd()))
        bit, status = dsdpv1.bit_ticks("12M"), dsdpv1.Telegram(dsdpv1.TelegramKind.SD1, da=5, sa=2, fc=0x49).encode()
        start = chip.now + 100 * bit
        self.assertEqual(chip.receive(status, bit, at=start), start + 11 * len(status) * bit)
        chip.advance(chip.now + 100 * US)
        self.assertEqual(chip.status.baud, "12M")  # a right telegram ends the search
        chip.watch(["PBTXD"])
        end = chip.receive(status, bit, at=chip.now + 200 * bit)
        chip.advance(end + 200 * bit)
        self.assertIn(chip.changes()["tick"][0] - end, range(11 * bit, 12 * bit + 1))  # TSDR

    @staticmethod
    def begun(**options):
        """A chip in the middle of an access of the user, and the function that completes the access."""
        chip = dsdpv1.Chip(**options)
        chip.set("RESET", 1, at=1 * US)
        chip.set("R_REQ", 1, at=150 * US)
        chip.set("R_STA", 1, at=151 * US)
        chip.set("A", 4)
        chip.set("CSR", 0)
        chip.set("RD", 0)
        return chip

    @staticmethod
    def ended(chip):
        chip.watch()
        chip.set("RD", 1, at=151 * US + 1000)
        chip.set("CSR", 1)
        chip.set("R_STA", 0, at=152 * US)
        chip.set("R_REQ", 0)
        chip.advance(1 * MS)
        return repr(chip.changes().tolist()).encode()

    def test_a_saved_chip_goes_on_in_another_process(self):
        chip = self.begun(parameters={"ready_cycles": 5000})
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "chip.state"
            path.write_bytes(chip.save())
            program = ("import sys, pathlib, dsdpv1; from module_test import ChipTest; chip = dsdpv1.Chip(parameters={'ready_cycles': 5000});"
                       "chip.restore(pathlib.Path(sys.argv[1]).read_bytes()); sys.stdout.buffer.write(ChipTest.ended(chip))")
            there = subprocess.run([sys.executable, "-B", "-c", program, path], check=True, stdout=subprocess.PIPE,
                                   env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, [str(pathlib.Path(__file__).parent), *sys.path]))})
        here = self.ended(chip)
        self.assertGreater(len(here), 1000)
        self.assertEqual(there.stdout, here)

    def test_a_chip_can_be_copied_pickled_and_taken_back(self):
        chip = self.begun(engine="step", parameters={"ready_cycles": 5000})
        state, copied, pickled = chip.save(), copy.copy(chip), pickle.loads(pickle.dumps(chip))
        ended = self.ended(chip)
        for each in (copied, pickled):
            self.assertEqual(each.now, 151 * US)
            self.assertEqual(self.ended(each), ended)
        chip.restore(state)
        self.assertEqual(self.ended(chip), ended)

    def test_what_is_no_state_of_such_a_chip_is_refused(self):
        chip = self.begun()
        state, now = chip.save(), chip.now
        for wrong, why in ((b"", "this is no saved state of a chip"), (state[:-1], "it was saved with"), (state[:-1] + b"\0", "damaged")):
            with self.assertRaisesRegex(dsdpv1.InputError, why):
                chip.restore(wrong)
            self.assertEqual((chip.now, chip.save()), (now, state))
        with self.assertRaisesRegex(dsdpv1.InputError, "whose ready_cycles is 4096, here it is 5000"):
            dsdpv1.Chip(parameters={"ready_cycles": 5000}).restore(state)
        with self.assertRaisesRegex(dsdpv1.StateError, "on a bus"):
            pickle.dumps(dsdpv1.Bus().add_chip())

    def test_what_a_callback_raises_comes_out_of_the_call(self):
        chip = dsdpv1.Chip()
        calls = []

        def fails(*_):
            calls.append(1)
            raise ZeroDivisionError("of the callback")

        chip.watch(["L_REQ"], fails)
        chip.set("RESET", 1, at=100)
        with self.assertRaisesRegex(ZeroDivisionError, "of the callback"):
            chip.advance(1 * MS)
        self.assertEqual(len(calls), 1)
        chip.watch([])
        chip.advance(2 * MS)

    def test_a_callback_must_not_change_its_chip(self):
        chip = dsdpv1.Chip()
        chip.watch(["L_REQ"], lambda *_: chip.set("R_REQ", 1))
        chip.set("RESET", 1, at=100)
        with self.assertRaises(dsdpv1.StateError):
            chip.advance(1 * MS)

    def test_other_threads_run_while_a_call_is_in_the_library(self):
        chip = dsdpv1.Chip(engine="step")
        chip.set("RESET", 1, at=100)
        order, ready = [], threading.Event()

        def long_call():
            ready.set()
            chip.advance(500 * MS)
            order.append("call")

        thread = threading.Thread(target=long_call)
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1e-5)
        thread.start()
        ready.wait()
        order.append("other")  # were the lock held, after the call
        thread.join()
        sys.setswitchinterval(interval)
        self.assertEqual(order, ["other", "call"])


class BusTest(unittest.TestCase):
    def test_a_master_with_callbacks_brings_a_slave_up_and_asks_it(self):
        line = Line()
        states, done, telegrams = [], [], []

        def told(event):
            if event.type == EventType.SLAVE_STATE:
                states.append(event.after)
                if event.after == SlaveState.DATA_EXCHANGE:
                    self.request = line.master.ask("get_cfg", 5)  # a command inside of the callback
            elif event.type == EventType.REQUEST_DONE:
                done.append(event)

        line.bus.on_event(told)
        line.bus.on_telegram(telegrams.append)
        line.master.set_outputs(5, bytes(range(8)))
        line.start()
        self.assertEqual(states[-1], SlaveState.DATA_EXCHANGE)
        self.assertEqual([(each.id, each.outcome) for each in done], [(self.request, dsdpv1.Outcome.ANSWERED)])
        self.assertEqual(dsdpv1.decode(done[0].data).telegram.data, line.slave.cfg)
        self.assertEqual(line.user.exchange(b"\xAA" * 8), bytes(range(8)))
        line.bus.run(line.bus.now + 2 * MS)
        status = line.master.slave(5)
        self.assertEqual((status.inputs, status.reason), (b"\xAA" * 8, ""))
        self.assertEqual(line.chip.status.dp_state, dsdpv1.DpState.DATA_EXCH)
        self.assertEqual(line.chip.status.baud, "12M")
        self.assertGreaterEqual(line.bus.tsdr(5).tsdr_min, 11 * dsdpv1.bit_ticks("12M"))
        self.assertEqual(line.bus.statistics.telegrams, len([each for each in telegrams if not each.error]))

    def test_broken_telegrams_are_heard_as_such(self):
        line = Line()
        line.start()
        heard = []
        line.bus.on_telegram(heard.append)
        telegram = dsdpv1.Telegram(dsdpv1.TelegramKind.SD1, da=5, sa=2, fc=0x49)
        line.master.send_raw(telegram.encode(), dsdpv1.WireFaults(wrong_parity_at=2))
        line.bus.run(line.bus.now + 2 * MS)
        self.assertEqual([each.data for each in heard if each.character_errors], [telegram.encode()])

    def test_a_chip_outside_answers_to_the_tick_as_one_on_the_bus(self):
        inside, outside = Line(), dsdpv1.Bus()
        inside.chip.watch(["PBTXD", "PBRTS"])
        chip, station, master = dsdpv1.Chip(), outside.add_station("dut"), outside.add_master(2)
        master.add_slave(inside.slave)
        heard, sent = [], []
        outside.watch(callback=lambda tick, _station, _pin, level: heard.append((tick, level)))
        user = dsdpv1.User(chip)
        user.wait(20 * CYCLE)
        chip.watch(["PBTXD", "PBRTS"])
        user.power_on(dsdpv1.Initialisation.of(inside.slave))
        outside.run(chip.now)
        master.start()
        inside.start()
        now = chip.now
        while now < 5 * MS:
            now = min(outside.next, chip.next)
            outside.run(now)
            chip.advance(now)
            for change in chip.changes().tolist():
                sent.append(change)
                station.drive(chip.level("PBRTS") == 1, chip.level("PBTXD"), at=now)
            for tick, level in heard:
                chip.set("PBRXD", level, at=tick)
            heard.clear()
        self.assertGreater(len(sent), 300)
        expected = [each for each in inside.chip.changes().tolist() if each[0] < sent[-1][0]]
        self.assertEqual(sorted(expected), sorted(each for each in sent if each[0] < sent[-1][0]))

    def test_a_master_of_class_2_is_told_why_there_is_no_connection(self):
        line, ends = Line(ring=1), []
        line.bus.on_event(lambda event: ends.append(event) if event.type == EventType.CONNECTION_END else None)
        second = line.bus.add_master2(3)
        connection = second.add_connection(5, send_timeout=1)
        line.start()
        second.start()
        line.bus.run(line.bus.now + 5 * MS)
        second.connect(connection)
        line.bus.run(line.bus.now + 50 * MS)
        self.assertEqual([each.outcome for each in ends], [dsdpv1.ConnectionEndCause.REFUSED])
        self.assertEqual(second.connection(connection).state, dsdpv1.ConnectionState.CLOSED)
        self.assertIn(3, second.ring.stations)


class XgateTest(unittest.TestCase):
    """A host of the XGate-DPS10 by bytes (docs/xgate.md)."""

    QUICK = {"rate": 3_000_000, "answer_delay": 10 * US, "power_up": 20 * US}

    @staticmethod
    def frame(command, data=b"", special=0x11):
        head = bytes([0x7E, command, len(data), special]) + bytes(data)
        return head + bytes([functools.reduce(lambda a, b: a ^ b, head)])

    @staticmethod
    def start(module):
        module.set("RESET", 1)
        module.uart_open(3_000_000)
        module.advance(module.now + 40 * US)

    @staticmethod
    def ask(module, command):
        module.uart_send(command)
        head = module.uart_receive(4, module.now + MS)
        return head + module.uart_receive(head[2] + 1, module.now + MS)

    def test_the_host_and_a_master_exchange_data(self):
        slave = dsdpv1.Gsd(ROOT / "scenarios" / "xgate.gsd").slave(6, ["4 bytes in, 4 bytes out, with parameters"])
        bus = dsdpv1.Bus()
        module = bus.add_chip(kind="xgate", parameters=self.QUICK)
        master = bus.add_master(2)
        master.add_slave(slave)
        master.set_outputs(6, b"\1\2\3\4")
        self.start(module)
        codes = []
        module.on_event(lambda event: codes.append(event.code))
        self.assertEqual(self.ask(module, self.frame(0x20, bytes(4))), self.frame(0x20, [3, 4, 0], 0x91))
        self.assertEqual(codes, ["XGATE_ERROR"])
        given = [6, 0x01, 0x0F, len(slave.cfg), 4, 4, len(slave.user_prm), 1, 0, 0, 0, 0, 0, 10, 240, 240, 0x80, 0, 0, *slave.cfg]
        self.assertEqual(self.ask(module, self.frame(0x04, given)), self.frame(0x04))
        master.start()
        bus.run(bus.now + 5 * MS)
        self.assertEqual(module.status.dp_state, dsdpv1.DpState.DATA_EXCH)
        self.assertEqual(module.level("INT"), 0)  # new user parameters
        self.assertEqual(self.ask(module, self.frame(0x22)), self.frame(0x22, slave.user_prm))
        self.assertEqual(self.ask(module, self.frame(0x21, b"abcd")), self.frame(0x21, b"\1\2\3\4"))
        self.assertEqual(module.level("INT"), 1)
        bus.run(bus.now + MS)
        self.assertEqual(master.slave(6).inputs, b"abcd")

    def test_a_saved_module_answers_in_another_object(self):
        module = dsdpv1.Chip("xgate", parameters=self.QUICK)
        self.start(module)
        command, answer = self.frame(0x01, [9]), self.frame(0x01, b"XGate-DPS10\0")
        module.uart_send(command[:3])
        again = copy.copy(module)  # in the middle of a frame
        again.uart_open(3_000_000)
        for each in (module, again):
            each.uart_send(command[3:])
            self.assertEqual(each.uart_receive(len(answer), each.now + MS), answer)
        self.assertEqual(module.now, again.now)

    def test_spi_and_what_is_refused(self):
        module = dsdpv1.Chip("xgate", parameters={**self.QUICK, "port": 1})
        module.set("RESET", 1)
        module.advance(40 * US)
        self.assertEqual(module.spi(self.frame(0x24), bit=2400), b"\xFF" * 5)
        module.advance(module.now + 20 * US)
        self.assertEqual(module.level("INT"), 0)
        self.assertEqual(module.spi(bytes(8)), self.frame(0x24, [4, 3, 0], 0x91))
        with self.assertRaisesRegex(dsdpv1.UnsupportedError, "the parameter port chooses another port than UART"):
            module.uart_open(9600)
        with self.assertRaisesRegex(dsdpv1.UnsupportedError, "no SPI for its user"):
            dsdpv1.Chip().spi(b"1")
        with self.assertRaisesRegex(dsdpv1.StateError, "the UART is not open"):
            dsdpv1.Chip("xgate").uart_send(b"1")
        with self.assertRaisesRegex(dsdpv1.ArgumentError, "rate is 99, expected 1200 to 3000000"):
            dsdpv1.Chip("xgate").uart_open(99)


class AcyclicTest(unittest.TestCase):
    """A user CPU whose callback answers from a table of objects; masters of both classes, and those of a scenario."""

    def setUp(self):
        self.objects = {(1, 2): b"\x11\x22\x33\x44"}
        self.slave = dsdpv1.Slave(address=7, ident=0x0CC9, cfg=b"\x31", input_length=2, output_length=2, dpv1=True)
        self.bus, self.done, self.requests = dsdpv1.Bus(), [], []
        self.user = dsdpv1.User(self.bus.add_chip())
        self.bus.on_event(self.done.append)

    def answer(self, request):
        self.requests.append((request.master_class, request.service))
        key = request.slot, request.index
        if key not in self.objects:
            raise dsdpv1.Refuse(0xB2)
        if request.service == "write":
            self.objects[key] = request.data
        return self.objects[key][:request.length] if request.service == "read" else request.data[::-1]

    def power_on(self):
        self.user.wait(20 * CYCLE)
        self.user.power_on(dsdpv1.Initialisation.of(self.slave))
        self.user.exchange(bytes(2))

    def serve_until(self, true, limit=60 * MS):
        while not true():
            self.assertLess(self.bus.now, limit, [each.text for each in self.done])
            self.user.wait(20 * US)
            self.user.serve(self.answer)

    def ends(self, request):
        found = []
        self.serve_until(lambda: found.extend(each for each in self.done if each.type == EventType.ACYCLIC_DONE and each.id == request) or found)
        return found[0].outcome, found[0].data, found[0].codes

    def test_class_1_reads_writes_and_is_refused(self):
        self.power_on()
        master = self.bus.add_master(1)
        master.add_slave(self.slave)
        master.start()
        self.serve_until(lambda: master.slave(7).state == SlaveState.DATA_EXCHANGE)
        self.assertEqual(self.ends(master.read(7, 1, 2)), (dsdpv1.AcyclicOutcome.POSITIVE, b"\x11\x22\x33\x44", (0, 0, 0)))
        self.assertEqual(self.ends(master.write(7, 1, 2, bytes(range(240)))), (dsdpv1.AcyclicOutcome.POSITIVE, b"", (0, 0, 0)))
        self.assertEqual(self.ends(master.read(7, 1, 2)), (dsdpv1.AcyclicOutcome.POSITIVE, bytes(range(240)), (0, 0, 0)))
        self.assertEqual(self.ends(master.read(7, 9, 9)), (dsdpv1.AcyclicOutcome.NEGATIVE, b"", (0x80, 0xB2, 0)))

    def test_class_2_connects_reads_writes_transports_and_aborts(self):
        self.power_on()
        master = self.bus.add_master2(2, highest_address=3)
        master.start()
        peer = master.add_connection(7)
        master.connect(peer)
        self.serve_until(lambda: master.connection(peer).state == dsdpv1.ConnectionState.OPEN)
        self.assertEqual(self.ends(master.read(peer, 1, 2)), (dsdpv1.AcyclicOutcome.POSITIVE, b"\x11\x22\x33\x44", (0, 0, 0)))
        self.assertEqual(self.ends(master.write(peer, 1, 2, b"\xAA")), (dsdpv1.AcyclicOutcome.POSITIVE, b"", (0, 0, 0)))
        self.assertEqual(self.ends(master.transport(peer, 1, 2, b"abc")), (dsdpv1.AcyclicOutcome.POSITIVE, b"cba", (0, 0, 0)))
        self.assertEqual(self.objects, {(1, 2): b"\xAA"})
        master.abort(peer, 3)
        self.serve_until(lambda: master.connection(peer).state == dsdpv1.ConnectionState.CLOSED)
        ends = [each.outcome for each in self.done if each.type == EventType.CONNECTION_END]
        self.assertEqual(ends, [dsdpv1.ConnectionEndCause.MASTER])

    def test_the_masters_of_a_scenario_work_by_themselves(self):
        first, second = self.bus.add_scenario(ROOT / "examples" / "masters.yaml", {"masters.0.start": "1ms"})
        self.assertIsInstance(first, dsdpv1.Master1)
        self.assertIsInstance(second, dsdpv1.Master2)
        self.assertRegex(self.bus.left_out, "masters.yaml: left out are slaves, .* of the script, by line: pause_user")
        self.power_on()
        self.serve_until(lambda: any(each.type == EventType.CONNECTION_END for each in self.done))
        said = [each.text for each in self.done if each.type == EventType.ACYCLIC_DONE]
        self.assertEqual(said, ["c1_read: 11 22 33 44", "c1_write: done", "c2_read: AA BB CC", "c2_transport: 05 04 03 02 01"])
        self.assertEqual(self.requests, [(1, "read"), (1, "write"), (2, "read"), (2, "transport")])
        self.assertEqual(self.user.exchange(), b"\x12\x34")


class FilesTest(unittest.TestCase):
    def test_a_gsd_file_says_what_a_master_has_to_know(self):
        gsd = dsdpv1.Gsd(ROOT / "scenarios" / "dsdpv1.gsd")
        self.assertEqual((gsd.info.ident, gsd.info.dpv1, gsd.warnings), (0x0CC9, True, []))
        self.assertIn(MODULE[0], gsd.info.modules)
        slave = gsd.slave(7, MODULE, dpv1=True, watchdog=(10, 1))
        self.assertEqual((slave.address, slave.input_length, slave.output_length, slave.dpv1, slave.watchdog), (7, 8, 8, True, (10, 1)))
        self.assertEqual(gsd.report(MODULE)["vendor"], gsd.info.vendor)
        with self.assertRaisesRegex(dsdpv1.InputError, "my.gsd:[0-9]+: "):
            dsdpv1.Gsd.parse("#Profibus_DP\nGSD_Revision = x\n", "my.gsd")
        with self.assertRaises(dsdpv1.InputError):
            gsd.slave(5, ["no such module"])

    def test_telegrams_are_encoded_decoded_and_explained(self):
        telegram = dsdpv1.Telegram(dsdpv1.TelegramKind.SD2, da=5, sa=2, fc=0x6D, dsap=60, ssap=62)
        data = telegram.encode()
        self.assertEqual(data.hex(), "680505688582" + "6d3c3e" + "ee16")
        self.assertEqual(dsdpv1.decode(data), dsdpv1.Decoded(telegram, "", len(data)))
        self.assertEqual(dsdpv1.explain(data, "service"), "Slave_Diag")
        self.assertIn("2 -> 5", dsdpv1.explain(data))
        self.assertEqual(dsdpv1.explain(data, "bytes").count("\n"), len(data))
        wrong = dsdpv1.decode(data[:-2] + b"\x00\x16")
        self.assertEqual((wrong.telegram, wrong.error), (telegram, "wrong FCS"))
        with self.assertRaises(ValueError):
            dataclasses.replace(telegram, data=bytes(247)).encode()


class ChecksTest(unittest.TestCase):
    def strobe(self, low, **options):
        chip, checker, violations = dsdpv1.Chip(), dsdpv1.Checker(**options), []
        checker.on_violation(violations.append)
        chip.watch(checker.wants)
        user = dsdpv1.User(chip, dsdpv1.AccessTiming(wr_low=low))
        user.wait(20 * CYCLE)
        user.power_on()
        user.run(dsdpv1.user.hold(dsdpv1.user.write_block(0x131, b"\x01", 0x133)))
        checker.pins(chip.changes())
        checker.finish(chip.now)
        return checker.results, [each.rule for each in violations]

    def test_a_strobe_that_is_too_short_is_found(self):
        results, violations = self.strobe(149)  # Ts >= 150 ticks
        self.assertEqual(set(violations), {"TIMING_TS"})
        self.assertEqual(results["TIMING_TS"].worst_margin, -1)
        self.assertEqual(self.strobe(150)[1], [])

    def test_limits_can_be_others(self):
        self.assertEqual(set(self.strobe(150, limits={"TIMING_TS": 151})[1]), {"TIMING_TS"})
        self.assertEqual(self.strobe(149, limits={"TIMING_TS": None})[1], [])

    def started(self, *writes):
        """Rules that a CPU at the asynchronous Intel bus of an APC3 violates: it writes these registers, and START."""
        chip, checker, violations = dsdpv1.Chip("apc3"), dsdpv1.Checker("apc3"), []
        checker.on_violation(violations.append)
        chip.watch(checker.wants)
        now = 20 * CYCLE
        chip.set("RESET", 0, at=now)
        for register, value in (*writes, (0x08, 0x01)):
            now += 400 * NS
            for pin, level in (("AB", register), ("XCS", 0), ("DB_IN", value), ("XWR_E_CLOCK", 0)):
                chip.set(pin, level, at=now)
            for pin, level in (("XWR_E_CLOCK", 1), ("XCS", 1), ("DB_IN", dsdpv1.Z)):
                chip.set(pin, level, at=now + 250 * NS)
        chip.advance(now + 400 * NS)
        checker.pins(chip.changes())
        checker.finish(chip.now)
        return {each.rule for each in violations}

    def test_misuse_at_the_bus_of_the_spc3_family_is_found(self):
        without = self.started((0x06, 0x00), (0x07, 0x00))
        self.assertIn("START_MODE", without)
        self.assertEqual(without - self.started((0x06, 0x00), (0x07, 0x01)), {"START_MODE"})

    def test_rules_say_what_must_hold(self):
        rule = next(each for each in dsdpv1.rules() if each.name == "TIMING_TS")
        self.assertEqual((rule.bound, rule.limit), ("min", 150))
        self.assertTrue(rule.rule and rule.clause and rule.advice)


class WordsTest(unittest.TestCase):
    def test_every_public_class_function_and_method_has_its_words(self):
        public = [(name, getattr(dsdpv1, name)) for name in dsdpv1.__all__]
        named = [(name, each) for name, each in public if isinstance(each, (type, types.FunctionType))]
        named += [(f"{name}.{method}", each) for name, owner in named if isinstance(owner, type) for method, each in vars(owner).items()
                  if not method.startswith("_") and isinstance(each, (types.FunctionType, property, classmethod, functools.cached_property))]
        self.assertGreater(len(named), 150)
        made = [f"{name}(" for name, _ in named]  # a dataclass without words gets its signature
        self.assertEqual([name for name, each in named if not (each.__doc__ or "").strip() or each.__doc__.startswith(tuple(made))], [])


class RunTest(unittest.TestCase):
    def test_a_scenario_gives_results_pins_and_telegrams(self):
        with tempfile.TemporaryDirectory() as folder:
            wave = pathlib.Path(folder) / "run.vcd"
            result = dsdpv1.run(SCENARIO, changes=True, telegrams=True, settings=SHORT, wave=wave)
            text = wave.read_text(encoding="utf-8")
        self.assertEqual(result.simulated, 11 * MS)
        self.assertFalse(result.passed)  # what the scenario expects comes later
        self.assertEqual(result.data["telegrams"], len(result.telegrams))
        self.assertEqual(result.slaves, ("demo",))
        self.assertIn("demo", result.report)
        self.assertIn("Set_Prm", [each.service for each in result.telegrams])
        for pin in ("INTR0", "PBTXD", "L_REQ"):
            self.assertEqual(self.of_wave(text, pin), [(tick, level) for tick, _, _, level in result.pin(pin).tolist() if tick > 0], pin)
        line = result.pin("LINE")
        self.assertEqual(line["tick"][line["level"] == 0][0], result.telegrams[0].start)

    @staticmethod
    def of_wave(text, pin):
        """Changes of a pin in a VCD after its start, in ticks."""
        code = re.search(rf"\$var \w+ 1 (\S+) {pin} ", text).group(1)
        found, now = [], 0
        for line in text.partition("$enddefinitions $end")[2].splitlines():
            if line.startswith("#"):
                now = int(line[1:])
            elif line[1:] == code and line[0] in "01" and now > 0:
                found.append((round(now * 12 / 1000), int(line[0])))
        return found

    def test_the_document_shows_what_can_be_run(self):
        text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
        lines = re.search(r"## A scenario\n\n```python\n(.*?)```", text, re.S).group(1).splitlines()
        scope = {"dsdpv1": dsdpv1}
        exec(lines[0].replace("scenarios/", f"{ROOT}/scenarios/"), scope)  # pylint: disable=exec-used
        for line in lines[1:]:
            expression, comment = (part.strip() for part in line.split("#", 1))
            with PANDAS:
                value = eval(expression, scope)  # pylint: disable=eval-used
            self.assertTrue(len(value) > 0 if hasattr(value, "__len__") else value, line)
            if "..." in comment:  # the value, cut
                self.assertEqual(value[:len(comment) - 3], comment[:-3], line)

    def test_engines_give_the_same_changes(self):
        one, other = (dsdpv1.run(SCENARIO, changes=True, settings=SHORT, engine=engine).changes for engine in ("skip", "step"))
        self.assertGreater(len(one), 10_000)
        self.assertTrue((np.sort(one, order=["tick", "station", "pin"]) == np.sort(other, order=["tick", "station", "pin"])).all())

    def test_a_run_can_be_watched_and_stopped(self):
        run = dsdpv1.Run(SCENARIO)
        events, telegrams = [], []
        run.on_event(events.append)
        run.on_telegram(telegrams.append)
        result = run.execute(poll=lambda now: now < 2 * MS)
        self.assertTrue(result.interrupted)
        self.assertLess(result.simulated, 3 * MS)
        self.assertEqual(len(telegrams), result.data["telegrams"])
        self.assertIn("INITIALISED", [each.code for each in events])
        with self.assertRaises(dsdpv1.StateError):
            run.execute()

    def test_a_poll_that_raises_stops_the_run(self):
        def fails(_now):
            raise KeyError("of the poll")

        with self.assertRaisesRegex(KeyError, "of the poll"):
            dsdpv1.Run(SCENARIO).execute(poll=fails)

    def test_telegrams_become_a_table_where_pandas_is(self):
        result = dsdpv1.run(SCENARIO, telegrams=True, settings=SHORT)
        with PANDAS:
            rows = result.telegram_table()
        self.assertEqual(len(rows), len(result.telegrams))
        self.assertEqual(set(rows[0]), {"start_us", "end_us", "tsdr_bits", "station", "error", "service", "line", "bytes"})


class DemoTest(unittest.TestCase):
    """python -m dsdpv1, where NumPy cannot be imported."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        (pathlib.Path(self.folder.name) / "numpy.py").write_text("raise ImportError('not here')\n", encoding="utf-8")

    def call(self, *words):
        path = os.pathsep.join((self.folder.name, os.environ.get("PYTHONPATH", "")))
        return subprocess.run([sys.executable, "-m", "dsdpv1", *words], cwd=self.folder.name, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False)

    def test_it_prints_the_table_and_says_where_its_files_are(self):
        for _ in ("first", "again"):
            done = self.call("demo")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("\nPASSED\n", done.stdout)
            for ending in ("vcd", "log", "json"):
                file = pathlib.Path(self.folder.name, "out", f"power_on_12m.{ending}")
                self.assertIn(str(file), done.stdout)
                self.assertGreater(file.stat().st_size, 10000)

    def test_alone_it_prints_its_help(self):
        done = self.call()
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("demo", done.stderr)

    def test_what_is_wrong_is_one_line(self):
        (pathlib.Path(self.folder.name) / "file").touch()
        (pathlib.Path(self.folder.name) / "full/power_on_12m.vcd").mkdir(parents=True)
        for words in (["dmeo"], ["demo", "now"], ["demo", "--out", "file"], ["demo", "--out", "/proc/nowhere"], ["demo", "--out", "full"]):
            done = self.call(*words)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)

    def test_what_needs_numpy_says_so(self):
        path = os.pathsep.join((self.folder.name, os.environ.get("PYTHONPATH", "")))
        done = subprocess.run([sys.executable, "-c", "import dsdpv1; dsdpv1.CHANGE"], env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False)
        self.assertIn("ImportError: not here", done.stderr)


if __name__ == "__main__":
    os.chdir(ROOT)
    unittest.main(verbosity=1)
