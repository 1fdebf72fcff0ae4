# SPDX-License-Identifier: BSD-3-Clause
"""The sentences of a page in Markdown."""

import re


def cells_of(page):
    """Those of tables, each a paragraph of its own."""
    rows = re.findall(r"^\|(.*)\|$", re.sub(r"^ *```.*?^ *```", "", page, flags=re.MULTILINE | re.DOTALL), re.MULTILINE)
    return "\n\n".join(cell.strip() for row in rows for cell in re.split(r"(?<!\\)\|", row))


def prose_of(page):
    """What is read as text: without code, tables and pictures; headings and items of lists are paragraphs of their own."""
    page = re.sub(r"^ *(```|@code).*?^ *(```|@endcode)[^\n]*$", "\n", page, flags=re.MULTILINE | re.DOTALL)
    page = re.sub(r"<!--.*?-->", "", page, flags=re.DOTALL)
    lines = []
    for line in page.splitlines():
        text = line.strip()
        if text.startswith(("|", "![", "#")) or line.startswith("    ") and (not lines or not lines[-1]):
            lines.append("")
        elif re.match(r"([-*+]|\d+\.) ", text):
            lines += ["", text.split(" ", 1)[1]]
        else:
            lines.append(text)
    return "\n".join(lines)


def sentences_of(text):
    """Of what prose_of or cells_of gives."""
    for paragraph in re.split(r"\n\s*\n", text):
        text = " ".join(paragraph.split())
        text = re.sub(r"\]\([^)]*\)", "]", text)  # a link's address is not read
        text = re.sub(r"`[^`]*`", "CODE", text)
        text = re.sub(r"@ref \S+ ", "", text)
        yield from (sentence for sentence in re.split(r"""(?<=[.!?])[*)"_]*\s+(?=[("*_]*(?:\[|[A-Z0-9]))""", text) if sentence)


def words_in(sentence):
    return len(re.findall(r"\S*\w\S*", sentence))
