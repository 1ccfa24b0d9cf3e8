#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""check_links.py FOLDER: every link inside a site must lead to a file, and to a place in it.

Links to other sites are listed, not followed: no network is needed.
"""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.places, self.links = set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.places.add(value)
            elif value and name in ("href", "src"):
                self.links.append(value)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in root.rglob("*.html")}
    broken, inside, outside = [], 0, set()
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                outside.add(link)
                continue
            inside += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            there = target in pages or target.is_file()
            if not there or (parts.fragment and target in pages and target.suffix == ".html"
                             and unquote(parts.fragment) not in pages[target].places):
                broken.append(f"{path.relative_to(root)}: {link}")
    print(f"{len(pages)} pages, {inside} links inside, {len(outside)} to other sites")
    if broken or not inside:
        sys.exit("links that lead nowhere:\n" + "\n".join(sorted(set(broken))))


if __name__ == "__main__":
    main()
