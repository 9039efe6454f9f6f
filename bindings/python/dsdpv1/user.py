# SPDX-FileCopyrightText: 2026 the dsdpv1 authors
# SPDX-License-Identifier: Apache-2.0
"""The user CPU's side of a DSDPV1: the handshake and the blocks of the DPRAM.

Programs of a user are generators of actions, so that the same programs run on a Chip (User, here) and, in a simulator, on a DUT's pins
(cocotbext.profibus.HostPort). A program yields an action and receives its answer; the driver of the pins determines the times between actions.
"""
import dataclasses
import typing

from . import registers as reg
from .chip import AccessTiming, Chip
from .errors import Error
from .gsd import Slave
from .units import CYCLE, NS, US

SYNC_WINDOW = 63 * NS  # H2: after R_REQ rose the chip may still begin an access for 62.5 ns
POLLS = 10_000  # of a flag or pin before the chip counts as dead


class UserError(Error):
    """The chip did not respond as expected, or refused a block."""


class Set(typing.NamedTuple):
    """Sets an input of the chip."""

    pin: str
    level: int


class Level(typing.NamedTuple):
    """Samples an output. Answer: its level."""

    pin: str


class Wait(typing.NamedTuple):
    """Waits for this number of ticks."""

    ticks: int


class Read(typing.NamedTuple):
    """Reads a cell through the pins. Answer: its value."""

    cell: int


class Write(typing.NamedTuple):
    """Writes a cell through the pins."""

    cell: int
    value: int


Action = typing.Union[Set, Level, Wait, Read, Write]
T = typing.TypeVar("T")
Program = typing.Generator[Action, int, T]


def crc16(data: bytes) -> int:
    """CRC of a block (4.2, D2): polynomial 0xA001 reflected, initial value 0xFFFF; 02 07 gives 0x1241."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return crc


# ---- the handshake
def take() -> Program[None]:
    """Takes the DPRAM: R_REQ, the window, L_REQ and L_STA sampled low, R_STA (H2)."""
    yield Set("R_REQ", 1)
    yield Wait(SYNC_WINDOW)
    for _ in range(POLLS):
        if (yield Level("L_REQ")) == 0 and (yield Level("L_STA")) == 0:
            break
        yield Wait(50 * NS)
    else:
        raise UserError("the chip did not release the DPRAM: L_REQ or L_STA stays high")
    yield Set("R_STA", 1)
    yield Wait(CYCLE)


def release() -> Program[None]:
    """Releases the DPRAM: both low."""
    yield Set("R_STA", 0)
    yield Set("R_REQ", 0)


def hold(program: Program[T]) -> Program[T]:
    """A program with the DPRAM taken before and released after it."""
    yield from take()
    result = yield from program
    yield Write(reg.ACCESS_COUNT, (yield Read(reg.ACCESS_COUNT)) + 1 & 0xFF)  # 4.1: each access of a side to the DPRAM counts it
    yield from release()
    return result


def write_block(cell: int, data: bytes, crc_cell: int) -> Program[None]:
    """Writes a block and its CRC; in a hold."""
    crc = crc16(data)
    for offset, byte in enumerate(data):
        yield Write(cell + offset, byte)
    yield Write(crc_cell, crc >> 8)
    yield Write(crc_cell + 1, crc & 0xFF)


def read_bytes(cell: int, count: int) -> Program[bytes]:
    """Reads some cells; in a hold."""
    data = bytearray()
    for offset in range(count):
        data.append((yield Read(cell + offset)))
    return bytes(data)


def read_cell(cell: int) -> Program[int]:
    """Reads one cell; in a hold."""
    return (yield Read(cell))


# ---- start-up and initialisation (chapter 8)
@dataclasses.dataclass(frozen=True)
class Initialisation:
    """Block B020 (table 12). The modes select who judges parameters and configuration."""

    address: int  # 0 to 126
    ident: int
    cfg: bytes  # 1 to 200 bytes
    max_input: int  # 0 to 244 bytes
    max_output: int
    max_diag: int = 32  # 0 to 238
    max_prm: int = 237  # 0 to 237
    max_cfg: int = 200
    prm_mode: int = 0
    cfg_mode: int = 0
    command: int = reg.INIT_COMMAND_ADDRESS_CHANGE | reg.INIT_COMMAND_FREEZE | reg.INIT_COMMAND_SYNC | reg.INIT_COMMAND_FAIL_SAFE
    dpv1: bool = False

    @classmethod
    def of(cls, slave: Slave, **members: typing.Any) -> "Initialisation":
        """Makes the data that a master needs about this slave."""
        made = {"address": slave.address, "ident": slave.ident, "cfg": slave.cfg, "max_input": slave.input_length, "max_output": slave.output_length,
                "dpv1": slave.dpv1}
        return cls(**{**made, **members})

    def block(self) -> bytes:
        """The block from B020 on; B020 counts the following bytes."""
        head = [self.address, self.ident >> 8, self.ident & 0xFF, self.command, 0, 0, self.max_input, self.max_output, self.max_diag, self.max_prm,
                self.prm_mode, self.max_cfg, self.cfg_mode, len(self.cfg)]
        return bytes([len(head) + len(self.cfg), *head]) + self.cfg


def wait_ready() -> Program[None]:
    """After RESET rose: polls B004 until the chip's start-up is complete (D1)."""
    yield Wait(1 * US)  # H6: a request that is high as the chip leaves its reset prevents its start-up
    for _ in range(POLLS):
        if (yield from hold(read_cell(reg.VALID_FLAG))) == reg.VALID_FLAG_VALID:
            return
        yield Wait(10 * US)
    raise UserError("B004 did not become 0xC5")


