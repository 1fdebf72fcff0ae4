# SPDX-License-Identifier: BSD-3-Clause
"""docs/troubleshooting.md names what exists: messages, states, parameters, launch arguments, checks, programs, options."""

import re
import unittest

from sources import ROOT, programs, sources

PAGE = (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8")
SOURCES = sources()


def code_of(page):
    """Blocks of code, and what stands in single back ticks."""
    return re.findall(r"```\n(.*?)```", page, re.DOTALL) + re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", page, flags=re.DOTALL))


class TroubleshootingTest(unittest.TestCase):
    def missing(self, names):
        return sorted(name for name in set(names) if not re.search(rf"\b{re.escape(name)}\b", SOURCES))

    def test_quoted_messages_are_the_codes_own(self):
        quotes = re.findall(r'"([^"\n]+)"', PAGE)
        self.assertGreater(len(quotes), 60)
        pieces = {piece.strip() for quote in quotes for piece in quote.split("...") if piece.strip()}
        self.assertEqual(sorted(piece for piece in pieces if piece not in SOURCES), [])

    def test_every_state_of_status_is_there(self):
        constants = re.findall(r"^uint8 ([A-Z_]+) = \d+", (ROOT / "msg/Status.msg").read_text(), re.MULTILINE)
        self.assertGreater(len(constants), 10)
        self.assertEqual([name for name in constants if f"| `{name.lower()}` |" not in PAGE], [])

    def test_names_exist(self):
        names = [name for code in code_of(PAGE) for name in re.findall(r"^[a-z][a-z0-9]*(?:_[a-z0-9]+)+$", code)]
        self.assertGreater(len(names), 60)
        known = {"cc1plus", "static_transform_publisher", "catkin_pkg", "use_sim_time"}
        self.assertEqual(self.missing(set(names) - known), [])

    def test_settings_name_parameters_or_launch_arguments(self):
        page = " ".join(code_of(PAGE))
        arguments = set(re.findall(r"\b([a-z_]+):=", page))
        known = set(re.findall(r'<arg name="(\w+)"', SOURCES))
        self.assertGreater(len(arguments), 8)
        self.assertEqual(sorted(arguments - known), [])
        parameters = {name for code in code_of(PAGE) for name in re.findall(r"^([a-z_]+): [a-z0-9.]+$", code)}
        documented = (ROOT / "docs/parameters.md").read_text(encoding="utf-8")
        self.assertEqual(sorted(name for name in parameters if f"| `{name}` |" not in documented), [])

    def test_commands_exist(self):
        page = "\n".join(code_of(PAGE))
        self.assertEqual(sorted(set(re.findall(r"rosrun ardrone_vslam (\w+)", page)) - programs()), [])
        self.assertEqual([path for path in re.findall(r"\b(?:scripts|config)/[\w.]+", page) if not (ROOT / path).exists()], [])
        options = set(re.findall(r"(?<![-\w])--[a-z][a-z-]+", page))
        self.assertEqual(sorted(option for option in options if option not in SOURCES), [])

    def test_links_lead_somewhere(self):
        headings = {re.sub(r"[^a-z0-9 _-]", "", line.lstrip("# ").lower()).replace(" ", "-")
                    for line in PAGE.splitlines() if line.startswith("#")}
        for target in re.findall(r"\]\(([^)]+)\)", PAGE):
            path, _, anchor = target.partition("#")
            self.assertTrue(path or anchor in headings, target)
            self.assertTrue(not path or (ROOT / "docs" / path).exists(), target)


if __name__ == "__main__":
    unittest.main()
