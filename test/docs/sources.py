# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the documentation share: the package's own text."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["common", "config", "include", "launch", "msg", "nodes", "onboard", "python", "scripts", "src", "srv", "tools"]
OLD_NAMES = ROOT / "src/config/old_names.cpp"


def old_names_table():
    return re.search(r"kTable\[\] = \{.*?\n\};", OLD_NAMES.read_text(encoding="utf-8"), re.DOTALL).group()


def old_parameters():
    """Names of parameters that are refused."""
    return set(re.findall(r'(?:renamed|constant)\("\w+", "(\w+)"', old_names_table()))


def sources():
    """All code in one string, without the names that are refused; a literal that goes on over lines is joined."""
    files = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*"))
             if path.is_file() and path.suffix not in (".pyc", ".png")]
    text = "\n".join(path.read_text(encoding="utf-8") for path in files).replace(old_names_table(), "")
    return re.sub(r'"\s*\n\s*f?"', "", text)


def programs():
    """What `rosrun ardrone_vslam` finds: tools, nodes and installed scripts."""
    tools = {path.stem for path in (ROOT / "tools").glob("*.cpp")}
    nodes = {path.stem for path in (ROOT / "nodes").glob("*_node.cpp")}
    scripts = {path.name for path in (ROOT / "scripts").iterdir()}
    return tools | nodes | scripts
