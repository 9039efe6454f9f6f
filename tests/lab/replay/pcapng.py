"""Packets of a capture that dsdpv1-sim has written, for tests that change some of them."""
import struct

PACKET = 6
BITS = {"12M": 12e6, "6M": 6e6, "3M": 3e6, "1.5M": 1.5e6, "500k": 500e3, "187.5k": 187.5e3, "93.75k": 93.75e3, "45.45k": 1e6 / 22,
        "19.2k": 19.2e3, "9.6k": 9.6e3}


class Packet:
    def __init__(self, body):
        self.interface, high, low, length, _ = struct.unpack_from("<IIIII", body)
        self.ns = (high << 32 | low)
        self.data = bytearray(body[20:20 + length])

    def block(self):
        padded = bytes(self.data) + bytes(-len(self.data) % 4)
        body = struct.pack("<IIIII", self.interface, self.ns >> 32, self.ns & 0xFFFFFFFF, len(self.data), len(self.data)) + padded
        size = len(body) + 12
        return struct.pack("<II", PACKET, size) + body + struct.pack("<I", size)

    def change(self, at, value):
        """Sets a byte of an SD2 telegram, and its FCS."""
        self.data[at] = value
        self.data[-2] = sum(self.data[4:-2]) % 256


def read(path):
    """The blocks before the packets, and the packets. Flags and comments of packets are dropped."""
    content, head, packets, at = path.read_bytes(), b"", [], 0
    while at < len(content):
        kind, size = struct.unpack_from("<II", content, at)
        if kind == PACKET:
            packets.append(Packet(content[at + 8:at + size - 4]))
        else:
            head += content[at:at + size]
        at += size
    return head, packets


def write(path, head, packets):
    path.write_bytes(head + b"".join(packet.block() for packet in packets))


def classic(path, packets, unit):
    """As pcap with times of `unit` nanoseconds, 1 or 1000."""
    file = struct.pack("<IHHiIII", 0xA1B23C4D if unit == 1 else 0xA1B2C3D4, 2, 4, 0, 0, 65535, 257)
    for packet in packets:
        seconds, ns = divmod(packet.ns, 10**9)
        file += struct.pack("<IIII", seconds, ns // unit, len(packet.data), len(packet.data)) + bytes(packet.data)
    path.write_bytes(file)
