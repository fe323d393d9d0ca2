"""The colors of code on light pages and slides: Pygments' `tango`, with darker
colors where its contrast is below 4.5 to 1."""

from pygments.styles.tango import TangoStyle
from pygments.token import Generic, Name, Operator, String

GREEN, ORANGE, OLIVE = "#3a6f04", "#9c4600", "#705c00"


class CodeColors(TangoStyle):
    styles = {
        **{token: rule for token, rule in TangoStyle.styles.items() if token not in String},
        String: GREEN,
        String.Doc: "italic #8f5902",
        Operator: f"bold {ORANGE}",
        Operator.Word: "bold #204a87",
        Name.Attribute: OLIVE,
        Name.Entity: ORANGE,
        Name.Label: ORANGE,
        Generic.Error: "#a40000",
        Generic.Inserted: "#006e00",
    }
