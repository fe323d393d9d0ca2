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

# Everything comes from this folder: no page asks anybody for anything, and
# all of it works from file://.
mathjax_path = "mathjax/tex-svg-full.js"
mathjax3_config = {"options": {"enableMenu": False}}
html_static_path = [os.environ["BOOK_STATIC"]]
html_css_files = ["book.css", "live.css"]
html_js_files = ["keys.js", "live.js"]
html_show_search_summary = False  # it would fetch pages, which file:// forbids
html_show_sourcelink = False
html_copy_source = False
html_show_copyright = False
html_permalinks_icon = "#"

html_theme = "furo"
html_theme_options = {
    "navigation_with_keys": True,
    "light_css_variables": {
        "font-stack": "'Source Serif 4', 'Charter', 'Bitstream Charter', 'Georgia', 'DejaVu Serif', serif",
        "font-stack--monospace": "'JetBrains Mono', 'SFMono-Regular', "
        "'Menlo', 'Consolas', 'DejaVu Sans Mono', "
        "monospace",
        "color-brand-primary": "#8a3b12",
        "color-brand-content": "#8a3b12",
    },
    "dark_css_variables": {"color-brand-primary": "#f0a878", "color-brand-content": "#f0a878"},
    "footer_icons": [],
}
pygments_style = "tango"
pygments_dark_style = "github-dark"
copybutton_exclude = ".linenos, .gp"
