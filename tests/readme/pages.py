#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Faults of README.md and of the pages in docs/.

    pages.py FOLDER        the folder of the project
    pages.py --self-test   every kind of fault is found

Links to files and headings must lead somewhere, pages must be in the navigation of mkdocs.yml, a
block of C++ must stand below a comment that names the file it is compared with (readme.cmake), and
README.md has at most 12 000 characters. Prints one line for each fault; ends with status 1 if any.
"""
import pathlib
import re
import sys
import tempfile

LIMIT = 12000


def heading_anchors(text):
    """The anchors that headings get: lower case, words joined by hyphens."""
    anchors = set()
    for line in re.findall(r"(?m)^#{1,6} (.*)$", re.sub(r"(?s)```.*?```", "", text)):
        plain = re.sub(r"[`*\[\]]|\(.*?\)", "", line).strip().lower()
        anchors.add(re.sub(r"\s+", "-", re.sub(r"[^\w\s-]", "", plain)))
    return anchors


def faults_of_page(root, page):
    text = page.read_text()
    prose = re.sub(r"(?s)```.*?```", "", text)
    prose = re.sub(r"(?m)^    .*$", "", prose)
    prose = re.sub(r"`[^`]*`", "", prose)
    name = page.relative_to(root)
    for link in re.findall(r"\]\(([^)\s]+)\)", prose):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists():
            yield f"{name}: the link {link} leads nowhere"
        elif anchor and target.suffix == ".md" and anchor not in heading_anchors(target.read_text()):
            yield f"{name}: {link}: there is no such heading"
        elif path and page.is_relative_to(root / "docs") and not target.is_relative_to(root / "docs"):
            yield f"{name}: the link {link} leaves docs/, which is all that a site has"
    for block in re.finditer(r"(?m)^```cpp$", text):
        before = text[: block.start()].rstrip("\n").split("\n")[-1]
        if not re.fullmatch(r"<!-- (part of )?the file \S+ -->", before):
            line = text[: block.start()].count("\n") + 1
            yield f"{name}:{line}: no comment says which file this code is compared with"


def faults(root):
    readme = root / "README.md"
    pages = sorted((root / "docs").rglob("*.md"))
    navigation = (root / "mkdocs.yml").read_text()
    for page in [readme, *pages]:
        yield from faults_of_page(root, page)
    for page in pages:
        if str(page.relative_to(root / "docs")) not in navigation:
            yield f"{page.relative_to(root)}: not in the navigation of mkdocs.yml"
    length = len(readme.read_text())
    if length > LIMIT:
        yield f"README.md: {length} characters, at most {LIMIT}"


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs").mkdir()
        (root / "mkdocs.yml").write_text("nav:\n  - good.md\n")
        (root / "README.md").write_text("[a](docs/good.md#a-heading) [b](docs/bad.md)\n" + LIMIT * "x")
        (root / "docs/good.md").write_text("# A heading\n\n[x](good.md#none) [y](../README.md)\n")
        (root / "docs/lost.md").write_text("# Lost\n\n```cpp\nint i;\n```\n")
        found = list(faults(root))
    expected = ["docs/bad.md leads nowhere", "no such heading", "leaves docs/", "not in the navigation",
                "no comment says", "characters"]
    missed = [text for text in expected if not any(text in fault for fault in found)]
    if missed or len(found) != len(expected):
        sys.exit(f"pages.py: expected {expected}, got {found}")


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        sys.exit(0)
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    problems = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(problems) if problems else "no faults")
    sys.exit(1 if problems else 0)
