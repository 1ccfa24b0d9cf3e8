# SPDX-License-Identifier: GPL-3.0-or-later
# The documentation site; scripts/docs.sh makes it.
import re
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]

project = "wfpsf"
release = re.search(r"project\(wfpsf VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
version = release

extensions = ["myst_parser", "breathe"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["site"]
myst_heading_anchors = 3
suppress_warnings = []

breathe_default_project = "wfpsf"
breathe_domain_by_extension = {"h": "c"}
breathe_show_include = False

# Every name must lead somewhere, but for those of C itself.
nitpicky = True
nitpick_ignore = [("c:identifier", name)
                  for name in ("int32_t", "int64_t", "size_t")]
nitpick_ignore_regex = [("py:class", r"(?!wfpsf\.).*")]  # words such as "array" in docstrings

html_theme = "furo"
html_title = f"wfpsf {release}"
html_static_path = [str(HERE / "static")]
html_css_files = ["wfpsf.css"]
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
pygments_style = "friendly"
highlight_language = "c"
