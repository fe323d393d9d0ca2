"""Prevents bad line breaks in built pages: between a formula or a word of code and
the punctuation beside it, after the dash of an option, or within a word of code
that fits on a phone."""

import re

FORMULA = re.compile(
    r'\(?<span class="math">(?:(?!</mjx-container>).)*</mjx-container></span>[.,;:?!)’”]*', re.S
)
CODE = re.compile(
    r'\(?<code class="docutils literal notranslate"><span class="pre">[^<]{1,30}</span></code>[.,;:?!)’”]*'
)
COMMANDS = re.compile(
    r'(?<=<div class="highlight-none notranslate"><div class="highlight"><pre>).*?(?=</pre>)', re.S
)
WORD = re.compile(r'<span class="pre">([^<]{31,})</span>')
OPTION = re.compile(r"(?<=\s)--?[a-z][\w-]*")


def kept(found):
    return f'<span class="keep">{found[0]}</span>'


def kept_with_marks(found):
    alone = found[0].startswith("<") and found[0].endswith(">")
    return found[0] if alone else kept(found)


def keep_together(book):
    for page in book.rglob("*.html"):
        text = CODE.sub(kept_with_marks, FORMULA.sub(kept_with_marks, page.read_text()))
        text = WORD.sub(r'<span class="pre long">\1</span>', text)
        page.write_text(COMMANDS.sub(lambda commands: OPTION.sub(kept, commands[0]), text))
