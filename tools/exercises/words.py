"""What `make check` says, in English or Spanish, and formulas as plain text.

LIGHTWALK_LANGUAGE=es asks for Spanish; else the locale decides. Messages are
English in the source; messages.es.toml has them in Spanish.
"""

import functools
import os
import re
import tomllib
from pathlib import Path

SYMBOLS = {
    r"\omega": "ω",
    r"\theta": "θ",
    r"\phi": "φ",
    r"\eta": "η",
    r"\xi": "ξ",
    r"\pi": "π",
    r"\cdot": "·",
    r"\times": "×",
    r"\le": "≤",
    r"\ge": "≥",
    r"\in": "∈",
    r"\to": "→",
    r"\cos": "cos",
    r"\sin": "sin",
    r"\arccos": "arccos",
    r"\max": "max",
    r"\sum": "Σ",
    r"\int": "∫",
    r"\Omega": "Ω",
    r"\Phi": "Φ",
    r"\gamma": "γ",
    r"\alpha": "α",
    r"\delta": "δ",
    r"\varepsilon": "ε",
    r"\sigma": "σ",
    r"\approx": "≈",
    r"\infty": "∞",
    r"\min": "min",
    r"\Rightarrow": "⇒",
}


def language():
    """Two letters."""
    wanted = os.environ.get("LIGHTWALK_LANGUAGE")
    for name in ("LC_ALL", "LC_MESSAGES", "LANG"):
        wanted = wanted or os.environ.get(name)
    return (wanted or "en")[:2].lower()


@functools.cache
def catalogue(code):
    path = Path(__file__).with_name(f"messages.{code}.toml")
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def say(message, **values):
    """The message in the user's language, with its values."""
    return catalogue(language()).get(message, message).format(**values)


def formula(text):
    r"""TeX as far as it can be read in a terminal: \frac{a}{b} is a/b."""
    group = r"\{((?:[^{}]|\{[^{}]*\})*)\}"
    text = re.sub(r"\\(?:displaystyle|underbrace|cancel)(?![a-zA-Z])", "", text)
    text = re.sub(
        r"(\\sqrt|\\[dt]?frac(?=\d\d)) ?(\w)(\d?)",
        lambda m: f"{m[1]}{{{m[2]}}}" + (m[3] and f"{{{m[3]}}}"),
        text,
    )
    before = None
    while before != text:
        before = text
        text = re.sub(r"\\[dt]?frac" + group + r"\s*" + group, r"(\1)/(\2)", text)
        text = re.sub(r"\\sqrt" + group, r"√(\1)", text)
        text = re.sub(r"\\(?:text|mathrm)" + group, r"\1", text)
    text = re.sub(r"\\[,;!] ?|\\q?quad|\\left|\\right|~", " ", text)
    # The longest names first: \phi is not \p followed by hi.
    for name in sorted(SYMBOLS, key=len, reverse=True):
        text = re.sub(re.escape(name) + r"(?![a-zA-Z])\s?", SYMBOLS[name], text)
    text = re.sub(r"\((\w+)\)/\((\w+)\)", r"\1/\2", text)
    text = re.sub(r"\{(\w)\}", r"\1", text)
    return re.sub(r" +", " ", text.replace("{", "(").replace("}", ")")).strip()


def plain(text):
    """Prose without its marks of formulas and code."""
    text = re.sub(r"\$\$?(.+?)\$\$?", lambda found: formula(found[1]), text, flags=re.DOTALL)
    return re.sub(r"\s+", " ", text.replace("`", "")).strip()
