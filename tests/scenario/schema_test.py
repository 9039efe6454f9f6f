"""The schema for editors: shipped scenarios are right by it, and each kind of chip has its own keys.

    schema_test.py DSDPV1_SIM
"""
import json
import pathlib
import subprocess
import sys
import unittest

import jsonschema
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        schema = json.loads(subprocess.run([SIM, "schema"], check=True, capture_output=True).stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        cls.judge = jsonschema.Draft202012Validator(schema)

    def is_right(self, chip, user_cpu, order=None):
        script = [{"at": "1ms", "do": order, "slave": "s"}] if order else []
        slave = {"name": "s", "address": 5, "init": {"ident": 1, "cfg": "31"}, "user_cpu": user_cpu}
        return self.judge.is_valid({"name": "n", "baud": "12M", "end": "2ms", "chip": chip, "slaves": [slave], "script": script})

    def test_shipped_scenarios_are_right(self):
        for path in sorted((ROOT / "scenarios").glob("*.yaml")):
            with self.subTest(path.name):
                self.assertEqual([error.message for error in self.judge.iter_errors(yaml.safe_load(path.read_text(encoding="utf-8")))], [])

    def test_each_kind_has_its_own_keys_and_actions(self):
        rsu, plain = {"kind": "dsdpv1_rsu", "mode": "spi"}, {"kind": "dsdpv1_r"}
        self.assertTrue(self.is_right(rsu, {"spi": {"clock": 9000}}, "flip_bit"))
        self.assertTrue(self.is_right(plain, {}))
        self.assertFalse(self.is_right({**plain, "mode": "spi"}, {}))
        self.assertFalse(self.is_right(plain, {"spi": {"clock": 9000}}))
        self.assertFalse(self.is_right({}, {}, "flip_bit"))
        self.assertFalse(self.is_right({**rsu, "mode": "i2c"}, {}))

    def test_a_slave_with_a_chip_of_its_own_has_the_keys_of_that_chip(self):
        def with_own(own, user_cpu):
            slave = {"name": "s", "address": 5, "chip": own, "init": {"ident": 1, "cfg": "31"}, "user_cpu": user_cpu}
            return self.judge.is_valid({"name": "n", "baud": "12M", "end": "2ms", "chip": {"kind": "dsdpv1_r"}, "slaves": [slave]})

        self.assertTrue(with_own({"kind": "dsdpv1_rsu", "mode": "spi"}, {"spi": {"clock": 9000}}))
        self.assertFalse(with_own({"kind": "dsdpv1", "mode": "spi"}, {}))
        self.assertFalse(with_own({"kind": "dsdpv1"}, {"spi": {"clock": 9000}}))
        self.assertTrue(with_own({"rts_lead": 8}, {}))


if __name__ == "__main__":
    SIM = sys.argv[1]
    unittest.main(argv=[sys.argv[0], "-v"])
