# SPDX-License-Identifier: BSD-3-Clause
"""docs/security.md names tests and settings that exist."""

import re
import unittest

from sources import ROOT

PAGE = (ROOT / "docs/security.md").read_text(encoding="utf-8")


class SecurityTest(unittest.TestCase):
    def test_what_holds_a_claim_is_there(self):
        tests = "\n".join(f"{path.name}\n{path.read_text(encoding='utf-8')}" for path in (ROOT / "test").rglob("*") if path.suffix in (".cpp", ".py"))
        cells = re.findall(r"^\|.*\| ([^|]*) \|$", PAGE[PAGE.index("## What a peer cannot do"):PAGE.index("## Files")], re.MULTILINE)[1:]
        names = [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)] + re.findall(r"tests? ((?:`\w+`(?:, )?)+)", PAGE)
        names = [name for text in names for name in re.split(r"[`, ]+", text) if name]
        self.assertGreater(len(names), 9)
        self.assertEqual([name for name in names if name not in tests], [])

    def test_the_drone_listens_to_itself_alone(self):
        config = (ROOT / "common/configs/onboard_config.hpp").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r'std::string (\w+) = "127\.0\.0\.1:\d+"', config), ["observer", "pose_address"])
        self.assertIn("std::string telemetry_address;", config)


if __name__ == "__main__":
    unittest.main()
