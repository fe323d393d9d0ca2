"""The page of speed and convergence: tables from the results of `make measured`."""

import re
import shutil

from tools.tree import Failure
from tools.weave.measured import FOLDER

TABLE = re.compile(r"^\{measured (\S+)\}$", re.M)


def with_tables(text, source):
    """A page with the tables that it names, and the curves that it shows."""

    def table(match):
        path = FOLDER / match[1]
        if not path.exists():
            raise Failure(f"tools/bench/measured/{match[1]} is not there: `make measured` writes it")
        return path.read_text()

    if "convergence.svg" in text:
        (source / "figures").mkdir(parents=True, exist_ok=True)
        shutil.copy(FOLDER / "convergence.svg", source / "figures")
    return TABLE.sub(table, text)
