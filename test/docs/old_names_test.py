# SPDX-License-Identifier: BSD-3-Clause
"""No message to users names a parameter that the package refuses: it would send them to what is not there any more."""

import re
import unittest

from sources import OLD_NAMES, ROOT, old_parameters

FOLDERS = ["common", "include", "nodes", "onboard", "src", "tools"]
# Faults of what tests alone can set: a user's threshold_min ends below them.
TESTS_ALONE = ROOT / "src/corners/corner_detector.cpp"


def sentences_of_code(text):
    """Literals with a space in them; one that goes on over lines is joined. Names of columns and keys have none."""
    joined = re.sub(r'"\s*\n\s*"', "", text)
    return [literal for literal in re.findall(r'"((?:[^"\\\n]|\\.)*)"', joined) if " " in literal]


def told_to_users():
    """What a user reads, by file."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.?pp")):
            if path not in (OLD_NAMES, TESTS_ALONE):
                yield path, sentences_of_code(path.read_text(encoding="utf-8"))
    for path in sorted([*(ROOT / "msg").iterdir(), *(ROOT / "srv").iterdir()]):
        yield path, re.findall(r"#(.*)", path.read_text(encoding="utf-8"))
    for path in sorted((ROOT / "launch").glob("*.launch")):
        yield path, re.findall(r'\bdoc="([^"]*)"', path.read_text(encoding="utf-8"))


class OldNamesTest(unittest.TestCase):
    def test_what_counts_as_a_sentence(self):
        self.assertEqual(sentences_of_code('f("a b "\n  "c") + "d_e" + "f, g"'), ["a b c", "f, g"])

    def test_nothing_told_to_users_names_what_is_refused(self):
        names = {name for name in old_parameters() if "_" in name}  # the others are words, too
        self.assertGreater(len(names), 80)
        self.assertIn("observer_port", names)
        refused = re.compile(rf"\b({'|'.join(sorted(names))})\b")
        told = list(told_to_users())
        self.assertGreater(sum(len(texts) for _, texts in told), 1000)
        wrong = [f"{path.relative_to(ROOT)}: {name} in: {text.strip()}" for path, texts in told for text in texts
                 for name in refused.findall(text)]
        self.assertEqual(wrong, [], "say what it is called now, or what the constant is (src/config/old_names.cpp):\n" + "\n".join(wrong))


if __name__ == "__main__":
    unittest.main()
