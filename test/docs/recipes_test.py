# SPDX-License-Identifier: BSD-3-Clause
"""The recipes that users copy: hosted integration, the container, the documentation's build."""

import re
import subprocess
import unittest

from sources import ROOT, programs

try:
    import yaml
except ImportError:
    yaml = None

RECIPES = sorted((ROOT / "docs/ci").glob("*.yml"))
PAGES = [ROOT / "docs/hosted_ci.md", ROOT / "docs/container.md"]


def commands(node):
    """Every command of a recipe: what stands below run, script and before_script."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key in ("run", "script", "before_script"):
                yield from [value] if isinstance(value, str) else value if isinstance(value, list) else []
            yield from commands(value)
    elif isinstance(node, list):
        for value in node:
            yield from commands(value)


class RecipesTest(unittest.TestCase):
    @unittest.skipIf(yaml is None, "python3-yaml is not installed")
    def test_recipes_run_scripts_that_exist_with_their_options(self):
        self.assertEqual(len(RECIPES), 3)
        for recipe in RECIPES:
            text = "\n".join(commands(yaml.safe_load(recipe.read_text())))
            called = re.findall(r"(?:^|[ /])(scripts/\w+|\.ci/run)((?: --[a-z-]+(?: [\w./]+)?)*)", text, re.MULTILINE)
            self.assertTrue(called, recipe)
            for script, options in called:
                self.assertTrue((ROOT / script).exists(), f"{recipe}: {script}")
                for option in re.findall(r"--[a-z-]+", options):
                    usage = subprocess.run([ROOT / script, "--help"], capture_output=True, text=True, check=True).stdout
                    self.assertIn(option, usage, f"{recipe}: {script} {option}")

    @unittest.skipIf(yaml is None, "python3-yaml is not installed")
    def test_what_recipes_keep_is_where_the_scripts_write(self):
        written = "\n".join((ROOT / path).read_text() for path in (".ci/run", "scripts/test", "scripts/build_lib.sh"))
        for folder in ("build_ros", "build/no_ros", "build/docs"):
            self.assertIn(folder, written)
        for recipe in ("github.yml", "gitlab.yml"):
            text = (ROOT / "docs/ci" / recipe).read_text()
            for kept in ("build_ros/Testing", "build/no_ros/Testing", "build/demo/run/report.html", "build/docs/html"):
                self.assertIn(kept, text)
            self.assertIn("--out build/demo", text)

    def test_pages_name_what_exists(self):
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            for target in re.findall(r"\]\(([^)#]+)\)", text):
                self.assertTrue((page.parent / target).exists(), f"{page}: {target}")
            called = set(re.findall(r"^vslam (\w+)", text, re.MULTILINE)) - {"roslaunch", "rostopic"}
            self.assertEqual(sorted(called - programs()), [])
            for launch in re.findall(r"roslaunch ardrone_vslam (\S+)", text):
                self.assertTrue((ROOT / "launch" / launch).exists(), launch)

    def test_containerfile_can_be_executed(self):
        trial = subprocess.run([ROOT / "scripts/try_containerfile", "--dry-run"], capture_output=True, text=True)
        self.assertEqual(trial.returncode, 0, trial.stderr)
        self.assertIn("== ENTRYPOINT", trial.stdout)

    def test_page_has_the_releases_that_are_tried(self):
        suites = re.search(r"^SUITES = \{(.*)\}", (ROOT / "scripts/try_releases").read_text(), re.MULTILINE)[1]
        rows = re.findall(r"^\| Debian (\d+) \|", (ROOT / "docs/install.md").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(re.findall(r'"(\d+)":', suites), rows)


if __name__ == "__main__":
    unittest.main()
