"""Reports of runs in a real browser: a page shows the contents of the run's result and log, and sends no requests.

    page_test.py DSDPV1_SIM
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

from browser import browser

ROOT = pathlib.Path(__file__).resolve().parents[2]
EVIL = "</script><b id=evil>\"&'</b><img src=x onerror=alert(1)><!-- <script>"
# The checks whose limits stand in a timing diagram.
DIAGRAMS = {"take": ["OWNERSHIP_SYNC_WINDOW", "OWNERSHIP_BOTH_OWN", "OWNERSHIP_NOT_OWNER"], "give_back": ["OWNERSHIP_RELEASED_IN_ACCESS"],
            "read": ["TIMING_TC", "TIMING_TW"], "write": ["TIMING_TS", "TIMING_TD", "TIMING_ADDRESS_HOLD", "TIMING_DATA_HOLD", "TIMING_CSR"]}
TICKS = 12  # in a nanosecond
NAMES = """return [...document.querySelectorAll(arguments[0])].map(each => each.getAttribute(arguments[1]))"""
TEXTS = """return [...document.querySelectorAll(arguments[0])].map(each => each.textContent)"""
# Texts of charts that leave their drawing, or that lie on another text of the same one.
UNREADABLE = """
const faults = [];
for (const svg of document.querySelectorAll("svg")) {
  const room = svg.getBoundingClientRect();
  if (!room.width) continue;
  const texts = [...svg.querySelectorAll("text")].filter(each => each.textContent && !each.closest("[clip-path]") || each.classList.contains("span"));
  const boxes = texts.map(each => [each.getBoundingClientRect(), each.textContent]);
  boxes.forEach(([box, text], i) => {
    if (box.left < room.left - 12 || box.right > room.right + 14 || box.top < room.top - 8 || box.bottom > room.bottom + 4)
      faults.push(`${svg.getAttribute("class")}: ${text} leaves it`);
    for (const [other, otherText] of boxes.slice(i + 1))
      if (box.left < other.right - 1 && other.left < box.right - 1 && box.top < other.bottom - 4 && other.top < box.bottom - 4)
        faults.push(`${svg.getAttribute("class")}: ${text} lies on ${otherText}`);
  });
}
return faults;"""


def check(condition, what):
    if not condition:
        sys.exit(what)


def same(seen, expected, what):
    check(seen == expected, "%s: the page shows %s, expected is %s" % (what, seen, expected))


class Report:
    """A run with all that says what it was."""

    def __init__(self, program, folder, scenario, *words, status=0):
        stem = pathlib.Path(folder) / pathlib.Path(scenario).stem
        self.page, result, log = (stem.with_suffix(end) for end in (".html", ".json", ".jsonl"))
        done = subprocess.run([program, "run", scenario, "--quiet", "--no-progress", "--report", self.page, "--result", result, "--log", log, *words],
                              cwd=ROOT, capture_output=True, text=True, check=False)
        check(done.returncode == status, "%s: exit %d\n%s" % (scenario, done.returncode, done.stderr))
        self.result = json.loads(result.read_text(encoding="UTF-8"))
        self.telegrams = [each for line in log.read_text(encoding="UTF-8").splitlines() if (each := json.loads(line))["kind"] == "telegram"]

    def check_of(self, ident, slave=None):
        return next(each for each in self.result["checks"] if each["id"] == ident and slave in (None, each["slave"]))


def opened(page, report):
    """Opens it: no message, and nothing asked for but the page."""
    page.open(report.page)
    same(page.messages(), [], "messages")
    same([urllib.parse.unquote(each) for each in page.requests()], ["file://" + str(report.page)], "requests")


def facts(page, report):
    result, judged = report.result, [each for each in report.result["expectations"] if each["passed"] is not None]
    verdict = result["verdict_text"]
    check(page.run("return document.title").startswith("%s: %s (dsdpv1-sim " % (result["scenario"], verdict)), "title")
    same(page.run(TEXTS, ".verdict"), [verdict], "verdict")
    shown = dict(zip(page.run(TEXTS, "dt"), page.run(TEXTS, "dd")))
    same(shown["telegrams"], "%s right, %s wrong" % (f"{result['telegrams']:,}", f"{result['wrong_telegrams']:,}"), "telegrams")
    same(shown["expectations"], "%d of %d met" % (sum(each["passed"] for each in judged), len(judged)), "expectations")
    same(page.run(TEXTS, "#expectations tbody td:nth-child(2)"), [each["text"] for each in result["expectations"]], "expectations")
    same(page.run(TEXTS, "#stations .table:first-of-type tbody td:first-child"), [each["name"] for each in result["slaves"]], "slaves")


def counts(page):
    return [int(each) for each in page.run(NAMES, "g.telegram", "data-count")]


def shown_time(page):
    return [float(page.run("return document.querySelector('svg.telegrams').getAttribute(arguments[0])", each)) / TICKS for each in ("data-from", "data-to")]


def telegrams(page, report):
    """As many as the log has, all and in each part of time."""
    same(sum(counts(page)), len(report.telegrams), "telegrams of the chart")
    whole = shown_time(page)
    same(whole, [0, report.result["simulated_ns"]], "time of the chart")
    page.drag("svg.telegrams .overview .overlay", (-100, 0), (-60, 0))
    part = shown_time(page)
    check(whole[0] < part[0] < part[1] < whole[1], "the strip does not select: %s" % part)
    page.run("document.querySelector('svg.telegrams').focus()")
    for _ in range(4):
        page.wheel("svg.telegrams .ground", -300)
    begin, end = shown_time(page)
    check(end - begin < (part[1] - part[0]) / 4, "the wheel does not zoom: %s" % [begin, end])
    # The log has the time at which a telegram has ended.
    inside = [each for each in report.telegrams if begin + 1 < each["at_ns"] < end - 1]
    check(len(inside) <= sum(counts(page)) <= len(inside) + 2, "%d telegrams shown of %d" % (sum(counts(page)), len(inside)))
    check(inside and max(counts(page)) == 1, "telegrams do not stand alone when they are large: %s" % counts(page))
    page.click("section#telegrams .buttons button:last-child")
    same(shown_time(page), whole, "time of the whole chart")
    same(sum(counts(page)), len(report.telegrams), "telegrams of the whole chart")


def histograms(page, report):
    for slave in report.result["slaves"]:
        whose = "%s (%d)" % (slave["name"], slave["address"])
        bins = page.run(NAMES, "figure[data-title=TSDR][data-whose='%s'] .bin" % whose, "data-count")
        same(sum(int(each) for each in bins), slave["tsdr"]["answers"], "answers of " + whose)
        times = next(each for each in data(page)["times"] if each["title"] == "TSDR" and each["whose"] == whose)
        same([times["least"] / times["bit"], times["greatest"] / times["bit"]], [slave["tsdr"]["min_bits"], slave["tsdr"]["max_bits"]], "TSDR of " + whose)
        holds = sum(int(each) for each in page.run(NAMES, "figure[data-title^='Holds'][data-whose='%s'] .bin" % slave["name"], "data-count"))
        check(holds in (slave["handshake"]["user_holds"], slave["handshake"]["user_holds"] - 1), "%d holds of %s" % (holds, slave["name"]))


def data(page):
    return page.run("return run")


def margins(page, report):
    for slave in report.result["slaves"]:
        at = ".of-slave[data-slave=%s] g.margin" % slave["name"]
        shown = dict(zip(page.run(NAMES, at, "data-id"), map(float, page.run(NAMES, at, "data-margin"))))
        same(shown, {each["id"]: each["worst_margin_ns"] for each in report.result["checks"]
                     if each["slave"] == slave["name"] and each["worst_margin_ns"] is not None}, "margins of " + slave["name"])


def diagrams(page, report):
    """The instance shown is the one of which the checks tell."""
    slave = report.result["slaves"][0]["name"]
    same(page.run(NAMES, "section > .diagram", "data-id"), [*DIAGRAMS, "intr0", "answer"], "diagrams")
    for ident, rules in DIAGRAMS.items():
        shown = [float(each) for each in page.run(NAMES, ".diagram[data-id=%s][data-slave=%s] g.measured" % (ident, slave), "data-margin") if each]
        same(round(min(shown) / TICKS, 3), round(min(report.check_of(each, slave)["worst_margin_ns"] for each in rules), 3), "margin of " + ident)
    check(page.run("return document.querySelectorAll('.diagram .limit').length") >= 8, "the limits are not drawn")
    interrupt = ".diagram[data-id=intr0]"
    same(page.run(TEXTS, interrupt + " tbody tr:first-child td"), ["Tb, INTR0 low", "1.333 µs", "= 1.333 µs", "", "", "table 16, P7"], "Tb of table 16")
    check(page.run("return document.querySelectorAll(arguments[0]).length", interrupt + " .limit") >= 1, "Tb of table 16 is not drawn")
    before = page.run("return document.querySelector('.diagram .wire').getAttribute('d')")
    page.click(".diagram .buttons button")
    check(page.run("return document.querySelector('.diagram .wire').getAttribute('d')") != before, "a diagram does not zoom")


def readable(page):
    page.run("document.querySelectorAll('details').forEach(each => { each.open = true; })")
    for width in (1280, 800):
        page.resize(width, 1000)
        page.call("POST", "/execute/async", {"script": "requestAnimationFrame(() => setTimeout(arguments[0], 100))", "args": []})
        same(page.run(UNREADABLE), [], "texts at %d pixels" % width)
        check(page.run("return document.documentElement.scrollWidth") <= width, "wider than the window at %d pixels" % width)
    page.resize(1280, 1000)


def violations(page, report):
    """A picture each, in which is what the checks have kept of the pins."""
    listed = [(each, one) for each in report.result["checks"] for one in each["listed"]]
    check(listed, "the scenario has no violation any more")
    same(sorted(page.run(NAMES, "details.violation", "data-id")), sorted(each["id"] for each, _ in listed), "violations")
    page.run("document.querySelectorAll('details.violation').forEach(each => { each.open = true; })")
    page.call("POST", "/execute/async", {"script": "setTimeout(arguments[0], 100)", "args": []})
    same(page.run("return document.querySelectorAll('details.violation svg.timing').length"), len(listed), "pictures")
    pictures = {(each["check"], each["slave"], each["at"], each["text"]): each for each in data(page)["violations"]}
    compared = 0
    for rule, one in listed:
        picture = pictures[rule["id"], rule["slave"], round(one["at_ns"] * TICKS), one["text"]]
        steps = {(pin["name"], at, level) for pin in picture["pins"] for at, level in pin["steps"]}
        for change in one["history"]:
            at = round(change["at_ns"] * TICKS)
            if at <= picture["from"]:
                continue
            compared += 1
            check((change["pin"], at, change["level"]) in steps, "%s at %s: %s is not in its picture" % (rule["id"], one["at_ns"], change))
    check(compared > len(listed), "only %d changes compared" % compared)
    same(page.messages(), [], "messages")


def usual(program, folder, page):
    report = Report(program, folder, "scenarios/power_on_12m.yaml")
    opened(page, report)
    for each in (facts, telegrams, histograms, margins, diagrams):
        each(page, report)
    readable(page)


def several_slaves(program, folder, page):
    report = Report(program, folder, "scenarios/two_slaves.yaml")
    opened(page, report)
    for each in (facts, telegrams, histograms, margins):
        each(page, report)
    readable(page)


def violated(program, folder, page):
    report = Report(program, folder, "scenarios/violations.yaml")
    opened(page, report)
    facts(page, report)
    margins(page, report)
    violations(page, report)
    readable(page)


def acyclic(program, folder, page):
    report = Report(program, folder, "scenarios/dpv1_c1.yaml")
    opened(page, report)
    facts(page, report)
    legend = page.run(TEXTS, ".legend li")
    check(any(each.startswith("DPV1 ") for each in legend), "no DPV1 telegrams: %s" % legend)
    same(sum(int(each.rsplit(" ", 1)[1].replace(",", "")) for each in legend), len(report.telegrams), "telegrams of the legend")
    readable(page)


def tlm(program, folder, page):
    """Also where there are few pins to see."""
    report = Report(program, folder, "scenarios/two_slaves.yaml", "--view", "tlm")
    opened(page, report)
    facts(page, report)
    telegrams(page, report)
    readable(page)


def evil(program, folder, page):
    """Names of others stay texts."""
    scenario = pathlib.Path(folder) / "<b>&'.yaml"
    text = (ROOT / "scenarios/power_on_12m.yaml").read_text(encoding="UTF-8")
    first = next(line for line in text.splitlines() if line.startswith("name:"))
    scenario.write_text(text.replace(first, "name: " + json.dumps(EVIL)), encoding="UTF-8")
    shutil.copy(ROOT / "scenarios/dsdpv1.gsd", folder)
    report = Report(program, folder, str(scenario))
    opened(page, report)
    facts(page, report)
    same(page.run("return document.querySelector('h1').firstChild.textContent"), EVIL, "name")
    same(page.run("return document.querySelectorAll('#evil, img, main b:not(summary b)').length"), 0, "elements that the name has made")
    check(str(scenario) in page.run(TEXTS, "dd"), "file")


def limited(program, folder, page):
    """A page that has not all telegrams says so."""
    report = Report(program, folder, "scenarios/two_slaves.yaml")
    text = report.page.read_text(encoding="UTF-8")
    count = '"telegrams":{"count":%d,' % len(report.telegrams)
    check(count in text, "the count of the telegrams stands elsewhere")
    report.page.write_text(text.replace(count, '"telegrams":{"count":123456,'), encoding="UTF-8")
    opened(page, report)
    same(page.run(TEXTS, ".limited"), ["The first %d of 123,456 telegrams are shown." % len(report.telegrams)], "limit")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    for each in (usual, several_slaves, violated, acyclic, tlm, evil, limited):
        with tempfile.TemporaryDirectory(prefix="dsdpv1_report_") as folder, browser() as page:
            print(each.__name__.replace("_", " "), flush=True)
            each(program, folder, page)


if __name__ == "__main__":
    main()
