"""Plants errors into the inputs of ./run static's tools, and checks that each tool finds them and nothing else."""
import pathlib
import tempfile
import unittest

import memory
import misra
import stack


def node(title, words):
    return f'node: {{ title: "{title}" label: "{title}\\nf.c:1:1{words}" }}\n'


def edge(caller, called, place=""):
    label = f' label: "{place}"' if place else ""
    return f'edge: {{ sourcename: "{caller}" targetname: "{called}"{label} }}\n'


def depths(text, port="spi"):
    graph = stack.Graph()
    graph.read(text)
    return stack.Depths(graph, port)


class Stack(unittest.TestCase):
    def test_the_deepest_path_counts_and_the_library_does_not(self):
        text = node("a", "\\n8 bytes (static)") + node("b", "\\n16 bytes (static)") + node("c", "\\n100 bytes (static)") + node("d", "\\n24 bytes (static)")
        text += edge("a", "b") + edge("a", "c", "f.c:2:2") + edge("b", "d") + edge("b", "memcpy", "f.c:3:3")
        self.assertEqual(depths(text).of("a").bytes, 108)
        self.assertEqual(depths(text.replace("100 bytes", "20 bytes")).of("a").bytes, 48)

    def test_a_circle_an_unknown_function_and_a_frame_of_any_size(self):
        a, b = node("a", "\\n8 bytes (static)"), node("b", "\\n8 bytes (static)")
        for text, words in ((a + b + edge("a", "b") + edge("b", "a"), "call themselves"), (a + edge("a", "b"), "b is nowhere"),
                            (a + edge("a", stack.INDIRECT), "does not say where"), (a + node("b", "\\n8 bytes (dynamic)"), "dynamic")):
            with self.subTest(words), self.assertRaisesRegex(stack.Unknown, words):
                depths(text).of("a")

    def test_what_a_pointer_calls(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "f.c").write_text("  if (device->link->get(device, a)) wire->recover(device);\n  x = handler(object->ctx);\n", encoding="utf-8")
            self.assertEqual(stack.pointer_called("f.c:1:7", root), ("link", "get"))
            self.assertEqual(stack.pointer_called("f.c:1:37", root), ("wire", "recover"))
            self.assertEqual(stack.pointer_called("f.c:2:7", root), ("", "handler"))
            with self.assertRaisesRegex(stack.Unknown, "no call of a pointer"):
                stack.pointer_called("f.c:2:3", root)

    def test_a_pointer_of_the_port_leads_into_its_file(self):
        graph = stack.Graph()
        graph.read(node("driver/dsdpv1_spi.c:pass_time", "\\n40 bytes (static)") + node("driver/dsdpv1_uart.c:pass_time", "\\n16 bytes (static)"))
        self.assertEqual([stack.Depths(graph, port).of_port("pause") for port in ("spi", "uart")],
                         [["driver/dsdpv1_spi.c:pass_time"], ["driver/dsdpv1_uart.c:pass_time"]])
        self.assertEqual(stack.Depths(graph, "parallel").of_port("exchange"), [])  # which has none
        with self.assertRaisesRegex(stack.Unknown, "hold is nowhere in the graph"):
            stack.Depths(graph, "spi").of_port("hold")

    def test_the_public_functions_are_those_of_the_headers(self):
        found = stack.public_functions()
        self.assertEqual((found["dsdpv1_exchange"], found["dsdpv1_open_spi"], found["dsdpv1_open_uart"]), (stack.PORTS, ("spi",), ("uart",)))
        self.assertGreater(len(found), 15)


class Misra(unittest.TestCase):
    REPORT = misra.Report("17.7", "driver/a.c", 3, "release(device);")
    WHY = "17.7 | driver/a.c | release( | because\n"

    def faults(self, reports, text):
        return list(misra.judge(reports, misra.deviations("# a comment\n" + text)))

    def test_what_is_explained_is_right_and_advisory_rules_need_no_words(self):
        self.assertEqual(self.faults([self.REPORT], self.WHY), [])
        self.assertEqual(self.faults([self.REPORT, misra.Report("15.5", "driver/a.c", 4, "return a;")], self.WHY), [])
        self.assertEqual(self.faults([self.REPORT], self.WHY.replace("driver/a.c", "*").replace("release(", "*")), [])

    def test_what_is_not_explained_and_explanations_of_nothing(self):
        self.assertEqual(self.faults([self.REPORT], ""), ["driver/a.c:3: rule 17.7 of MISRA C:2012, and misra_deviations.txt does not say why: release(device);"])
        for other in (("17.7", "10.4"), ("driver/a.c", "driver/b.c"), ("release(", "hold(")):
            self.assertEqual(len(self.faults([self.REPORT], self.WHY.replace(*other))), 2, other)

    def test_a_line_that_is_no_deviation(self):
        with self.assertRaisesRegex(ValueError, "txt:2: has 3 fields"):
            self.faults([], "17.7 | driver/a.c | because\n")

    def test_reports_are_read_with_their_lines(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "a.c").write_text("int a;\n  int b;\n", encoding="utf-8")
            said = "[a.c:2] (style) misra violation (use --rule-texts=<file>) (Undefined) [misra-c2012-2.7]\n[a.c:2] [misra-c2012-2.7]\n[a.c:1] [unusedVariable]\n"
            self.assertEqual(misra.reports_in(said, root), [misra.Report("2.7", "a.c", 2, "int b;")])


class Memory(unittest.TestCase):
    RIGHT = "==7== LEAK SUMMARY:\n==7== ERROR SUMMARY: 0 errors from 0 contexts\n"

    def test_errors_of_all_processes_are_counted(self):
        wrong = "==8== Invalid read of size 4\n==8==    at 0x1: f (a.cpp:1)\n==8== ERROR SUMMARY: 2 errors from 1 contexts\n"
        self.assertEqual(memory.errors_in([self.RIGHT]), (0, ""))
        self.assertEqual(memory.errors_in([self.RIGHT, wrong]), (2, "Invalid read of size 4"))

    def test_of_a_process_that_became_the_shell_only_what_it_did_before_counts(self):
        head = "==9== Memcheck, a memory error detector\n"
        self.assertIsNone(memory.errors_in([])[0])
        self.assertIsNone(memory.errors_in([head])[0])
        self.assertEqual(memory.errors_in([self.RIGHT, head]), (0, ""))
        self.assertEqual(memory.errors_in([self.RIGHT, head + "==9== Invalid write of size 1\n"]), (1, "Invalid write of size 1"))


if __name__ == "__main__":
    unittest.main()
