"""The letters of the book and its decks: files beside the pages, and, within a
drawing, the few letters that it has. A drawing is shown as a picture, and pictures
load no files."""

import base64
import functools
import io
import re
import shutil

from tools.tree import BUILD

PACKAGES = BUILD / "node/node_modules/@fontsource-variable"
FONTS = ("source-serif-4", "jetbrains-mono")
STYLES = ("wght.css", "wght-italic.css")
SERIF = "'Source Serif 4 Variable', Charter, Georgia, 'DejaVu Serif', serif"
TEXTS = re.compile(r"<text [^>]*font-style=\"(\w+)\"[^>]*>(.*?)</text>", re.S)


def copy_fonts(static):
    """The fonts' files, and the styles that name them, into `static`/fonts."""
    for name in FONTS:
        target = static / "fonts" / name
        (target / "files").mkdir(parents=True)
        shutil.copy(PACKAGES / name / "LICENSE", target)
        for style in STYLES:
            shutil.copy(PACKAGES / name / style, target)
            for file in re.findall(r"url\(\./files/([\w.-]+)\)", (PACKAGES / name / style).read_text()):
                shutil.copy(PACKAGES / name / "files" / file, target / "files")


def faces():
    """The same styles as one text, for a page beside `fonts`."""
    styles = ((name, (PACKAGES / name / style).read_text()) for name in FONTS for style in STYLES)
    return "".join(text.replace("url(./files/", f"url(fonts/{name}/files/") for name, text in styles)


@functools.cache
def regular(script, style):
    """The serif font of a script, latin or greek, in its regular weight."""
    from fontTools.ttLib import TTFont
    from fontTools.varLib.instancer import instantiateVariableFont

    file = PACKAGES / f"source-serif-4/files/source-serif-4-{script}-wght-{style}.woff2"
    font = instantiateVariableFont(TTFont(file), {"wght": 400})
    made = io.BytesIO()
    font.flavor = None
    font.save(made)
    return made.getvalue()


@functools.cache
def face(script, style, letters):
    """A rule for these letters of a script, which has the font itself in it."""
    from fontTools.subset import Options, Subsetter
    from fontTools.ttLib import TTFont

    font = TTFont(io.BytesIO(regular(script, style)))
    subsetter = Subsetter(Options(layout_features=["kern"], hinting=False))
    subsetter.populate(text=letters)
    subsetter.subset(font)
    font.flavor = "woff2"
    made = io.BytesIO()
    font.save(made)
    data = base64.b64encode(made.getvalue()).decode()
    ranges = "U+370-3FF" if script == "greek" else "U+0-36F, U+400-FFFF"
    return (
        f"@font-face {{ font-family: 'Source Serif 4 Variable'; font-style: {style}; "
        f"src: url(data:font/woff2;base64,{data}) format('woff2'); unicode-range: {ranges}; }}"
    )


def with_letters(drawing):
    """A drawing with the letters that it has, in the pages' font."""
    found = {}
    for style, text in TEXTS.findall(drawing):
        for letter in re.sub(r"<[^>]*>", "", text):
            script = "greek" if "\u0370" <= letter <= "\u03ff" else "latin"
            found.setdefault((script, style), set()).add(letter)
    rules = [face(*which, "".join(sorted(letters))) for which, letters in sorted(found.items())]
    return drawing.replace("<defs>", f"<style>{''.join(rules)}</style><defs>", 1)