def _write_initialisation(init: Initialisation) -> Program[None]:
    yield Write(reg.DPV1_ENABLE, reg.DPV1_ENABLE_ON if init.dpv1 else 0)
    yield from write_block(reg.INIT, init.block(), reg.INIT_CRC)
    yield Write(reg.CHIP_STATUS_1, 0)
    yield Write(reg.USER_COMMAND_1, reg.USER_COMMAND_1_INIT)


def _initialised() -> Program[typing.Optional[bool]]:
    """In a hold: returns None until the chip has read the block."""
    if (yield Read(reg.USER_COMMAND_1)) & reg.USER_COMMAND_1_INIT:
        return None
    return bool((yield Read(reg.CHIP_STATUS_1)) & reg.CHIP_STATUS_1_INITIALISED)


def initialise(init: Initialisation) -> Program[None]:
    """Writes the block and waits for the chip's answer, B00A.0. UserError: refused."""
    yield from hold(_write_initialisation(init))
    for _ in range(POLLS):
        yield Wait(2 * US)
        answer = yield from hold(_initialised())
        if answer is not None:
            break
    if not answer:
        raise UserError("the chip " + ("has not looked at the initialisation" if answer is None else "refused the initialisation (D11)"))


# ---- cyclic data
def _exchange(inputs: typing.Optional[bytes]) -> Program[typing.Optional[bytes]]:
    if inputs is not None:
        yield from write_block(reg.INPUT_LENGTH, bytes([len(inputs)]) + inputs, reg.INPUT_CRC)
        command = yield Read(reg.USER_COMMAND_1)
        yield Write(reg.USER_COMMAND_1, command | reg.USER_COMMAND_1_INPUT)
    command = yield Read(reg.CHIP_COMMAND_1)
    if not command & reg.CHIP_COMMAND_1_OUTPUT:
        return None
    length = yield Read(reg.OUTPUT_LENGTH)
    block = bytes([length]) + (yield from read_bytes(reg.OUTPUT_DATA, length))
    crc = yield from read_bytes(reg.OUTPUT_CRC, 2)
    yield Write(reg.CHIP_COMMAND_1, command & ~reg.CHIP_COMMAND_1_OUTPUT & 0xFF)
    if int.from_bytes(crc, "big") != crc16(block):
        raise UserError("the outputs have a wrong CRC")
    return block[1:]


def exchange(inputs: typing.Optional[bytes] = None) -> Program[typing.Optional[bytes]]:
    """Transfers inputs to the chip and outputs from it in one hold; returns None without new outputs. `inputs` have the configured length (D10)."""
    return hold(_exchange(inputs))


# ---- acyclic requests (7.2, 7.3)
SERVICES = {reg.FUNCTION_NUM_READ: "read", reg.FUNCTION_NUM_WRITE: "write", reg.FUNCTION_NUM_TRANSPORT: "transport"}


@dataclasses.dataclass(frozen=True)
class Request:
    """A master's acyclic request."""

    master_class: int  # 1: MSAC_C1, 2: MSAC_C2
    service: str  # "read", "write", "transport"
    slot: int
    index: int
    length: int  # read: bytes requested
    data: bytes  # write, transport


class Refuse(Exception):
    """Raised by a handler to refuse the request (tables 28, 29)."""

    def __init__(self, error_code_1: int, error_code_2: int = 0) -> None:
        """`error_code_1`: 0xB0 invalid index, 0xB2 invalid slot, 0xB6 access denied, ..."""
        super().__init__(f"refused with {error_code_1:02X} {error_code_2:02X}")
        self.codes = bytes([error_code_1, error_code_2])


# Returns the bytes read or transported; its result for a write is ignored.
Handler = typing.Callable[[Request], typing.Optional[bytes]]


