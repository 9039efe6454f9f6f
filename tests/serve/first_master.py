#!/usr/bin/env python3
"""The smallest DP master for scenarios/serve_19k2.yaml: docs/pyprofibus.md.

    first_master.py PORT [EXCHANGES]

Counts in the two outputs and prints what comes back; without EXCHANGES until Ctrl-C.
"""
import io
import os
import sys

import pyprofibus

GSD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenarios", "dsdpv1.gsd")
CONFIGURATION = """
[PHY]
type=serial
dev=%s
baud=19200
[DP]
master_class=1
master_addr=2
[SLAVE_0]
name=echo
addr=8
gsd=%s
watchdog_ms=1000
output_size=2
input_size=2
"""


def main(port, exchanges=None):
    config = pyprofibus.PbConf(io.StringIO(CONFIGURATION % (port, GSD)))
    gsd = config.slaveConfs[0].gsd
    gsd.clearConfiguredModules()  # without this a module that the file presets would come first
    gsd.setConfiguredModule("2 bytes in, 2 bytes out")
    master = config.makeDPM()
    master.addSlave(config.slaveConfs[0].makeDpSlaveDesc())
    master.initialize()
    count = 0
    try:
        while exchanges is None or count < exchanges:
            outputs = bytearray(count.to_bytes(4, "little")[:2])
            for slave in master.getSlaveList():
                slave.setMasterOutData(outputs)
            slave = master.run()
            inputs = slave.getMasterInData() if slave else None
            if inputs is not None:
                print("sent", outputs.hex(), "received", inputs.hex(), flush=True)
                count += 1
    except KeyboardInterrupt:
        pass
    finally:
        master.destroy()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else None)
