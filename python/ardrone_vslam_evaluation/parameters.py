# SPDX-License-Identifier: BSD-3-Clause
"""What `replay --list-parameters` tells (docs/parameters.md), and what a configuration file sets."""

import re
from dataclasses import dataclass

from .faults import InputFault, reason


@dataclass(frozen=True)
class Parameter:
    name: str
    default: str
    unit: str
    sections: tuple


def read_page(text):
    """All of them in their order; one name may be in several sections."""
    rows = re.findall(r"^\| `(\w+)` \| (.*?) \| (.*?) \| (.*?) \|", text, re.MULTILINE)
    return [Parameter(name, default, unit, tuple(sections.split(", "))) for name, sections, default, unit in rows]


def of_replay(parameters):
    """{name: parameter} of those that `replay --set` knows."""
    return {p.name: p for p in parameters if {"tracker", "mapper"} & set(p.sections)}


def configured(path):
    """{name: value} of a config/*.yaml: sections of keys, nothing deeper."""
    try:
        with open(path, encoding="utf-8") as file:
            return dict(re.findall(r"^  (\w+):[ ]*([^\s#]+)", file.read(), re.MULTILINE))
    except OSError as error:
        raise InputFault(f"{path}: cannot be read ({reason(error)}); check the configuration's name") from None


def number(text):
    """None when it is none."""
    try:
        return float(text)
    except ValueError:
        return None


def is_same(one, other):
    return one == other or (number(one) is not None and number(one) == number(other))


def in_order(values):
    """Numbers by size; words as they come."""
    distinct = []
    for value in values:
        if not any(is_same(value, other) for other in distinct):
            distinct.append(value)
    return sorted(distinct, key=number) if all(number(value) is not None for value in distinct) else distinct
