"""Judges measurements: median, minimum and maximum of the rounds compared with the goal; as text and as JSON."""
import dataclasses
import statistics

BUSY = 0.10   # spread of the calibration
QUIET = 0.08  # relative to its minimum, the limit for values to count; less than BUSY, because the minimum may decrease


@dataclasses.dataclass
class Outcome:
    """One row after all rounds: values, or the reason why there are none."""
    row: object
    values: list
    error: str = ""

    @property
    def value(self):
        return statistics.median(self.values)

    @property
    def met(self):
        if self.error:
            return False
        if self.row.goal is None:
            return True
        return self.value <= self.row.goal if self.row.at_most else self.value >= self.row.goal


def spread(times):
    return (max(times) - min(times)) / min(times)


def is_busy(times):
    return spread(times) > BUSY


def number(value):
    """Three figures, no exponent."""
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def goal(row):
    if row.goal is None:
        return f"for comparison, {row.unit}"
    return f"at {'most' if row.at_most else 'least'} {number(row.goal)} {row.unit}"


def cells(outcome):
    """row, value, goal, met or not, min..max"""
    row = outcome.row
    if outcome.error:
        return [row.name, "failed", goal(row), "not met", outcome.error]
    met = "-" if row.goal is None else "met" if outcome.met else "not met"
    return [row.name, number(outcome.value), goal(row), met,
            f"{number(min(outcome.values))}..{number(max(outcome.values))}"]


HEAD = ["row", "value", "goal", "met", "min..max"]


def lines(outcomes):
    """The table, tab-separated."""
    return ["\t".join(each) for each in [HEAD, *map(cells, outcomes)]]


def calibration_line(machine):
    times = machine.times
    state = "busy" if is_busy(times) else "quiet"
    return (f"calibration\t{number(statistics.median(times))} ms\t{number(min(times))}..{number(max(times))} ms\t"
            f"spread {100 * spread(times):.0f} %\tthe machine was {state}, {machine.refused} values were measured again")


def report(outcomes, machine, rounds, clock, description):
    """For programs: the output of --json."""
    times = machine.times
    return {"rounds": rounds, "clock": clock, "machine": description,
            "calibration": {"median_ms": statistics.median(times), "min_ms": min(times), "max_ms": max(times), "spread": spread(times),
                            "busy": is_busy(times), "measured_again": machine.refused},
            "rows": [of_outcome(each) for each in outcomes]}


def of_outcome(outcome):
    row = outcome.row
    entry = {"name": row.name, "goal": row.goal, "at_most": row.at_most, "unit": row.unit, "met": outcome.met}
    if outcome.error:
        return {**entry, "error": outcome.error}
    return {**entry, "value": outcome.value, "min": min(outcome.values), "max": max(outcome.values), "values": outcome.values}
