"""A golden trace as stimulus for a chip, and the expected outputs."""
GOLDEN, SLAVE = "bus_timing", "demo"  # power-on, initialisation, parameters, configuration, data exchange at 12 Mbit/s
END = 1_700_000_000  # ps, in data exchange
INPUTS = {"RESET": 1, "R_REQ": 1, "R_STA": 1, "CSR": 1, "RD": 1, "WR": 1, "A": 11, "D_IN": 8, "PBRXD": 1}
OUTPUTS = ("L_REQ", "L_STA", "D_OUT", "INTR0", "PBTXD", "PBRTS", "PBF", "BR", "READY")


def golden_changes(vcd):
    """(ps, pin, level) of one slave, 'z' and 'x' for all of a pin's wires."""
    names, scope, now = {}, "", 0
    for line in vcd.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[0] == "$scope":
            scope = words[2]
        elif words[0] == "$var" and scope == SLAVE:
            names[words[3]] = words[4]
        elif line[0] == "#":
            now = int(line[1:])
        elif line[0] == "b" and words[1] in names:
            yield now, names[words[1]], words[0][1:]
        elif line[0] in "01xz" and line[1:] in names:
            yield now, names[line[1:]], line[0]


def one_line(levels):
    """The bits of a line of inputs: D as whether it is driven and its value."""
    driven = "z" not in levels["D_IN"]
    words = {**levels, "D_IN": ("1" + levels["D_IN"].rjust(8, "0")) if driven else "0" * 9}
    return "".join(words[name].rjust(width, "0") for name, width in INPUTS.items())


def write_inputs(vcd, path, end=END):
    levels, lines = {name: "0" for name in INPUTS}, {}
    for now, name, value in golden_changes(vcd):
        if name in levels and now < end:
            levels[name] = value
            lines[now] = one_line(levels)
    lines[end] = one_line(levels)
    path.write_text("".join(f"{now} {bits}\n" for now, bits in lines.items()), encoding="ascii")
