# SPDX-License-Identifier: BSD-3-Clause
"""What the command answers with a message instead of a traceback."""


class InputFault(Exception):
    """A file or an argument is wrong; the message names it and says what to do."""


class MachineFault(Exception):
    """Something is not installed, or a file cannot be written."""


def reason(error):
    """Of an OSError, without the path, which the message names already."""
    return error.strerror or str(error)
