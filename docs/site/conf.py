"""Sphinx's settings. `stage.py` lays this file beside the pages; `tools/site` runs both."""

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

project = "meshwalk"
author = "the authors of meshwalk"
copyright = "the authors of meshwalk, MIT licence"
version = release = re.search(
    r'MW_VERSION_STRING "(.*?)"', (HERE / "files/include/meshwalk/version.h").read_text()
).group(1)

extensions = [
    "myst_parser",
    "breathe",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "crosslinks",
    "navigation",
]
root_doc = "index"
exclude_patterns = ["files/**/*.md", "samples"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
myst_heading_anchors = 4
default_role = "literal"  # one backtick in docstrings; crosslinks makes links of names
highlight_language = "text"

breathe_projects = {"meshwalk": str(HERE / "doxygen/xml")}
breathe_default_project = "meshwalk"
breathe_domain_by_extension = {"h": "c"}
breathe_show_include = False
breathe_show_define_initializer = True
c_id_attributes = ["MW_API"]

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_class_signature = "mixed"
python_use_unqualified_type_names = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
napoleon_use_param = False  # or words of their types become links
suppress_warnings = ["ref.python"]  # words of types that several classes have as attributes

html_theme = "furo"
html_title = f"meshwalk {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_extra_path = ["_extra"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b6e4f", "color-brand-content": "#0b6e4f"},
    "dark_css_variables": {"color-brand-primary": "#5fd0a5", "color-brand-content": "#5fd0a5"},
}


def _plain_footnotes(app, what, name, thing, options, lines):
    """Make text of footnotes: several docstrings on a page have a [1]."""
    lines[:] = [re.sub(r" ?\[\d\]_|\.\. \[\d\] ", "", line) for line in lines]


def _leave_out_aliases(app, what, name, thing, skip, options):
    """Leave out fields of tuples: the docstring of their class tells what they are."""
    alias = (getattr(thing, "__doc__", None) or "").startswith("Alias for field number")
    return True if alias else None


def setup(app):
    """Tell Sphinx about it."""
    app.connect("autodoc-skip-member", _leave_out_aliases)
    app.connect("autodoc-process-docstring", _plain_footnotes)
