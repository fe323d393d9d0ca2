"""Sphinx's settings. The pages are woven into build/book-source first."""

import os

project = "Lightwalk"
author = "the authors of Lightwalk"
html_title = "Lightwalk"
extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx_design", "sphinx_copybutton"]
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "smartquotes"]
myst_heading_anchors = 3
nitpicky = True
language = "en"

# Everything comes from this folder: no page needs the network, and all pages work
# from file://.
# set_formulas.py renders the formulas, and removes MathJax's script.
mathjax_path = "mathjax/none.js"
html_static_path = [os.environ["BOOK_STATIC"]]
templates_path = ["templates"]
fonts = [
    f"fonts/{name}/{style}"
    for name in ("source-serif-4", "jetbrains-mono")
    for style in ("wght.css", "wght-italic.css")
]
html_css_files = [*fonts, "formulas.css", "book.css", "gallery.css", "live.css", "lab.css"]
html_js_files = [
    "keys.js",
    "contents.js",
    "reader.js",
    "scrollers.js",
    "live.js",
    "lab.js",
    "viewer.js",
    "gallery.js",
]
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "contents.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
html_show_sourcelink = False
html_copy_source = False
html_show_search_summary = False  # it would fetch each page that was found
html_show_copyright = False
html_permalinks_icon = "#"

html_theme = "furo"
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {
        "font-stack": "'Source Serif 4 Variable', 'Charter', 'Bitstream Charter', 'Georgia', 'DejaVu Serif', serif",
        "font-stack--monospace": "'JetBrains Mono Variable', 'SFMono-Regular', "
        "'Menlo', 'Consolas', 'DejaVu Sans Mono', "
        "monospace",
        "color-brand-primary": "#8a3b12",
        "color-brand-content": "#8a3b12",
    },
    "dark_css_variables": {"color-brand-primary": "#f0a878", "color-brand-content": "#f0a878"},
    "footer_icons": [],
}
pygments_style = "tools.weave.code_colors.CodeColors"
pygments_dark_style = "github-dark"
copybutton_exclude = ".linenos, .gp"
