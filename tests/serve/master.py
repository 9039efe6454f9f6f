"""pyprofibus as DP master class 1, in a separate process: started by bench.py, reports to it in lines on standard output.

    python master.py PLAN.json

Each line that begins with '{' is an event: an exchange {"slave", "cycle", "sent", "got"}, {"did": ...}, or {"done": true}.
All other lines are pyprofibus's own words.
"""
import json
import sys

import pyprofibus
import pyprofibus.dp_master
import pyprofibus.phy
import pyprofibus.phy_serial
import pyprofibus.util

import lateness


def write_configuration(plan):
    lines = ["[PROFIBUS]", "debug=%d" % plan.get("debug", 1),
             "[PHY]", "type=serial", "dev=" + plan["port"], "baud=%d" % plan["baud"],
             "[DP]", "master_class=1", "master_addr=2"]
    for index, slave in enumerate(plan["slaves"]):
        lines += ["[SLAVE_%d]" % index, "name=" + slave["name"], "addr=%d" % slave["address"], "gsd=" + plan["gsd"],
                  "sync_mode=%d" % slave.get("sync", 0), "freeze_mode=%d" % slave.get("freeze", 0), "group_mask=1",
                  "watchdog_ms=%d" % slave.get("watchdog", 1000), "output_size=%d" % slave["inputs"],
                  "input_size=%d" % slave["outputs"], "diag_period=0"]
    path = plan["folder"] + "/master.conf"
    with open(path, "w", encoding="UTF-8") as file:
        file.write("\n".join(lines) + "\n")
    return path


def slow_down(factor, watch):
    """pyprofibus's time limits are fixed (10 ms to 100 ms). Where a busy machine cannot keep them, its clock runs slower. The clock measures
    lateness,
    because pyprofibus's loop reads it at least once per turn."""
    def clock():
        return watch.clock() / factor
    for module in (pyprofibus.dp_master, pyprofibus.phy, pyprofibus.phy_serial, pyprofibus.util):
        if hasattr(module, "monotonic_time"):
            module.monotonic_time = clock


def tell(**event):
    print(json.dumps(event), flush=True)


def describe(config, plan):
    """Slave descriptions with the plan's modules, groups and deliberate mistakes."""
    for conf, slave in zip(config.slaveConfs, plan["slaves"]):
        conf.gsd.clearConfiguredModules()  # the GSD file's presets would be added otherwise
        for module in slave["modules"]:
            conf.gsd.setConfiguredModule(module)
        description = conf.makeDpSlaveDesc()
        description.setGroupMask(slave.get("group", 1))
        if "ident" in slave:
            description.setPrmTelegram.identNumber = slave["ident"]
        yield description


class Cycles:
    """Counts the exchanges of each slave and makes their outputs: the number of the exchange in every pair of bytes."""

    def __init__(self, master, plan):
        self.master = master
        self.plan = plan
        self.count = {slave["name"]: 0 for slave in plan["slaves"]}
        self.actions = list(plan.get("actions", []))

    def outputs(self, slave):
        return bytearray((self.count[slave.name] >> (8 * (i % 2)) & 0xFF) for i in range(slave.inputSize))

    def exchanged(self, slave, got):
        cycle = self.count[slave.name]
        tell(slave=slave.name, cycle=cycle, sent=self.outputs(slave).hex(), got=bytes(got).hex())
        self.count[slave.name] = cycle + 1
        while self.actions and min(self.count.values()) >= self.actions[0]["at"]:
            action = self.actions.pop(0)
            getattr(self.master, action["do"])(action["group"])
            tell(did=action["do"], group=action["group"], cycles=self.count)

    def finished(self):
        return min(self.count.values()) >= self.plan["cycles"]


def run(plan):
    slow_down(plan["slower"], lateness.Watch(plan["late"]))
    config = pyprofibus.PbConf.fromFile(write_configuration(plan))
    master = config.makeDPM()
    for description in describe(config, plan):
        master.addSlave(description)
    master.initialize()
    cycles = Cycles(master, plan)
    while not cycles.finished():
        for slave in master.getSlaveList():
            slave.setMasterOutData(cycles.outputs(slave))
        try:
            slave = master.run()
        except pyprofibus.ProfibusError as error:
            tell(error=str(error))
            continue
        got = slave.getMasterInData() if slave else None
        if got is not None:
            cycles.exchanged(slave, got)
    tell(done=True)
    master.destroy()


if __name__ == "__main__":
    with open(sys.argv[1], encoding="UTF-8") as plan_file:
        run(json.load(plan_file))
