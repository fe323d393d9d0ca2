"""The page of speed and convergence: tables from the results of `make measured`."""

import re
import shutil

from tools.weave.measured import FOLDER, stored

TABLE = re.compile(r"^\{measured (\S+)\}$", re.M)


def with_tables(text, source):
    """A page with the tables that it names, and the curves that it shows."""

    if "convergence.svg" in text:
        (source / "figures").mkdir(parents=True, exist_ok=True)
        shutil.copy(FOLDER / "convergence.svg", source / "figures")
    return TABLE.sub(lambda match: stored(match[1]), text)
