"""The manual: Sphinx reads the Markdown of the repository in place, so that its links are those of the web view.

scripts/build_manual calls it. Pages are those of `include_patterns`. The lists of links in docs/index.md are the table of
contents: each second-level heading there becomes a caption of the navigation.
"""

import ast
import os
import pathlib
import re
import sys

from docutils import nodes
from pygments.lexers.special import TextLexer

ROOT = pathlib.Path(__file__).resolve().parents[1]
# What `cmake --build --preset release --target docs` writes.
DOXYGEN = "build/release/docs/html/index.html"
sys.path.insert(0, str(ROOT / "python"))

project = "vitrel"
author = "the authors of vitrel"
version = release = re.search(r"project\(vitrel VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]

extensions = ["myst_parser", "numpydoc", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx_copybutton"]
root_doc = "docs/index"
include_patterns = ["docs/**", "README.md", "*/README.md", "CONTRIBUTING.md"]
exclude_patterns = ["build*", "out", ".*", "docs/data", "**/CMakeFiles"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_update_mathjax = False
# Fonts and input are those that scripts/build_manual copies beside the pages.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"messageStyle": "none", "showMathMenu": False, "SVG": {"blacker": 1}}

# The reference needs the Python sources only, not the compiled module.
autodoc_mock_imports = ["vitrel._vitrel", "h5py"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
numpydoc_show_class_members = False

html_theme = "furo"
html_title = f"vitrel {release}"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_static_path = ["manual.css"]
html_css_files = ["manual.css"]
pygments_style = "tango"
# Plain listings of output.
highlight_language = "text"


def toctrees(text):
    """The table of contents of the start page, from its headings and the lists of links below them."""
    trees = []
    for heading, body in re.findall(r"^## (.+)\n((?:(?!## ).*\n)*)", text + "\n", re.MULTILINE):
        pages = re.findall(r"^- \[([^]]+)\]\(([^)#]+)\.md(?:#[^)]*)?\)", body, re.MULTILINE)
        if pages:
            entries = [f"{title} <{page}>" for title, page in pages]
            trees.append("\n".join(["```{toctree}", ":hidden:", f":caption: {heading}", "", *entries, "```"]))
    return "\n\n".join(trees)


def python_reference():
    """The documentation of everything that the package exports."""
    tree = ast.parse((ROOT / "python/vitrel/__init__.py").read_text())
    names = next(ast.literal_eval(item.value) for item in tree.body
                 if isinstance(item, ast.Assign) and item.targets[0].id == "__all__")
    compiled = {alias.name for item in tree.body if isinstance(item, ast.ImportFrom) and item.module == "_vitrel"
                for alias in item.names}
    modules = {alias.name for item in tree.body if isinstance(item, ast.ImportFrom) and item.module is None
               for alias in item.names}
    lines = []
    for name in names:
        if name not in compiled:
            kind = "automodule" if name in modules else "autoclass" if name[0].isupper() else "autofunction"
            lines += [f"## {name}", "", "```{eval-rst}", f".. {kind}:: vitrel.{name}"]
            lines += [] if kind == "autofunction" else ["   :members:"]
            lines += ["```", ""]
    return "\n".join(lines)


def complete_source(app, page, source):
    if page.endswith("/README") and f"(../{page}.md" not in (ROOT / "docs/index.md").read_text(encoding="utf-8"):
        source[0] = "---\norphan: true\n---\n\n" + source[0]
    if page == root_doc:
        source[0] += "\n" + toctrees(source[0])
    elif page == "docs/cpp" and (ROOT / DOXYGEN).exists():
        reference = os.path.relpath(ROOT / DOXYGEN, pathlib.Path(app.outdir, "docs"))
        source[0] += f'\nThe reference that was built: <a href="{reference}">core, mc, edmd, analysis, workflow</a>.\n'
    elif page == "docs/python":
        source[0] += "\n" + python_reference()


def without_aliases(app, what, name, member, options, lines):
    """Fields of named tuples that have no text of their own."""
    if any(line.startswith("Alias for field number") for line in lines):
        lines.clear()


def link_to_folder(app, env, node, text):
    """A link to a folder leads to its README, or is plain text."""
    target = node.get("reftarget", "")
    folder = (ROOT / node["refdoc"]).parent / target if "refdoc" in node else None
    if folder is None or not target or not folder.is_dir():
        return None
    page = folder.resolve().relative_to(ROOT).as_posix() + "/README"
    if page not in env.found_docs:
        return text
    uri = app.builder.get_relative_uri(node["refdoc"], page)
    return nodes.reference("", "", text, internal=True, refuri=uri)


def setup(app):
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", complete_source)
    app.connect("missing-reference", link_to_folder)
    app.connect("autodoc-process-docstring", without_aliases)
