"""The smallest DP master class 1 over a socket to `serve`: it starts one slave and exchanges data with it."""
import os
import time

MASTER, SLAVE = 2, 8
IDENT = (0x0C, 0xC9)                         # scenarios/dsdpv1.gsd
PARAMETERS = bytes([0x80, 1, 1, 11, *IDENT, 0])  # locked, no watchdog: the next host finds the slave unchanged; min TSDR 11 bit times
CONFIGURATION = bytes([0x31])                # 2 bytes in, 2 bytes out; without consistency
SLAVE_DIAG, SET_PRM, CHK_CFG, MASTER_SAP = 60, 61, 62, 62
SHORT_ACKNOWLEDGE = b"\xe5"
FDL_STATUS = bytes([0x10, SLAVE, MASTER, 0x49, SLAVE + MASTER + 0x49, 0x16])
ASKED_EVERY_S = 0.02  # a slave that searches the baud rate hears a request only while it listens at the right rate
WANTED_S = 0.5  # time limit for an answer: thousands of slot times, because a busy computer is late


class Silent(Exception):
    """No answer, or an unsuitable one: the master begins again."""


def with_data(function, data, saps=()):
    """A telegram with SD2."""
    mark = 0x80 if saps else 0
    body = bytes([SLAVE | mark, MASTER | mark, function, *saps]) + data
    return bytes([0x68, len(body), len(body), 0x68]) + body + bytes([sum(body) & 0xFF, 0x16])


def length_of(begun):
    """Length of the telegram with this beginning; None when it is not known yet."""
    if begun[:1] == SHORT_ACKNOWLEDGE:
        return 1
    if begun[:1] == b"\x10":
        return 6
    if begun[:1] == b"\x68":
        return begun[1] + 6 if len(begun) > 1 else None
    raise Silent("no telegram begins with " + begun[:8].hex())


class DpHost:
    """Uses a socket exclusively. `repeats` counts requests without an answer."""

    def __init__(self, connection):
        self.fd = connection.fileno()
        os.set_blocking(self.fd, False)
        self.count_bit = None
        self.repeats = 0

    def function(self):
        """SRD high with the next frame count bit; the first without a valid one."""
        if self.count_bit is None:
            self.count_bit = False
            return 0x6D
        self.count_bit = not self.count_bit
        return 0x5D if self.count_bit else 0x7D

    def some(self):
        try:
            data = os.read(self.fd, 4096)
        except BlockingIOError:
            time.sleep(0.0005)
            return b""
        if not data:
            raise ConnectionResetError("serve has hung up")
        return data

    def answer(self):
        got, end = b"", time.monotonic() + WANTED_S
        while time.monotonic() < end:
            got += self.some()
            if got and (wanted := length_of(got)) and len(got) >= wanted:
                return got
        raise Silent("no answer, but " + (got.hex() or "nothing"))

    def find(self, within):
        """Repeats its request until the slave answers: it does so only when it is this host's turn and the slave has found the baud rate."""
        deadline, got = time.monotonic() + within, b""
        while not got:
            if time.monotonic() > deadline:
                raise Silent("not found after %d s" % within)
            os.write(self.fd, FDL_STATUS)
            end = time.monotonic() + ASKED_EVERY_S
            while not got and time.monotonic() < end:
                got = self.some()
        self.drop_late_answers()

    def drop_late_answers(self):
        end = time.monotonic() + 0.2
        while time.monotonic() < end:
            self.some()

    def forget(self):
        """Late answers belong to no request."""
        self.drop_late_answers()
        self.count_bit = None
        self.repeats += 1

    def request(self, data, saps=()):
        os.write(self.fd, with_data(self.function(), data, saps))
        return self.answer()

    def diagnosis(self):
        got = self.request(b"", (SLAVE_DIAG, MASTER_SAP))
        if len(got) < 17 or got[0] != 0x68:
            raise Silent("no diagnosis but " + got.hex())
        return got[9:-2]

    def acknowledged(self, sap, data):
        if (got := self.request(data, (sap, MASTER_SAP))) != SHORT_ACKNOWLEDGE:
            raise Silent("no acknowledgement but " + got.hex())

    def bring_up(self):
        """From any state to data exchange, in the order of a master: diagnosis, parameters, configuration, diagnosis."""
        self.diagnosis()
        self.acknowledged(SET_PRM, PARAMETERS)
        self.acknowledged(CHK_CFG, CONFIGURATION)
        deadline = time.monotonic() + 10
        while self.diagnosis()[0] & 0x07:  # not ready, wrong configuration, not present
            if time.monotonic() > deadline:
                raise Silent("not ready after 10 s")

    def exchange(self, outputs):
        got = self.request(outputs)
        if got[:1] != b"\x68" or len(got) != 11:
            raise Silent("no data but " + got.hex())
        return got[7:9]

    def insist(self, action, within):
        """Repeats the request until it is answered; Silent after `within` seconds."""
        deadline = time.monotonic() + within
        while True:
            try:
                return action()
            except Silent:
                if time.monotonic() > deadline:
                    raise
                self.forget()
