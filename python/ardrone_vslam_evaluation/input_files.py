# SPDX-License-Identifier: BSD-3-Clause
"""Files that a user names: a pipe or a device may never end, and no file of a kind is larger than its bound."""

import json
import os
import stat

from .faults import InputFault, reason

MOST_TABLE_BYTES, MOST_JSON_BYTES = 1_000_000_000, 100_000_000


def open_input(path, most_bytes=MOST_TABLE_BYTES, newline=None):
    """Of text. Raises InputFault for what is there and no such file, OSError for what cannot be opened."""
    status = os.stat(path)
    if not stat.S_ISREG(status.st_mode):
        raise InputFault(f"{path}: is no file but a folder, device or pipe; name a file")
    if status.st_size > most_bytes:
        raise InputFault(f"{path}: is larger than {most_bytes // 1_000_000} MB, which no such file is; check the path")
    return open(path, newline=newline, encoding="utf-8")


def read_json(path):
    """What a file of JSON says; what is wrong with it stands in the InputFault."""
    try:
        with open_input(path, MOST_JSON_BYTES) as file:
            return json.load(file)
    except json.JSONDecodeError as error:
        raise InputFault(f"{path}:{error.lineno}: is no JSON ({error.msg}); make the run again") from None
    except UnicodeDecodeError:
        raise InputFault(f"{path}: is no JSON, as it is no text; make the run again") from None
    except RecursionError:
        raise InputFault(f"{path}: is no JSON that a run wrote: too deep; make the run again") from None
    except OSError as error:
        raise InputFault(f"{path}: cannot be read ({reason(error)}); check the path") from None
