"""Reports of runs in a real browser: a page shows the contents of the run's result and log, and sends no requests.

    page_test.py DSDPV1_SIM
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

from browser import browser

ROOT = pathlib.Path(__file__).resolve().parents[2]
EVIL = "</script><b id=evil>\"&'</b><img src=x onerror=alert(1)><!-- <script>"
# The checks whose limits appear in a timing diagram.
DIAGRAMS = {"take": ["OWNERSHIP_SYNC_WINDOW", "OWNERSHIP_BOTH_OWN", "OWNERSHIP_NOT_OWNER"], "give_back": ["OWNERSHIP_RELEASED_IN_ACCESS"],
            "read": ["TIMING_TC", "TIMING_TW"], "write": ["TIMING_TS", "TIMING_TD", "TIMING_ADDRESS_HOLD", "TIMING_DATA_HOLD", "TIMING_CSR"]}
TICKS = 12  # in a nanosecond
NAMES = """return [...document.querySelectorAll(arguments[0])].map(each => each.getAttribute(arguments[1]))"""
COLOURS = """return [...document.querySelectorAll(arguments[0])].map(each => getComputedStyle(each).color + getComputedStyle(each).fontWeight)"""
TEXTS = """return [...document.querySelectorAll(arguments[0])].map(each => each.textContent)"""
# Texts of charts that leave their drawing or overlap another text of it.
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


# The contrast of each text with its background (WCAG 2): texts of charts have their fill, and the page behind them.
CONTRASTS = """
const light = colour => {
  const [r, g, b] = colour.match(/[\\d.]+/g).slice(0, 3).map(each => each / 255).map(each => each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const isClear = colour => colour === "rgba(0, 0, 0, 0)";
const ground = each => {
  for (let at = each; at; at = at.parentElement) {
    const bar = at.matches("g.telegram") ? getComputedStyle(at.querySelector("rect")).fill : getComputedStyle(at).backgroundColor;
    if (!isClear(bar)) return bar;
  }
};
const seen = new Map();
for (const each of document.querySelectorAll("body *")) {
  if (each.matches("script, style, noscript, noscript *") || !each.getClientRects().length) continue;
  if (![...each.childNodes].some(one => one.nodeType === 3 && one.textContent.trim())) continue;
  const style = getComputedStyle(each), text = each instanceof SVGElement ? style.fill : style.color;
  const a = light(text), b = light(ground(each)), ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  const name = each.tagName + "." + (each.getAttribute("class") || "") + " in " + (each.closest("[class]") || each).getAttribute("class");
  seen.set(name, Math.min(ratio, seen.get(name) || 99));
}
return [...seen];"""


def check(condition, what):
    if not condition:
        sys.exit(what)


def same(seen, expected, what):
    check(seen == expected, "%s: the page shows %s, expected is %s" % (what, seen, expected))


class Report:
    """A run with all its outputs."""

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
    """Opens the page: no message, and no request except the page itself."""
    page.open(report.page)
    same(page.messages(), [], "messages")
    same([urllib.parse.unquote(each) for each in page.requests()], ["file://" + str(report.page)], "requests")


def facts(page, report):
    result, judged = report.result, [each for each in report.result["expectations"] if each["passed"] is not None]
    verdict = result["verdict_text"]
    check(page.run("return document.title").startswith("%s: %s (dsdpv1-sim " % (result["scenario"], verdict)), "title")
    same(page.run(TEXTS, ".verdict"), [verdict], "verdict")
    shown = dict(zip(page.run(TEXTS, "dt"), page.run(TEXTS, "dd")))
    same(shown["violations"], "%s expected, %s unexpected" % (f"{expected_violations(result):,}", f"{result['violations']:,}"), "violations")
    allowed = re.search(r"(\d+) violations? allowed", verdict)
    same(expected_violations(result), int(allowed.group(1)) if allowed else 0, "violations of the verdict")
    done, violated = ({each["id"] for each in result["checks"] if each[key]} for key in ("count", "violations"))
    same(shown["checks"], "%d of %d kept" % (len(done - violated), len(done)) if done else "none", "checks")
    check(re.fullmatch(r"[\d.]+ s, [\d.]+ times (slower|faster) than real time", shown["took"]), "took %s" % shown["took"])
    same(shown["telegrams"], "%s right, %s wrong" % (f"{result['telegrams']:,}", f"{result['wrong_telegrams']:,}"), "telegrams")
    same(shown["expectations"], "%d of %d met" % (sum(each["passed"] for each in judged), len(judged)), "expectations")
    expectations(page, result)
    same(page.run(TEXTS, "#stations .table:first-of-type tbody td:first-child"), [each["name"] for each in result["slaves"]], "slaves")


def expected_violations(result):
    return sum(each["allowed"] for each in result["checks"]) + sum(each["count"] for each in result["violated"] if each["allowed"])


def expectations(page, result):
    """In groups, the unmet first; only these are marked."""
    groups = [(name, some) for name, passed in (("Not met", False), ("Not judged", None), ("Met", True))
              if (some := [each for each in result["expectations"] if each["passed"] is passed])]
    same(page.run(TEXTS, "#expectations h3"), ["%s: %d" % (name, len(some)) for name, some in groups], "groups of expectations")
    for name, some in groups:
        at = "#expectations [data-group='%s'] tbody " % name
        same([page.run(TEXTS, at + "td:nth-child(%d)" % i) for i in (1, 2, 3)], [[str(each[key]) for each in some] for key in ("text", "seen", "line")], name)
        same(len(page.run(TEXTS, at + "tr.bad")), len(some) if name == "Not met" else 0, "marked as bad of " + name)
    colours = set(page.run(COLOURS, "#expectations [data-group=Met] td"))
    check(colours <= set(page.run(COLOURS, "body")), "expectations that are met are coloured: %s" % colours)
    for each in result["expectations"]:
        for number, unit in re.findall(r"at (-?[\d.]+) (ns|us|ms|s)\b", each["seen"]):
            check(float(number) < 1000 and (float(number) >= 1 or unit == "ns"), "a time is not in the unit that leaves 1 to 999: " + each["seen"])


def whole_words(page):
    """The file's name breaks after a slash, if at all."""
    lines = page.run("""return [...document.querySelectorAll("[data-fact=file] dd span")].map(each => each.getClientRects().length)""")
    check(lines and set(lines) == {1}, "a name of a file or folder is broken: %s" % lines)


def codes(page, report, base=""):
    """A code is a link to its explanation on the page; links into the documents lead to existing headings and rows."""
    links = page.run(NAMES, "a.code, svg a", "href")
    check(links, "no links to codes")
    for link in set(links):
        check(page.run("return document.querySelectorAll(arguments[0]).length", "tr[id='%s']" % link[1:]) == 1, "a dead link: " + link)
    used = {each["id"] for each in report.result["checks"]} | {each["code"] for key in ("events", "violated", "refused") for each in report.result[key]}
    rows = page.run("return [...document.querySelectorAll('#codes tbody tr')].map(row => [...row.cells].map(each => each.textContent))")
    explained = {row[0]: row for row in rows}
    same({re.sub(r"(reasons|checks)\.md$", "", each) for each in explained}, used, "codes that are explained")
    check(all(row[2] and row[3] for row in rows), "a code without what it is or what to do")
    documented = page.run(NAMES, "a.documents", "href")
    same(len(documented), len(rows) if base else 0, "links to the documents")
    for link in documented:
        name, anchor = link[len(base) + 1:].split("#")
        text = (ROOT / "docs" / name).read_text(encoding="UTF-8")
        check(link.startswith(base + "/"), "a link elsewhere: " + link)
        check("### %s\n" % anchor.upper() in text or '<a id="%s"></a>' % anchor in text, "a dead link: " + link)


def counts(page):
    return [int(each) for each in page.run(NAMES, "g.telegram", "data-count")]


def shown_time(page):
    return [float(page.run("return document.querySelector('svg.telegrams').getAttribute(arguments[0])", each)) / TICKS for each in ("data-from", "data-to")]


def first_window(page, report):
    """The chart begins with the first exchange of data: its telegrams do not overlap and are wide enough to be read."""
    begin, end = shown_time(page)
    first = next(each for each in report.telegrams if "Data_Exchange" in each["text"])
    check(begin < first["at_ns"] < end, "the first exchange, at %s, is not shown first: %s to %s" % (first["at_ns"], begin, end))
    check(2 <= sum(counts(page)) <= 40 and max(counts(page)) == 1, "too many telegrams to be read at first: %s" % counts(page))
    widths = [float(each) for each in page.run(NAMES, "g.telegram rect", "width")]
    check(max(widths) > 40, "bars of at most %s pixels" % max(widths))


def telegrams(page, report):
    """As many as in the log, all of them and in each interval."""
    first_window(page, report)
    page.click("section#telegrams .buttons button:last-child")
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
    # The log has the time at which a telegram ends.
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
    """The shown instance is the one that the checks name."""
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


def layout(page):
    """Rules for tables, titles and axes."""
    whole_words(page)
    section = page.run("return document.querySelector('#expectations').clientWidth")
    for selector in ("#expectations table", ".diagram table", "#codes table"):
        widths = page.run("return [...document.querySelectorAll(arguments[0])].map(each => each.getBoundingClientRect().width)", selector)
        check(widths and min(widths) > 0.9 * section, "%s: %s of %s pixels" % (selector, widths, section))
    lines = page.run("return [...document.querySelectorAll('.histogram figcaption')].map(each => each.getBoundingClientRect().height / parseFloat(getComputedStyle(each).lineHeight))")
    check(lines and all(abs(each - 2) < 0.1 for each in lines), "titles of histograms have more lines than title and station: %s" % lines)


def dark(program, folder, page):
    """In light and dark mode each text has enough contrast with its background."""
    for scenario in ("scenarios/violations.yaml", "scenarios/rsu_spi.yaml"):
        report, grounds = Report(program, folder, scenario), []
        for wanted in (False, True):
            page.dark(wanted)
            opened(page, report)
            grounds.append(page.run("return getComputedStyle(document.body).backgroundColor"))
            contrasts = page.run(CONTRASTS)
            check(len(contrasts) > 30, "only %d kinds of text" % len(contrasts))
            same([(name, round(ratio, 1)) for name, ratio in contrasts if ratio < 4.5], [], "texts that are hard to read on %s" % grounds[-1])
        check(grounds[0] != grounds[1], "the page is not dark where it should be")
    page.dark(False)


def violations(page, report):
    """One picture each, with the pin changes that the checks have kept."""
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
    rows = page.run("return [...document.querySelectorAll('#violations tbody tr')].map(row => [...row.cells].map(each => each.textContent))")
    sums = {}
    for each in report.result["violated"]:
        sums[each["slave"], each["code"]] = sums.get((each["slave"], each["code"]), 0) + each["count"]
    same({tuple(row[:2]): row[2] for row in rows[-len(sums):]}, {key: f"{count:,}" for key, count in sums.items()}, "violations of the chip")


def usual(program, folder, page):
    report = Report(program, folder, "scenarios/power_on_12m.yaml")
    opened(page, report)
    for each in (facts, telegrams, histograms, margins, diagrams, codes):
        each(page, report)
    layout(page)
    readable(page)
    page.click("#checks svg a")
    same(page.run("return document.querySelector('tr:target').id.replace('code-', '')"), page.run(NAMES, "#checks g.margin", "data-id")[0], "row of the code")


def unmet(program, folder, page):
    """Unmet expectations come first and are marked."""
    report = Report(program, folder, own_scenario(folder, "expect:\n", "expect:\n  - {slave: demo, dp_state: data_exch, by: 1ms}\n"), status=1)
    opened(page, report)
    facts(page, report)
    same(page.run(TEXTS, "#expectations h3")[0], "Not met: 1", "first group")


def documented(program, folder, page):
    """A program that knows the published address of the documents links to their headings and rows."""
    report = Report(program, folder, "scenarios/violations.yaml")
    text = report.page.read_text(encoding="UTF-8")
    check('"documents":"",' in text, "the build's own address of the documents is not empty")
    report.page.write_text(text.replace('"documents":"",', '"documents":"https://docs.invalid/dsdpv1",'), encoding="UTF-8")
    opened(page, report)
    codes(page, report, "https://docs.invalid/dsdpv1")


def own_scenario(folder, before, after, name="own.yaml"):
    """power_on_12m with another text."""
    text = (ROOT / "scenarios/power_on_12m.yaml").read_text(encoding="UTF-8")
    check(text.count(before) == 1, "power_on_12m has no longer one %s" % before)
    (pathlib.Path(folder) / name).write_text(text.replace(before, after), encoding="UTF-8")
    shutil.copy(ROOT / "scenarios/dsdpv1.gsd", folder)
    return str(pathlib.Path(folder) / name)


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
    codes(page, report)
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
    """Also with few visible pins."""
    report = Report(program, folder, "scenarios/two_slaves.yaml", "--view", "tlm")
    opened(page, report)
    facts(page, report)
    telegrams(page, report)
    readable(page)


def evil(program, folder, page):
    """Names that look like markup remain text."""
    scenario = own_scenario(folder, "name: Power-on to data exchange at 12 Mbit/s, judged by the user", "name: " + json.dumps(EVIL), "<b>&'.yaml")
    report = Report(program, folder, scenario)
    opened(page, report)
    facts(page, report)
    same(page.run("return document.querySelector('h1').firstChild.textContent"), EVIL, "name")
    same(page.run("return document.querySelectorAll('#evil, img, main b:not(summary b)').length"), 0, "elements that the name has made")
    check(scenario in page.run(TEXTS, "dd"), "file")


def limited(program, folder, page):
    """A page without all telegrams says so."""
    report = Report(program, folder, "scenarios/two_slaves.yaml")
    text = report.page.read_text(encoding="UTF-8")
    count = '"telegrams":{"count":%d,' % len(report.telegrams)
    check(count in text, "the count of the telegrams stands elsewhere")
    report.page.write_text(text.replace(count, '"telegrams":{"count":123456,'), encoding="UTF-8")
    opened(page, report)
    same(page.run(TEXTS, ".limited"), ["The first %d of 123,456 telegrams are shown." % len(report.telegrams)], "limit")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    for each in (usual, several_slaves, violated, unmet, documented, dark, acyclic, tlm, evil, limited):
        with tempfile.TemporaryDirectory(prefix="dsdpv1_report_") as folder, browser() as page:
            print(each.__name__.replace("_", " "), flush=True)
            each(program, folder, page)


if __name__ == "__main__":
    main()
