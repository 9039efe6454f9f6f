"""Uses made-up output of nm, to see that call_circle.py finds circles and nothing else."""
import unittest

import call_circle


def listing(defines=(), needs=(), inside=()):
    rows = [f"{name} T 0 10" for name in defines] + [f"{name} U" for name in needs] + [f"{name} t 0 10" for name in inside]
    return "\n".join(rows) + "\n"


class Calls(unittest.TestCase):
    def expect(self, listings, *faults):
        self.assertEqual(list(call_circle.check(listings)), list(faults))

    def test_files_one_above_the_other(self):
        self.expect({"low.c": listing(["hold"], ["memcpy"]), "middle.c": listing(["fetch"], ["hold"]),
                     "high.c": listing(["service"], ["fetch", "hold"])})

    def test_two_files_that_call_each_other(self):
        self.expect({"low.c": listing(["hold"], ["service"]), "high.c": listing(["service"], ["hold"])},
                    "high.c: calls hold of low.c, which leads back here",
                    "low.c: calls service of high.c, which leads back here")

    def test_a_circle_of_three_and_the_files_that_only_lead_into_it(self):
        self.expect({"a.c": listing(["a"], ["b"]), "b.c": listing(["b"], ["c", "z"]),
                     "c.c": listing(["c"], ["d"]), "d.c": listing(["d"], ["b"]), "z.c": listing(["z"])},
                    "b.c: calls c of c.c, which leads back here",
                    "c.c: calls d of d.c, which leads back here",
                    "d.c: calls b of b.c, which leads back here")

    def test_two_files_may_have_functions_of_one_name_for_themselves(self):
        self.expect({"a.c": listing(["a"], ["b"], ["note"]), "b.c": listing(["b"], [], ["note"])})

    def test_a_file_reached_twice_is_no_circle(self):
        self.expect({"a.c": listing(["a"], ["b", "c"]), "b.c": listing(["b"], ["d"]), "c.c": listing(["c"], ["d"]), "d.c": listing(["d"])})

    def test_files_that_are_not_the_driver(self):
        self.expect({"a.c": listing(["a"]), "b.c": listing(["b"])}, "no file calls another: that is not the driver")


if __name__ == "__main__":
    unittest.main()