class _Area(typing.NamedTuple):
    """The requests and answers of one class in the DPRAM."""

    master_class: int
    cell: int
    crc: int
    asked: int  # bit of CHIP_COMMAND_2
    answered: int  # bit of USER_COMMAND_2


AREAS = (_Area(1, reg.C1, reg.C1_CRC, reg.CHIP_COMMAND_2_C1, reg.USER_COMMAND_2_C1),
         _Area(2, reg.C2, reg.C2_CRC, reg.CHIP_COMMAND_2_C2, reg.USER_COMMAND_2_C2))
_HEADER = 4  # Function_Num, slot, index, length


def _fetch(area: _Area) -> Program[typing.Optional[bytes]]:
    """In a hold: returns header and data of a request and clears its bit; None without one."""
    command = yield Read(reg.CHIP_COMMAND_2)
    if not command & area.asked:
        return None
    header = yield from read_bytes(area.cell, _HEADER)
    data = b"" if header[0] == reg.FUNCTION_NUM_READ else (yield from read_bytes(area.cell + _HEADER, header[3]))
    crc = yield from read_bytes(area.crc, 2)
    yield Write(reg.CHIP_COMMAND_2, command & ~area.asked & 0xFF)
    if int.from_bytes(crc, "big") != crc16(header + data):
        raise UserError(f"the request of class {area.master_class} has a wrong CRC")
    return header + data


def _send(area: _Area, block: bytes) -> Program[None]:
    """In a hold. Does not overwrite a newer request with the answer to an earlier one (V13)."""
    if not (yield Read(reg.CHIP_COMMAND_2)) & area.asked:
        command = yield Read(reg.USER_COMMAND_2)
        yield from write_block(area.cell, block, area.crc)
        yield Write(reg.USER_COMMAND_2, command | area.answered)


def _answer(request: Request, header: bytes, handler: Handler) -> bytes:
    try:
        data = handler(request) or b""
    except Refuse as refused:
        return bytes([header[0] | 0x80, 0x80]) + refused.codes
    if request.service == "write":
        return header  # with the length written (V5)
    return header[:3] + bytes([len(data)]) + data


def serve(handler: Handler) -> Program[int]:
    """Answers waiting requests of both classes with the result of `handler`, which may raise Refuse; returns their number."""
    served = 0
    for area in AREAS:
        block = yield from hold(_fetch(area))
        if block is None:
            continue
        request = Request(area.master_class, SERVICES[block[0]], block[1], block[2], block[3], block[_HEADER:])
        yield from hold(_send(area, _answer(request, block[:_HEADER], handler)))
        served += 1
    return served


# ---- on a chip
class User:
    """The user CPU of a Chip: runs programs on its pins, action by action."""

    def __init__(self, chip: Chip, timing: typing.Optional[AccessTiming] = None, pin_time: int = 50 * NS) -> None:
        """`timing` of accesses; `pin_time`: ticks for setting or reading a handshake pin."""
        self.chip, self._timing, self._pin_time = chip, timing, pin_time

    def wait(self, ticks: int) -> None:
        """Advances the chip, or its bus."""
        self.chip.advance(self.chip.now + ticks)

    def act(self, action: Action) -> int:
        """Executes one action; returns its answer, or 0."""
        if isinstance(action, Read):
            return self.chip.read(action.cell, timing=self._timing)
        if isinstance(action, Write):
            self.chip.write(action.cell, action.value, timing=self._timing)
            return 0
        if isinstance(action, Wait):
            self.wait(action.ticks)
            return 0
        if isinstance(action, Set):
            self.chip.set(action.pin, action.level)
        self.wait(self._pin_time)
        return self.chip.level(action.pin)

    def run(self, program: Program[T]) -> T:
        """Executes a whole program; returns its result."""
        answer = None
        while True:
            try:
                answer = self.act(program.send(answer) if answer is not None else next(program))
            except StopIteration as end:
                return typing.cast(T, end.value)

    def power_on(self, init: typing.Optional[Initialisation] = None) -> None:
        """Raises RESET, waits for the chip's start-up, and executes the initialisation, if given."""
        self.chip.set("RESET", 1)
        self.run(wait_ready())
        if init is not None:
            self.run(initialise(init))

    def exchange(self, inputs: typing.Optional[bytes] = None) -> typing.Optional[bytes]:
        """Writes inputs to the chip and returns new outputs."""
        return self.run(exchange(inputs))

    def serve(self, handler: Handler) -> int:
        """Answers the waiting acyclic requests with `handler`; returns their number."""
        return self.run(serve(handler))

    def read(self, cell: int) -> int:
        """Reads a cell in a separate hold."""
        return self.run(hold(read_cell(cell)))
