"""Formulas and prose of the chapters as plain text, for a terminal."""

import re

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
RELATIONS = "≤≥·×∈→≈⇒"


def formula(text):
    r"""TeX as readable text for a terminal: \frac{a}{b} is a/b."""
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
        ends = r"(?![a-zA-Z])"
        if SYMBOLS[name] not in RELATIONS:  # \pi r is one word
            ends += r"(?:\s(?=[\w\\(|]))?"
        text = re.sub(re.escape(name) + ends, SYMBOLS[name], text)
    text = re.sub(r"\((\w+)\)/\((\w+)\)", r"\1/\2", text)
    text = re.sub(r"\{(\w)\}", r"\1", text)
    return re.sub(r" +", " ", text.replace("{", "(").replace("}", ")")).strip()


def plain(text):
    """Prose without its marks of formulas and code."""
    text = re.sub(r"\$\$?(.+?)\$\$?", lambda found: formula(found[1]), text, flags=re.DOTALL)
    text = text.replace("`", "")
    return re.sub(r"[ \t]+", " ", re.sub(r"\n(?!\s*- )\s*", " ", text)).strip()
