# SPDX-License-Identifier: BSD-3-Clause
"""A class has one job: 300 lines over all its files and 12 data members are enough for it. (Functions: .clang-tidy-quick.)"""

import re
import unittest

from sources import ROOT

FOLDERS = ("src", "include", "nodes", "onboard", "common", "tools")
MOST_LINES = 300
MOST_MEMBERS = 12


def without_comments(text):
    text = re.sub(r'"(\\.|[^"\\\n])*"', '""', text)
    return re.sub(r"//.*|/\*.*?\*/|'[{};]'", "", text)


def classes_in(code):
    """[(name, its body: braces within, and what is in them, are semicolons)]"""
    found = []
    for head in re.finditer(r"\b(?:class|struct)\s+([\w:]+)(?:\s+final)?(?:\s*:\s*[^;{(]*)?\s*\{", code):
        depth, body = 1, []
        for piece in re.split(r"([{}])", code[head.end():]):
            depth += {"{": 1, "}": -1}.get(piece, 0)
            if depth == 0:
                break
            body.append(piece if depth == 1 and piece != "}" else ";")
        found.append((head.group(1), "".join(body)))
    return found


def members_of(name, body):
    """Of a class, whose members end in _, and of a State, which is a class's members. What is plain data is not counted."""
    body = re.sub(r"\b(public|private|protected):", ";", body)
    while "<" in body and body != (shorter := re.sub(r"<[^<>]*>", "", body)):
        body = shorter
    members = []
    for statement in body.split(";"):
        declared = re.sub(r"=[^,]*", "", statement).split(",")
        if "(" in declared[0] or not re.match(r"\s*(?!using|static|struct|class|enum|friend|template|return)[\w:]+[\s&*]+\w", declared[0]):
            continue
        members += [re.findall(r"\w+", re.sub(r"\[\w*\]", "", one))[-1] for one in declared]
    return members if name.endswith("::State") else [one for one in members if one.endswith("_")]


def sizes():
    """{file without folder and ending: lines, with those of its other half and of each .cpp that defines members of its classes}, {class: members}"""
    text = {path: path.read_text(encoding="utf-8") for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.[ch]pp"))}
    classes = {path: classes_in(without_comments(code)) for path, code in text.items()}
    defined = {path: set(re.findall(r"^\w[^\n(]*?(?<!::)\b(\w+)::(?:\w+::)*~?\w+\(", code, re.MULTILINE)) for path, code in text.items()}
    lines = {}
    for stem in {path.stem for path in text}:
        own = {path for path in text if path.stem == stem}
        names = {name for path in own if path.suffix == ".hpp" for name, _ in classes[path] if "::" not in name}
        own |= {path for path, others in defined.items() if names & others and path.suffix == ".cpp"}
        lines[stem] = sum(len(text[path].splitlines()) for path in own)
    members = {}
    for name, body in (one for found in classes.values() for one in found):
        members[name] = max(len(members_of(name, body)), members.get(name, 0))
    return lines, members


class ClassSizeTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lines, cls.members = sizes()

    def is_large(self, name):
        return self.lines.get(name, 0) > MOST_LINES or self.members.get(name, 0) > MOST_MEMBERS

    def test_no_class_is_too_large(self):
        large = {name: size for size_of in (self.lines, self.members) for name, size in size_of.items() if self.is_large(name)}
        self.assertEqual(large, {})

    def test_it_counts_what_is_there(self):
        self.assertGreater(self.lines["window_state"], 250, "its .cpp are two")
        for name, least in (("Msckf", 10), ("FrameView", 10), ("Tracker::State", 10), ("MsckfConfig", 0)):
            self.assertGreaterEqual(self.members[name], least, name)
        code = "class A : B { public: int f() { int b_; return b_; } void g(int c_); std::function<void(int)> h_{[] { x(); }}; int i_ = f(1), j_; };"
        self.assertEqual(members_of(*classes_in(code)[0]), ["h_", "i_", "j_"])


if __name__ == "__main__":
    unittest.main()
