# SPDX-License-Identifier: BSD-3-Clause
"""What a section of docs/reproduction.md is made of."""

import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Claim:
    """A number that must lie within bounds: on the real pictures and on the rendered ones, in a quick run and in a whole one."""

    what: str
    value: float
    low: float = -math.inf
    high: float = math.inf

    def holds(self):
        return self.low <= self.value <= self.high  # nor what is not a number

    def bounds(self):
        if math.isinf(self.low):
            return f"at most {self.high:g}"
        if math.isinf(self.high):
            return f"at least {self.low:g}"
        return f"{self.low:g} to {self.high:g}"


@dataclass
class Section:
    title: str
    parts: list = field(default_factory=list)  # markdown, one paragraph or table each
    claims: list = field(default_factory=list)
    pictures: dict = field(default_factory=dict)  # name -> matplotlib figure

    def text(self, *lines):
        self.parts.append("\n".join(lines))

    def table(self, heads, rows):
        lines = ["| " + " | ".join(heads) + " |", "| --- |" + " ---: |" * (len(heads) - 1)]
        self.parts.append("\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]))

    def picture(self, name, figure, caption):
        self.pictures[name] = figure
        self.parts.append(f"![{caption}](images/reproduction/{name}.png)")

    def claim(self, what, value, low=-math.inf, high=math.inf):
        self.claims.append(Claim(what, value, low, high))


def digits(value, count=3):
    """So many significant digits, without an exponent."""
    if value is None or not math.isfinite(value):
        return "-"
    if value == 0:
        return "0"
    places = max(0, count - 1 - math.floor(math.log10(abs(value))))
    return f"{value:,.{places}f}" if places else f"{round(value, count - 1 - math.floor(math.log10(abs(value)))):,.0f}"


def percent(value):
    return f"{100 * value:.0f} %"
